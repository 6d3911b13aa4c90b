//! The footprint of an object on the table: its shape and its pose.

use std::sync::Arc;

use nalgebra::{Point2, Vector2};

use super::convex::{Core, direction, turned};
use super::shape::Shape;
use super::table::Rectangle;

/// Where an object's own frame stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// The frame's origin, m.
    pub at: Point2<f64>,
    /// How far the frame is turned, rad, counter-clockwise.
    pub yaw: f64,
}

/// A shape on the table.
#[derive(Debug, Clone, PartialEq)]
pub struct Footprint {
    shape: Shape,
    pose: Pose,
    /// The core, turned as the frame is.
    turned: Option<Arc<Core>>,
}

impl From<Point2<f64>> for Pose {
    fn from(at: Point2<f64>) -> Self {
        Self { at, yaw: 0.0 }
    }
}

impl Pose {
    /// Where a point of the frame is on the table, m.
    pub fn point(&self, own: Vector2<f64>) -> Point2<f64> {
        self.at + turned(own, direction(self.yaw))
    }
}

impl Footprint {
    /// A shape at a pose.
    pub fn new(shape: Shape, pose: Pose) -> Self {
        let turned = shape.core().map(|core| Arc::new(core.turned(direction(pose.yaw))));
        Self { shape, pose, turned }
    }

    /// A disc.
    pub fn disc(centre: Point2<f64>, radius: f64) -> Self {
        Self::new(Shape::disc(radius), centre.into())
    }

    /// The shape, in its own frame.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// Where its frame stands.
    pub fn pose(&self) -> Pose {
        self.pose
    }

    /// The origin of its frame, m.
    pub fn at(&self) -> Point2<f64> {
        self.pose.at
    }

    /// The core relative to [`Footprint::at`], turned as the frame is; `None` for a point there.
    pub fn core(&self) -> Option<&Core> {
        self.turned.as_deref()
    }

    /// How far the core is grown, m.
    pub fn radius(&self) -> f64 {
        self.shape.radius()
    }

    /// The same shape somewhere else.
    #[must_use]
    pub fn moved_to(&self, pose: Pose) -> Self {
        if self.turned.is_none() || pose.yaw == self.pose.yaw {
            return Self { pose, ..self.clone() };
        }
        Self::new(self.shape.clone(), pose)
    }

    /// No point of it is farther from [`Footprint::at`] than this, m.
    pub fn circumradius(&self) -> f64 {
        self.shape.circumradius()
    }

    /// How far it reaches along x and y from [`Footprint::at`], m: towards smaller coordinates, then towards greater ones.
    pub fn extents(&self) -> [Vector2<f64>; 2] {
        let grown = Vector2::repeat(self.radius());
        let Some(core) = self.core() else { return [-grown, grown] };
        let first = core.vertices()[0];
        let (min, max) = core.vertices().iter().fold((first, first), |(min, max), v| (min.inf(v), max.sup(v)));
        [min - grown, max + grown]
    }

    /// The corners of its bounding box: left below, right above.
    pub fn bounding_box(&self) -> [Point2<f64>; 2] {
        self.extents().map(|extent| self.at() + extent)
    }

    /// True if its edge is nearer to `point` than `reach`, m.
    pub fn comes_within(&self, point: Point2<f64>, reach: f64) -> bool {
        let reach = reach + self.radius();
        match self.core() {
            None => distance(self.at(), point) < reach,
            Some(core) => core.comes_within(point - self.at(), reach),
        }
    }

    /// True if another footprint is at least `gap` away from edge to edge, m.
    pub fn keeps_from(&self, other: &Self, gap: f64) -> bool {
        let (towards, keep) = (other.at() - self.at(), gap + self.radius() + other.radius());
        match (self.core(), other.core()) {
            (None, None) => self.gap(other) >= gap,
            (Some(core), None) => !core.comes_within(towards, keep),
            (None, Some(core)) => !core.comes_within(-towards, keep),
            (Some(core), Some(others)) => core.keeps_from(others, towards, keep),
        }
    }

    /// Distance from edge to edge, m; where the two overlap minus the least translation that parts them.
    pub fn gap(&self, other: &Self) -> f64 {
        let towards = other.at() - self.at();
        let apart = match (self.core(), other.core()) {
            (None, None) => distance(self.at(), other.at()),
            (Some(core), None) => core.distance_to_point(towards),
            (None, Some(core)) => core.distance_to_point(-towards),
            (Some(core), Some(others)) => core.distance_to(others, towards),
        };
        apart - self.radius() - other.radius()
    }

    /// Least distance from its edge to the border of a rectangle round its origin, m; negative where it sticks out.
    pub fn gap_inside(&self, area: &Rectangle) -> f64 {
        let depth = match self.core() {
            None => area.depth(self.at()),
            Some(core) => core.vertices().iter().map(|v| area.depth(self.at() + v)).fold(f64::INFINITY, f64::min),
        };
        depth - self.radius()
    }

    /// Distance from its edge to a rectangle, m; negative where they overlap.
    pub fn gap_outside(&self, area: &Rectangle) -> f64 {
        let apart = match self.core() {
            None => area.distance(self.at()),
            Some(core) => core.distance_to_box(area.min() - self.at(), area.max() - self.at()),
        };
        apart - self.radius()
    }
}

/// Distance of two points, m. Written as √(x²+y²), which is the same on every machine; `hypot` is not.
pub fn distance(a: Point2<f64>, b: Point2<f64>) -> f64 {
    let (x, y) = (b.x - a.x, b.y - a.y);
    (x * x + y * y).sqrt()
}
