//! The open fingers of a grasp, and the palm.

use core::f64::consts::TAU;

use nalgebra::Point2;
use svg::node::element::{Circle, Group, Polygon};

use super::held::listed;
use super::paint::{Paint, points, px, ring};
use super::view::View;
use singulate_planner::scene::{Footprint, Gripper, ListedGrasp, Object};
use singulate_planner::statement::StatedGrasp;

/// The k open fingers of a grasp of an object at a place, and all that they cover while they close: rectangles from the object's
/// edge to the fingers' outer edge, w wide, turned. Finger 0 has a dot; the palm is a dashed circle.
pub(super) fn fingers(
    object: &Object,
    place: &Footprint,
    grasp: StatedGrasp,
    (gripper, view): (&Gripper, &View),
    paint: Paint,
) -> Group {
    let axis = grasp.at.unwrap_or(place.at());
    let listed = listed(object, place, grasp, gripper);
    let outer = listed.map_or_else(|| gripper.outer_distance(place), ListedGrasp::outer);
    let half = gripper.finger_width() / 2.0;
    let mut group = Group::new()
        .set("class", "fingers")
        .set("fill", paint.fill)
        .set("fill-opacity", "0.55")
        .set("stroke", paint.line)
        .set("stroke-width", "1");
    for (finger, number) in (0..gripper.fingers()).zip(0..) {
        let angle = grasp.yaw + TAU * f64::from(finger) / f64::from(gripper.fingers());
        let (cos, sin) = (libm::cos(angle), libm::sin(angle));
        let at = |along: f64, across: f64| {
            let (x, y) = (along * cos - across * sin, along * sin + across * cos);
            view.point(Point2::new(axis.x + x, axis.y + y))
        };
        let inner = listed.and_then(|listed| listed.inner().get::<usize>(number).copied());
        let inner = inner.unwrap_or(place.radius().min(outer));
        let corners = [at(inner, -half), at(outer, -half), at(outer, half), at(inner, half)];
        group = group.add(Polygon::new().set("points", points(corners)));
        if finger == 0 {
            let dot = view.length(half.min(gripper.clearance() / 2.0)) * 0.45;
            let dot = ring(at((inner + outer) / 2.0, 0.0), dot, "none").set("fill", paint.line);
            group = group.add(dot.set("fill-opacity", "1"));
        }
    }
    match gripper.palm() {
        Some(palm) => {
            group.add(self::palm(view.point(axis), view.length(palm.radius), paint.line).set("class", "palm"))
        }
        None => group,
    }
}

/// The palm: a dashed circle, px.
pub(super) fn palm(at: Point2<f64>, radius: f64, line: &str) -> Circle {
    ring(at, radius, line).set("stroke-dasharray", "2 3").set("stroke-width", px(0.8))
}
