//! The footprint of an object on the table: its shape and its pose.

use nalgebra::Point2;

use super::limits::LENGTH_RANGE;
use super::table::Rectangle;

/// Where an object's own frame stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// The frame's origin, m.
    pub at: Point2<f64>,
}

/// A shape in its own frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// A disc round the origin.
    Disc {
        /// m, positive.
        radius: f64,
    },
}

/// An unchecked shape. `None` means that the part was absent or unreadable.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ShapeDraft {
    /// The radius of a disc, m.
    pub radius: Option<f64>,
}

/// A shape on the table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Footprint {
    /// The shape.
    pub shape: Shape,
    /// Where it stands.
    pub pose: Pose,
}

impl From<Point2<f64>> for Pose {
    fn from(at: Point2<f64>) -> Self {
        Self { at }
    }
}

impl ShapeDraft {
    /// A disc.
    pub fn disc(radius: f64) -> Self {
        Self { radius: Some(radius) }
    }

    /// The shape, if every length is in its range; `ranged` reports those that are not, by the name of their field.
    pub(super) fn checked(
        &self,
        mut ranged: impl FnMut(Option<f64>, (f64, f64), &'static str) -> Option<f64>,
    ) -> Option<Shape> {
        ranged(self.radius, LENGTH_RANGE, "radius").map(|radius| Shape::Disc { radius })
    }
}

impl Shape {
    /// The radius of the greatest circle round the origin inside the shape, m.
    pub fn inradius(&self) -> f64 {
        match *self {
            Self::Disc { radius } => radius,
        }
    }

    /// The radius of the least circle round the origin that holds the shape, m.
    pub fn circumradius(&self) -> f64 {
        match *self {
            Self::Disc { radius } => radius,
        }
    }
}

impl Footprint {
    /// A disc.
    pub fn disc(centre: Point2<f64>, radius: f64) -> Self {
        Self { shape: Shape::Disc { radius }, pose: centre.into() }
    }

    /// The origin of its frame, m.
    pub fn at(&self) -> Point2<f64> {
        self.pose.at
    }

    /// The same shape somewhere else.
    #[must_use]
    pub fn moved_to(self, pose: Pose) -> Self {
        Self { pose, ..self }
    }

    /// No point of it is farther from [`Footprint::at`] than this, m.
    pub fn circumradius(&self) -> f64 {
        self.shape.circumradius()
    }

    /// The corners of its bounding box: left below, right above.
    pub fn bounding_box(&self) -> [Point2<f64>; 2] {
        let (at, radius) = (self.at(), self.circumradius());
        [Point2::new(at.x - radius, at.y - radius), Point2::new(at.x + radius, at.y + radius)]
    }

    /// True if its edge is nearer to `point` than `reach`, m.
    pub fn comes_within(&self, point: Point2<f64>, reach: f64) -> bool {
        match self.shape {
            Shape::Disc { radius } => distance(self.at(), point) < reach + radius,
        }
    }

    /// Distance from edge to edge, m; negative where the two overlap.
    pub fn gap(&self, other: &Self) -> f64 {
        match (self.shape, other.shape) {
            (Shape::Disc { radius }, Shape::Disc { radius: others }) => {
                distance(self.at(), other.at()) - radius - others
            }
        }
    }

    /// Least distance from its edge to the border of a rectangle round its origin, m; negative where it sticks out.
    pub fn gap_inside(&self, area: &Rectangle) -> f64 {
        match self.shape {
            Shape::Disc { radius } => area.depth(self.at()) - radius,
        }
    }

    /// Distance from its edge to a rectangle, m; negative where they overlap.
    pub fn gap_outside(&self, area: &Rectangle) -> f64 {
        match self.shape {
            Shape::Disc { radius } => area.distance(self.at()) - radius,
        }
    }
}

/// Distance of two points, m. Written as √(x²+y²), which is the same on every machine; `hypot` is not.
pub fn distance(a: Point2<f64>, b: Point2<f64>) -> f64 {
    let (x, y) = (b.x - a.x, b.y - a.y);
    (x * x + y * y).sqrt()
}
