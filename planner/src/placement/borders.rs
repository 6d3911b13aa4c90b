//! The borders of free space, where an object's origin may stand: one inside the table's edge, one round each obstacle and
//! each keep-out.

use nalgebra::Point2;
use smallvec::SmallVec;

use super::INSIDE;
use super::curves::{Circle, Direction, Side};
use crate::scene::{Footprint, Gripper, Rectangle, Shape, distance};

/// The curves of one border.
#[derive(Debug, Clone, Default)]
pub(super) struct Border {
    pub(super) circles: SmallVec<[Circle; 4]>,
    pub(super) sides: SmallVec<[Side; 4]>,
}

impl Border {
    /// Where the origin of `shape` may stand beside an obstacle: as near as `gap` (m) allows; where the obstacle no longer
    /// hinders the release; where the shape no longer hinders a grasp of the obstacle.
    pub(super) fn beside(shape: Shape, obstacle: &Footprint, gripper: &Gripper, gap: f64) -> Self {
        let (Shape::Disc { radius }, Shape::Disc { radius: others }) = (shape, obstacle.shape);
        let (own, clear) = (Footprint { shape, ..*obstacle }, gripper.margin() + INSIDE);
        let mut radii: SmallVec<[f64; 4]> = SmallVec::from_slice(&[
            radius + others + gap + INSIDE,
            gripper.corner_distance(&own) + others + clear,
            gripper.corner_distance(obstacle) + radius + clear,
        ]);
        radii.dedup_by(|a, b| (*a - *b).abs() < INSIDE);
        let circles = radii.into_iter().map(|radius| Circle { centre: obstacle.at(), radius }).collect();
        Self { circles, sides: SmallVec::new() }
    }

    /// Where the origin of `shape` may stand inside a rectangle, `gap` (m) from its edge. Empty where the rectangle is too
    /// small.
    pub(super) fn inside(shape: Shape, area: &Rectangle, gap: f64) -> Self {
        let keep = keep(shape, gap);
        let inset = nalgebra::Vector2::new(keep, keep);
        Self { circles: SmallVec::new(), sides: sides(area.min() + inset, area.max() - inset, 0.0) }
    }

    /// Where the origin of `shape` may stand outside a rectangle, `gap` (m) from it: the sides moved outwards, with round
    /// corners.
    pub(super) fn outside(shape: Shape, area: &Rectangle, gap: f64) -> Self {
        let keep = keep(shape, gap);
        let (min, max) = (area.min(), area.max());
        let corners = [min, max, Point2::new(min.x, max.y), Point2::new(max.x, min.y)];
        let circles = corners.into_iter().map(|centre| Circle { centre, radius: keep }).collect();
        Self { circles, sides: sides(min, max, keep) }
    }

    /// Adds the points where two borders meet.
    pub(super) fn meet(&self, other: &Self, mut add: impl FnMut(Point2<f64>)) {
        for circle in &self.circles {
            other.circles.iter().filter_map(|theirs| circle.meet(theirs)).flatten().for_each(&mut add);
            other.sides.iter().flat_map(|side| circle.meet_side(side)).for_each(&mut add);
        }
        for side in &self.sides {
            other.circles.iter().flat_map(|theirs| theirs.meet_side(side)).for_each(&mut add);
            other.sides.iter().filter_map(|theirs| side.meet(theirs)).for_each(&mut add);
        }
    }

    /// Adds the points of its curves nearest to and farthest from `point`.
    pub(super) fn extremes(&self, point: Point2<f64>, mut add: impl FnMut(Point2<f64>)) {
        self.circles.iter().flat_map(|circle| circle.extremes(point)).for_each(&mut add);
        self.sides.iter().flat_map(|side| side.extremes(point)).for_each(add);
    }

    /// No point of its circles is nearer to `point` than this, m. For a border without sides: that round an obstacle.
    pub(super) fn nearest_of_circles(&self, point: Point2<f64>) -> f64 {
        let away = |circle: &Circle| (distance(circle.centre, point) - circle.radius).abs();
        self.circles.iter().map(away).fold(f64::INFINITY, f64::min)
    }

    /// No point of the border is farther from `point` than this, m.
    pub(super) fn farthest(&self, point: Point2<f64>) -> f64 {
        // Where there are sides and circles, the ends of the sides lie on the circles.
        self.circles.iter().map(|circle| distance(circle.centre, point) + circle.radius).fold(0.0, f64::max)
    }
}

/// How far the origin of `shape` stays from a border that the shape keeps a gap to, m.
pub(super) fn keep(shape: Shape, gap: f64) -> f64 {
    let Shape::Disc { radius } = shape;
    radius + gap + INSIDE
}

/// The sides of the rectangle, moved outwards by `keep`.
fn sides(min: Point2<f64>, max: Point2<f64>, keep: f64) -> SmallVec<[Side; 4]> {
    let vertical = |at| Side { direction: Direction::Vertical, at, from: min.y, to: max.y };
    let horizontal = |at| Side { direction: Direction::Horizontal, at, from: min.x, to: max.x };
    let (left, right) = (vertical(min.x - keep), vertical(max.x + keep));
    SmallVec::from_buf([left, right, horizontal(min.y - keep), horizontal(max.y + keep)])
}
