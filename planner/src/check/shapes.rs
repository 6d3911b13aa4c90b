//! Random footprints for the tests of this room.

use proptest::prelude::*;

use super::body::{Body, Side};
use crate::scene::scenes::TestScene;
use crate::scene::{Footprint, ObjectDraft, Pose, ShapeDraft};

/// A polygon, a disc or a capsule by the points of its core; grown by `radius` where it has one, and always where it must.
pub(super) fn footprint(points: &[(f64, f64)], radius: f64) -> Footprint {
    let shape = match points {
        [] | [_] => ShapeDraft::disc(radius.max(0.001)),
        [(length, _), _] => {
            let radius = radius.max(0.001);
            ShapeDraft::Capsule { length: Some(length.abs() + 2.1 * radius), radius: Some(radius) }
        }
        points => ShapeDraft::Polygon {
            points: points.iter().map(|(x, y)| [Some(*x), Some(*y)]).collect(),
            corner_radius: Some(radius),
        },
    };
    let object = ObjectDraft { id: Some("shape".into()), x: Some(5.0), y: Some(5.0), shape, ..ObjectDraft::default() };
    let scene = TestScene::new(3).table(10.0, 10.0).disc("t", 0.05, 0.05, 0.01).object(object).build("t");
    scene.objects()[1].footprint().clone()
}

/// The footprint at a pose.
pub(super) fn at(footprint: &Footprint, [x, y, yaw]: [f64; 3]) -> Body {
    Body::new(footprint.shape(), Pose { at: [x, y].into(), yaw })
}

/// A footprint of 0 to 8 points within `size`, sharp or rounded.
pub(super) fn any_footprint(size: f64) -> impl Strategy<Value = Footprint> {
    let points = proptest::collection::vec((-size..size, -size..size), 1..=8);
    let radius = prop_oneof![Just(0.0), 0.0..size / 2.0];
    let area = move |points: &Vec<(f64, f64)>| {
        let corner = points[0];
        let cross = |a: &(f64, f64), b: &(f64, f64)| {
            ((a.0 - corner.0) * (b.1 - corner.1) - (a.1 - corner.1) * (b.0 - corner.0)).abs()
        };
        points.len() < 3 || points.windows(2).any(|pair| cross(&pair[0], &pair[1]) > 1e-6 * size)
    };
    (points.prop_filter("an area", area), radius).prop_map(|(points, radius)| footprint(&points, radius))
}

/// The greatest separation of two cores along so many directions, m: never more than their signed distance.
pub(super) fn separation(a: &[Side], b: &[Side], directions: u32) -> f64 {
    let corners = |sides: &[Side]| match sides {
        [] => vec![nalgebra::Vector2::zeros()],
        sides => sides.iter().map(|side| side.start).collect(),
    };
    let (a, b) = (corners(a), corners(b));
    (0..directions)
        .map(|at| {
            let (sin, cos) = libm::sincos(core::f64::consts::TAU * f64::from(at) / f64::from(directions));
            let along = |v: &nalgebra::Vector2<f64>| cos * v.x + sin * v.y;
            b.iter().map(along).fold(f64::INFINITY, f64::min) - a.iter().map(along).fold(f64::NEG_INFINITY, f64::max)
        })
        .fold(f64::NEG_INFINITY, f64::max)
}
