//! The checker's own measures of footprints: from one to a point, to another, to a rectangle. It uses none of the
//! scene's, so that a fault of one is not a fault of both.

use nalgebra::{Point2, Vector2};

use crate::scene::{Footprint, Pose, Rectangle};
use crate::statement::StatedPose;

/// How far an object is from where it is said to stand, m.
pub(super) fn apart(a: Pose, b: StatedPose) -> f64 {
    (a.at - b.at).norm()
}

/// From the edge of a footprint to a point, m; negative inside.
pub(super) fn away(footprint: &Footprint, point: Point2<f64>) -> f64 {
    (footprint.pose().at - point).norm() - footprint.radius()
}

/// From edge to edge, m; negative where the two overlap.
pub(super) fn gap(a: &Footprint, b: &Footprint) -> f64 {
    let apart: Vector2<f64> = b.pose().at - a.pose().at;
    apart.norm() - a.radius() - b.radius()
}

/// The distance of points from the origin of a footprint within which its whole edge lies, m.
pub(super) fn extent(footprint: &Footprint) -> f64 {
    footprint.radius()
}

/// How far a footprint sticks out of the rectangle, m.
pub(super) fn overhang(footprint: &Footprint, top: Rectangle) -> f64 {
    let (c, min, max) = (footprint.pose().at, top.min(), top.max());
    footprint.radius() + (min.x - c.x).max(c.x - max.x).max(min.y - c.y).max(c.y - max.y)
}

/// How deep a footprint reaches into the rectangle, m.
pub(super) fn intrusion(footprint: &Footprint, area: Rectangle) -> f64 {
    let at = footprint.pose().at;
    let nearest = at.sup(&area.min()).inf(&area.max());
    footprint.radius() - (nearest - at).norm()
}
