//! The angle that an obstacle blocks: Eq. 9 and 10.
//!
//! The finger is widened to the angle that it has at the grasped object's edge, so that graspable objects are called
//! blocked. The ring ends at r_t + r_g, but the finger's outer corners reach a little farther (0.4 mm for the paper's
//! plates): an obstacle that only they meet is overlooked. Eq. 10 is undefined for a disc inside the ring that the
//! fingers sweep, and too small where the points in which the disc is widest, as seen from the grasped object, lie
//! inside the ring. There the tangent angle is taken instead.

use core::f64::consts::TAU;

use crate::scene::{Footprint, ObjectIndex, Scene, distance};

/// The angle of an obstacle as seen from the centre of the grasped object.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Extent {
    /// γ_i, rad; 2π where the obstacle covers the centre.
    pub(super) angle: f64,
    /// True where Eq. 10 is undefined or too small and the tangent angle stands in.
    pub(super) by_tangent: bool,
}

/// The radius of a footprint, m: the paper knows discs only, and so circumscribes whatever is none.
pub(super) fn radius(footprint: &Footprint) -> f64 {
    footprint.circumradius()
}

/// γ_t of Eq. 9, rad: the angle of a finger of `width` (m) at the edge of the grasped object of `radius` (m).
pub(super) fn finger_angle(width: f64, radius: f64) -> f64 {
    2.0 * libm::atan(width / (2.0 * radius))
}

/// γ_i of Eq. 10, for an obstacle of `radius` (m) whose centre is `apart` (m) from that of the grasped object; `outer`
/// is r_t + r_g (m). `None` where the obstacle is not local: it doesn't reach into the ring.
pub(super) fn obstacle_extent(outer: f64, apart: f64, radius: f64) -> Option<Extent> {
    if apart >= outer + radius {
        return None;
    }
    let tangent_squared = apart * apart - radius * radius;
    Some(if tangent_squared <= 0.0 {
        Extent { angle: TAU, by_tangent: true }
    } else if tangent_squared < outer * outer {
        Extent { angle: 2.0 * libm::asin(radius / apart), by_tangent: true }
    } else {
        let cosine = (outer * outer + tangent_squared) / (2.0 * apart * outer);
        Extent { angle: 2.0 * libm::acos(cosine.min(1.0)), by_tangent: false }
    })
}

/// The number of obstacles of a movable object for which the tangent angle replaces Eq. 10.
pub fn tangent_angles(scene: &Scene, object: ObjectIndex) -> usize {
    let (gripper, grasped) = (scene.gripper(), scene.object(object).footprint());
    let (outer, margin) = (radius(grasped) + gripper.clearance(), gripper.margin());
    let by_tangent = |other: &Footprint| {
        obstacle_extent(outer, distance(grasped.at(), other.at()), radius(other) + margin)
            .is_some_and(|extent| extent.by_tangent)
    };
    let near = scene.index().within(grasped.at(), outer + margin);
    near.filter(|(other, obstacle)| *other != object && by_tangent(obstacle)).count()
}

#[cfg(test)]
mod tests {
    use core::f64::consts::PI;

    use super::*;

    #[test]
    fn eq_9_and_10_give_the_papers_own_plates_their_angles() {
        assert!((finger_angle(0.02, 0.075) - 0.265_104).abs() < 1e-6);
        // Two plates that touch: the triangle 0.125, 0.15, 0.075.
        let extent = obstacle_extent(0.125, 0.15, 0.075).unwrap_or(Extent { angle: 0.0, by_tangent: true });
        assert!(!extent.by_tangent);
        assert!(
            (extent.angle - 2.0 * libm::acos((0.125 * 0.125 + 0.15 * 0.15 - 0.075 * 0.075) / 0.0375)).abs() < 1e-15
        );
        assert_eq!(obstacle_extent(0.125, 0.2, 0.075), None);
    }

    #[test]
    fn a_disc_inside_the_ring_takes_its_tangent_angle() {
        let inside = obstacle_extent(0.125, 0.1, 0.01);
        assert_eq!(inside, Some(Extent { angle: 2.0 * libm::asin(0.01 / 0.1), by_tangent: true }));
        // Not inside, but widest where it is.
        let astride = obstacle_extent(0.125, 0.12, 0.02);
        assert_eq!(astride, Some(Extent { angle: 2.0 * libm::asin(0.02 / 0.12), by_tangent: true }));
        assert_eq!(obstacle_extent(0.125, 0.01, 0.02).map(|extent| extent.angle), Some(2.0 * PI));
    }

    #[test]
    fn where_the_tangent_point_leaves_the_ring_both_angles_agree() {
        let (outer, radius) = (0.125_f64, 0.05);
        let apart = (outer * outer + radius * radius).sqrt();
        let angle = |apart| obstacle_extent(outer, apart, radius).map_or(0.0, |extent| extent.angle);
        assert!((angle(apart - 1e-12) - angle(apart + 1e-12)).abs() < 1e-9);
    }
}
