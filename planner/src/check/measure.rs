//! The checker's own measures of footprints: from one to a point, to another, to a rectangle. It uses none of the
//! scene's, so that a fault of one is not a fault of both.
//!
//! Distances are signed: where two cores overlap, minus the least translation that parts them. This is the greatest
//! separation along any direction, and some side's normal has it; where they are apart, some corner is nearest.

use core::iter;

use nalgebra::{Point2, Vector2};
use smallvec::SmallVec;

use crate::scene::Rectangle;

use super::body::{Body, Side, Sides};

/// From the edge of a footprint to a point, m; negative inside.
pub(super) fn away(body: &Body, point: Point2<f64>) -> f64 {
    if body.is_disc() {
        return (body.pose.at - point).norm() - body.radius;
    }
    signed(&body.sides, &[], point - body.pose.at) - body.radius
}

/// From edge to edge, m; negative where the two overlap.
pub(super) fn gap(a: &Body, b: &Body) -> f64 {
    let apart: Vector2<f64> = b.pose.at - a.pose.at;
    let cores = if a.is_disc() && b.is_disc() { apart.norm() } else { signed(&a.sides, &b.sides, apart) };
    cores - a.radius - b.radius
}

/// How far a footprint sticks out of the rectangle, m.
pub(super) fn overhang(body: &Body, top: Rectangle) -> f64 {
    let (min, max) = (top.min(), top.max());
    let out = |corner: Vector2<f64>| {
        let c = body.pose.at + corner;
        (min.x - c.x).max(c.x - max.x).max(min.y - c.y).max(c.y - max.y)
    };
    body.radius + corners(&body.sides).map(out).fold(f64::NEG_INFINITY, f64::max)
}

/// How deep a footprint reaches into the rectangle, m.
pub(super) fn intrusion(body: &Body, area: Rectangle) -> f64 {
    let at = body.pose.at;
    if body.is_disc() {
        let nearest = at.sup(&area.min()).inf(&area.max());
        return body.radius - (nearest - at).norm();
    }
    body.radius - signed(&body.sides, &sides_of(area), area.min() - at)
}

/// The sides of a rectangle, relative to its lower left corner.
fn sides_of(area: Rectangle) -> Sides {
    let (x, y) = area.sides();
    let side = |start: [f64; 2], along: [f64; 2], length| Side { start: start.into(), along: along.into(), length };
    SmallVec::from([
        side([0.0, 0.0], [1.0, 0.0], x),
        side([x, 0.0], [0.0, 1.0], y),
        side([x, y], [-1.0, 0.0], x),
        side([0.0, y], [0.0, -1.0], y),
    ])
}

/// The corners of a core.
fn corners(sides: &[Side]) -> impl Iterator<Item = Vector2<f64>> + '_ {
    let point = sides.is_empty().then(Vector2::zeros);
    sides.iter().map(|side| side.start).chain(point)
}

/// The signed distance of two cores, m, the second one's origin at `towards` from the first one's.
fn signed(a: &[Side], b: &[Side], towards: Vector2<f64>) -> f64 {
    let parted = parting(a, b, towards).max(parting(b, a, -towards));
    if parted <= 0.0 && !(a.is_empty() && b.is_empty()) {
        return parted;
    }
    nearest(a, b, towards).min(nearest(b, a, -towards))
}

/// The greatest separation along a normal of the first core's sides, and of a segment along it too, m.
fn parting(a: &[Side], b: &[Side], towards: Vector2<f64>) -> f64 {
    let along = |normal: Vector2<f64>, side: &Side| {
        corners(b).map(|corner| normal.dot(&(corner + towards - side.end()))).fold(f64::INFINITY, f64::min)
    };
    let is_segment = a.len() == 2;
    a.iter()
        .flat_map(|side| iter::once(along(side.outward(), side)).chain(is_segment.then(|| along(side.along, side))))
        .fold(f64::NEG_INFINITY, f64::max)
}

/// The least distance from a corner of the second core to a side of the first, m.
fn nearest(a: &[Side], b: &[Side], towards: Vector2<f64>) -> f64 {
    corners(b)
        .map(|corner| corner + towards)
        .map(|corner| match a {
            [] => corner.norm(),
            sides => sides.iter().map(|side| (side.nearest(corner) - corner).norm()).fold(f64::INFINITY, f64::min),
        })
        .fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::check::shapes::{any_footprint, at, footprint, separation};
    use crate::scene::Footprint;
    use crate::scene::scenes::TestScene;

    /// The sides as seen from the origin of the table.
    fn placed(body: &Body) -> Sides {
        let side = |side: &Side| Side { start: side.start + body.pose.at.coords, ..*side };
        body.sides.iter().map(side).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]
        #[test]
        fn a_gap_is_the_greatest_separation(
            a in any_footprint(0.1), b in any_footprint(0.1), (x, y) in (-0.3..0.3_f64, -0.3..0.3_f64), turns in (-4.0..4.0_f64, -4.0..4.0_f64),
        ) {
            let (a, b) = (at(&a, [0.0, 0.0, turns.0]), at(&b, [x, y, turns.1]));
            let real = gap(&a, &b);
            prop_assert!((real - gap(&b, &a)).abs() < 1e-12, "{} {}", real, gap(&b, &a));
            if !a.is_disc() && !b.is_disc() {
                let sampled = separation(&placed(&a), &placed(&b), 2000) - a.radius - b.radius;
                // Between two directions a separation changes by no more than the lengths times half a step.
                prop_assert!(real >= sampled - 1e-12 && real <= sampled + 1.2 * 0.0016, "{} {}", real, sampled);
            }
            let point = Body::of(&Footprint::disc(b.pose.at, 0.01));
            prop_assert!((away(&a, b.pose.at) - gap(&a, &point) - 0.01).abs() < 1e-12);
        }

        #[test]
        fn what_sticks_out_and_in_is_what_moves_it_off(
            a in any_footprint(0.1), (x, y) in (-0.3..0.3_f64, -0.3..0.3_f64), turn in -4.0..4.0_f64,
        ) {
            let scene = TestScene::new(3).table(0.2, 0.1).disc("t", 0.1, 0.05, 0.01).build("t");
            let (body, top) = (at(&a, [x, y, turn]), scene.table().top());
            let (at, radius, border) = (body.pose.at, body.radius, 400);
            let points = (0..border).flat_map(|step| {
                let (sin, cos) = libm::sincos(core::f64::consts::TAU * f64::from(step) / f64::from(border));
                corners(&body.sides).map(|corner| at + corner + radius * Vector2::new(cos, sin)).collect::<Vec<_>>()
            });
            let sampled = points.map(|p| -top.depth(p)).fold(f64::NEG_INFINITY, f64::max);
            let real = overhang(&body, top);
            prop_assert!(real >= sampled - 1e-12 && real <= sampled + 1e-4, "{} {}", real, sampled);
            let depth = intrusion(&body, top);
            if !body.is_disc() {
                let sampled = body.radius - separation(&sides_of(top), &placed(&body), 2000);
                prop_assert!(depth <= sampled + 1e-12 && depth >= sampled - 1.2 * 0.0016, "{} {}", depth, sampled);
            }
        }
    }

    #[test]
    fn two_segments_in_a_line_are_apart() {
        let bar = footprint(&[(0.1, 0.0), (0.0, 0.0)], 0.01);
        let (a, b) = (at(&bar, [0.0, 0.0, 0.0]), at(&bar, [0.5, 0.0, 0.0]));
        let expected = 0.5 - 0.101 - 0.02;
        assert!((gap(&a, &b) - expected).abs() < 1e-12, "{} {expected}", gap(&a, &b));
    }
}
