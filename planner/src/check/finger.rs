//! A finger's rectangle, and how near a disc comes to it while the yaw stays within a band.

use core::f64::consts::TAU;

use nalgebra::{Point2, Vector2};

use crate::scene::{Gripper, Opening};

use super::body::Body;

/// One finger as it closes, seen from the gripper's axis with the finger along +x: the rectangle
/// [inner, outer] × [−half, half], m.
#[derive(Debug, Clone, Copy)]
pub(super) struct Finger {
    pub(super) inner: f64,
    pub(super) outer: f64,
    pub(super) half: f64,
}

/// The angle plus or minus whole turns, in [−π, π].
pub(super) fn wrap(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

impl Finger {
    /// Any finger round a disc that is grasped over its centre.
    pub(super) fn new(gripper: &Gripper, grasped: &Body) -> Self {
        let radius = grasped.radius;
        let open = match (gripper.opening(), gripper.max_opening()) {
            (Opening::Full, Some(width)) => width / 2.0,
            _ => radius,
        };
        Self { inner: radius, outer: open + gripper.clearance(), half: gripper.finger_width() / 2.0 }
    }

    /// From the object's centre to the finger's outer corners, m.
    pub(super) fn corner_distance(&self) -> f64 {
        Vector2::new(self.outer, self.half).norm()
    }

    /// From the finger to the point at `distance` (m) and `offset` (rad, from the finger's direction) of the object's
    /// centre, m; 0 inside the finger.
    pub(super) fn distance(&self, distance: f64, offset: f64) -> f64 {
        let (sin, cos) = libm::sincos(offset);
        let point = Point2::new(distance * cos, distance * sin);
        let along = (self.inner - point.x).max(point.x - self.outer).max(0.0);
        let across = (point.y.abs() - self.half).max(0.0);
        Vector2::new(along, across).norm()
    }

    /// The offset, from 0, at which a point at `distance` comes nearest to the finger. From there the distance grows
    /// monotonically, to offset 0 as well as to offset π. A point no further than the tip is nearest straight ahead;
    /// one beyond the outer corners is nearest on the ray through a corner; one between enters the finger through the
    /// tip.
    fn nearest_offset(&self, distance: f64) -> f64 {
        let across = if distance >= self.corner_distance() {
            self.half
        } else {
            ((distance - self.outer).max(0.0) * (distance + self.outer)).sqrt()
        };
        libm::atan2(across, self.outer)
    }

    /// The least distance (m) from the finger to a point at `distance` and `offset` (as above) of the axis while the yaw turns by
    /// up to `band` (rad) to both sides. The least is at an end of the band, or at a nearest offset within it.
    pub(super) fn closest(&self, distance: f64, offset: f64, band: f64) -> f64 {
        let nearest = self.nearest_offset(distance);
        let mut closest = f64::INFINITY;
        for end in [offset - band, offset + band] {
            closest = closest.min(self.distance(distance, end));
        }
        if [nearest, -nearest].iter().any(|turn| wrap(turn - offset).abs() <= band) {
            closest = closest.min(self.distance(distance, nearest));
        }
        closest
    }

    /// The four corners, m.
    pub(super) fn corners(&self) -> [Vector2<f64>; 4] {
        let Self { inner, outer, half } = *self;
        [[inner, -half], [outer, -half], [outer, half], [inner, half]].map(Vector2::from)
    }

    /// The outward normals of the four faces, of length 1, and how far the finger reaches along them, m.
    pub(super) fn faces(&self) -> [(Vector2<f64>, f64); 4] {
        let Self { inner, outer, half } = *self;
        [([1.0, 0.0], outer), ([-1.0, 0.0], -inner), ([0.0, 1.0], half), ([0.0, -1.0], half)]
            .map(|(normal, offset)| (normal.into(), offset))
    }

    /// The point of the finger that is nearest to `point`.
    pub(super) fn nearest(&self, point: Vector2<f64>) -> Vector2<f64> {
        Vector2::new(point.x.clamp(self.inner, self.outer), point.y.clamp(-self.half, self.half))
    }

    /// The corner that is farthest against `direction`.
    pub(super) fn corner_against(&self, direction: Vector2<f64>) -> Vector2<f64> {
        let x = if direction.x > 0.0 { self.inner } else { self.outer };
        Vector2::new(x, self.half.copysign(-direction.y))
    }
}

#[cfg(test)]
mod tests {
    use core::f64::consts::{FRAC_PI_2, PI};

    use proptest::prelude::*;

    use super::*;

    #[test]
    fn the_distance_is_that_to_the_rectangle() {
        let finger = Finger { inner: 1.0, outer: 2.0, half: 0.25 };
        let check = |distance, offset, expected: f64| {
            assert!((finger.distance(distance, offset) - expected).abs() < 1e-12, "{distance} {offset}");
        };
        check(1.5, 0.0, 0.0);
        check(3.0, 0.0, 1.0);
        check(0.5, 0.0, 0.5);
        check(1.0, PI, 2.0);
        check(5.25, -FRAC_PI_2, (1.0_f64 + 25.0).sqrt());
    }

    proptest! {
        #[test]
        fn the_closest_is_what_sampling_finds(
            fingers in 2_u32..=12, radius in 0.01..0.3_f64, width in 0.001..0.2_f64, clearance in 0.001..0.3_f64,
            distance in 0.0..1.0_f64, bearing in -4.0..4.0_f64, yaw in -7.0..7.0_f64, band in 0.0..2.0_f64,
        ) {
            let finger = Finger { inner: radius, outer: radius + clearance, half: width / 2.0 };
            let offset = |m: u32| wrap(bearing - yaw - f64::from(m) * TAU / f64::from(fingers));
            let closest = (0..fingers).map(|m| finger.closest(distance, offset(m), band)).fold(f64::INFINITY, f64::min);
            let steps = 2000;
            let sampled = (0..=steps).map(|step| {
                let turned = yaw + band * (f64::from(step) / f64::from(steps) * 2.0 - 1.0);
                (0..fingers).map(|m| finger.distance(distance, bearing - turned - f64::from(m) * TAU / f64::from(fingers)))
                    .fold(f64::INFINITY, f64::min)
            }).fold(f64::INFINITY, f64::min);
            // A yaw between two samples is off by half a step at the most.
            let coarse = distance * band / f64::from(steps) + 1e-12;
            prop_assert!(closest <= sampled + 1e-12 && closest >= sampled - coarse, "{} {}", closest, sampled);
        }
    }
}
