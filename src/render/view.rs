//! From metres on the table to pixels of the drawing.

use nalgebra::{Point2, Vector2};

use super::held;
use super::roles::Roles;
use singulate_planner::scene::{Footprint, Object, Scene};
use singulate_planner::statement::{StatedGrasp, Statement};

/// Padding on all sides, px.
pub(super) const PADDING: f64 = 24.0;
/// Space above the table for the headline, px.
const HEADER: f64 = 84.0;
/// The largest table in the drawing, px.
const LARGEST: (f64, f64) = (1000.0, 800.0);
/// The least width, px, so that headline and legend have room beside a narrow table.
const LEAST_WIDTH: f64 = 720.0;
/// The largest part shown beyond the table's edge, as a share of the table's longer side.
const OVERHANG: f64 = 0.2;

/// The part of the world that is drawn, and its scale.
#[derive(Debug)]
pub(super) struct View {
    /// px per metre.
    scale: f64,
    /// Upper left corner of the drawn area, m.
    corner: Point2<f64>,
    /// The pixel of that corner.
    origin: (f64, f64),
    /// Size of the drawn area, px.
    extent: (f64, f64),
}

impl View {
    /// The table to scale, with objects that hang over its edge. The lines above it take `added` px more than usual.
    pub(super) fn new(scene: &Scene, stated: &Statement, roles: &Roles<'_>, added: f64) -> Self {
        let top = scene.table().top();
        let (mut min, mut max) = (top.min(), top.max());
        let allowance = OVERHANG * (max.x - min.x).max(max.y - min.y);
        for [left_below, right_above] in drawn(scene, stated, roles) {
            (min, max) = (min.inf(&left_below), max.sup(&right_above));
        }
        let (left, right) = (min.x.max(top.min().x - allowance), max.x.min(top.max().x + allowance));
        let (below, above) = (min.y.max(top.min().y - allowance), max.y.min(top.max().y + allowance));
        let scale = (LARGEST.0 / (right - left)).min(LARGEST.1 / (above - below));
        let extent = ((right - left) * scale, (above - below) * scale);
        let origin = (PADDING + (LEAST_WIDTH - 2.0 * PADDING - extent.0).max(0.0) / 2.0, HEADER + added);
        Self { scale, corner: Point2::new(left, above), origin, extent }
    }

    /// px per metre.
    pub(super) fn scale(&self) -> f64 {
        self.scale
    }

    /// A length, px.
    pub(super) fn length(&self, metres: f64) -> f64 {
        metres * self.scale
    }

    /// A point, px. The table's y points up, the drawing's down.
    pub(super) fn point(&self, at: Point2<f64>) -> Point2<f64> {
        let (x, y) = (self.length(at.x - self.corner.x), self.length(self.corner.y - at.y));
        Point2::new(self.origin.0 + x, self.origin.1 + y)
    }

    /// The drawn area: x, y, width, height, px, with space for the strokes.
    pub(super) fn frame(&self) -> (f64, f64, f64, f64) {
        let ((x, y), (width, height)) = (self.origin, self.extent);
        (x - 3.0, y - 3.0, width + 6.0, height + 6.0)
    }

    /// The whole drawing's width, px.
    pub(super) fn width(&self) -> f64 {
        (self.extent.0 + 2.0 * PADDING).max(LEAST_WIDTH)
    }

    /// Height of headline and table, px; drop-offs and legend come below.
    pub(super) fn height(&self) -> f64 {
        self.origin.1 + self.extent.1 + PADDING
    }
}

/// The bounding boxes of all that must be visible: objects, and the reach of every drawn grasp.
fn drawn<'a>(
    scene: &'a Scene,
    stated: &'a Statement,
    roles: &'a Roles<'a>,
) -> impl Iterator<Item = [Point2<f64>; 2]> + 'a {
    let gripper = scene.gripper();
    let hand = move |object: &Object, place: &Footprint, grasp: StatedGrasp| {
        let (axis, reach) =
            (grasp.at.unwrap_or(place.at()), Vector2::repeat(held::reach(object, place, grasp, gripper)));
        [axis - reach, axis + reach]
    };
    let moved = stated.steps().iter().flat_map(move |step| {
        let object = roles.object(step.object());
        let held = move |object: &'a Object| {
            step.holds().flat_map(move |(pose, grasp)| {
                let place = object.footprint().moved_to(pose.into());
                [place.bounding_box(), hand(object, &place, grasp)]
            })
        };
        object.into_iter().flat_map(held)
    });
    let target = stated.target_grasp.zip(roles.grasped());
    let target = target.map(move |(grasp, object)| hand(object, object.footprint(), grasp));
    scene.objects().iter().map(|object| object.footprint().bounding_box()).chain(moved).chain(target)
}
