//! What an object covers of the table, turned and placed by the checker itself.

use nalgebra::{Point2, Vector2};
use smallvec::SmallVec;

use crate::scene::{Footprint, Pose, Shape};

/// A convex core grown by a radius, where it stands.
#[derive(Debug, Clone)]
pub(super) struct Body {
    pub(super) pose: Pose,
    /// The core's sides, relative to the pose's origin; none for a point there.
    pub(super) sides: Sides,
    /// How far the core is grown, m.
    pub(super) radius: f64,
    /// All of it is within this distance from the pose's origin, m.
    pub(super) extent: f64,
}

/// The sides of a core, counter-clockwise; of a segment both senses. A point has none.
pub(super) type Sides = SmallVec<[Side; 4]>;

/// One side of a core.
#[derive(Debug, Clone, Copy)]
pub(super) struct Side {
    /// The corner where it begins, m.
    pub(super) start: Vector2<f64>,
    /// Its direction, of length 1. The core is to the left.
    pub(super) along: Vector2<f64>,
    /// m.
    pub(super) length: f64,
}

impl Side {
    /// Away from the core, of length 1.
    pub(super) fn outward(&self) -> Vector2<f64> {
        Vector2::new(self.along.y, -self.along.x)
    }

    /// The corner where it ends.
    pub(super) fn end(&self) -> Vector2<f64> {
        self.start + self.along * self.length
    }

    /// The point of the side that is nearest to `point`.
    pub(super) fn nearest(&self, point: Vector2<f64>) -> Vector2<f64> {
        let share = self.along.dot(&(point - self.start)).clamp(0.0, self.length);
        self.start + self.along * share
    }

    /// The same turned by the angle with this cosine and sine.
    pub(super) fn rotated(&self, [cos, sin]: [f64; 2]) -> Self {
        Self { start: rotated(self.start, [cos, sin]), along: rotated(self.along, [cos, sin]), length: self.length }
    }
}

impl Body {
    /// A shape at a pose.
    pub(super) fn new(shape: &Shape, pose: Pose) -> Self {
        let sides = sides(shape, pose.yaw);
        let farthest = sides.iter().map(|side| side.start.norm()).fold(0.0, f64::max);
        Self { pose, sides, radius: shape.radius(), extent: farthest + shape.radius() }
    }

    /// An object where the scene has it.
    pub(super) fn of(footprint: &Footprint) -> Self {
        Self::new(footprint.shape(), footprint.pose())
    }

    /// True for a point that is grown: a disc.
    pub(super) fn is_disc(&self) -> bool {
        self.sides.is_empty()
    }

    /// A point of the object's own frame, on the table.
    pub(super) fn point(&self, own: Vector2<f64>) -> Point2<f64> {
        self.pose.at + rotated(own, cos_sin(self.pose.yaw))
    }
}

/// The sides of a shape's core in a frame turned by `yaw`, rad.
pub(super) fn sides(shape: &Shape, yaw: f64) -> Sides {
    let corners = shape.core().map_or(&[][..], |core| core.vertices());
    let by = cos_sin(yaw);
    let side = |at: usize| {
        let (start, end) = (corners[at], corners[(at + 1) % corners.len()]);
        let length = (end - start).norm();
        Side { start, along: (end - start) / length, length }.rotated(by)
    };
    (0..corners.len()).map(side).collect()
}

/// Cosine and sine of an angle.
pub(super) fn cos_sin(angle: f64) -> [f64; 2] {
    let (sin, cos) = libm::sincos(angle);
    [cos, sin]
}

/// A vector turned by the angle with this cosine and sine.
pub(super) fn rotated(v: Vector2<f64>, [cos, sin]: [f64; 2]) -> Vector2<f64> {
    Vector2::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y)
}
