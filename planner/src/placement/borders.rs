//! The borders of free space, where an object's origin may stand: one inside the table's edge, one round each obstacle and
//! each keep-out.
//!
//! Round an obstacle these are the outlines of Minkowski sums: of its core and the mirrored core of what is set down, grown by
//! both radii and the gap.

use nalgebra::{Point2, Vector2};
use smallvec::SmallVec;

use super::INSIDE;
use super::curves::{Circle, Direction, Edge, Side};
use crate::scene::{Core, Footprint, Grasps, Gripper, Placed, Rectangle, distance};

/// The curves of one border.
#[derive(Debug, Clone, Default)]
pub(super) struct Border {
    pub(super) circles: SmallVec<[Circle; 4]>,
    pub(super) sides: SmallVec<[Side; 4]>,
    pub(super) edges: Vec<Edge>,
}

impl Border {
    /// Where the origin of `own` may stand beside an obstacle: as near as `gap` (m) allows; where the obstacle no longer
    /// hinders the release; where it no longer hinders a grasp of the obstacle. It is turned as `own` is.
    pub(super) fn beside(own: Placed<'_>, obstacle: Placed<'_>, gripper: &Gripper, gap: f64) -> Self {
        let (radius, others) = (own.footprint.radius(), obstacle.footprint.radius());
        let touching = radius + others + gap + INSIDE;
        let apart = apart(own, obstacle, gripper);
        let at = obstacle.footprint.at();
        let mirrored = own.footprint.core().map(Core::mirrored);
        let theirs = obstacle.footprint.core();
        if theirs.is_none() && mirrored.is_none() {
            let mut radii: SmallVec<[f64; 4]> = SmallVec::from_slice(&[touching, apart[0], apart[1]]);
            radii.dedup_by(|a, b| (*a - *b).abs() < INSIDE);
            let circles = radii.into_iter().map(|radius| Circle::whole(at, radius)).collect();
            return Self { circles, ..Self::default() };
        }
        let mut border = Self::round(at, theirs, mirrored.as_ref(), touching);
        border.circles.extend(apart.map(|radius| Circle::whole(at, radius)));
        border
    }

    /// No curve beside an obstacle is farther from the obstacle's origin than this, m.
    pub(super) fn span_beside(own: Placed<'_>, obstacle: Placed<'_>, gripper: &Gripper, gap: f64) -> f64 {
        let touching = own.footprint.circumradius() + obstacle.footprint.circumradius() + gap + INSIDE;
        apart(own, obstacle, gripper).into_iter().fold(touching, f64::max)
    }

    /// The outline of the sum of two cores, grown by `radius`.
    fn round(at: Point2<f64>, theirs: Option<&Core>, mine: Option<&Core>, radius: f64) -> Self {
        let mut border = Self::default();
        match (theirs, mine) {
            (Some(theirs), Some(mine)) => border.grow(at, Some(&theirs.sum(mine)), radius),
            _ => border.grow(at, theirs.or(mine), radius),
        }
        border
    }

    /// Where the origin of a footprint may stand inside a rectangle, `gap` (m) from its edge. Empty where the rectangle is too
    /// small.
    pub(super) fn inside(own: &Footprint, area: &Rectangle, gap: f64) -> Self {
        let [low, high] = insets(own, gap);
        Self { sides: sides(area.min() + low, area.max() - high, 0.0), ..Self::default() }
    }

    /// Where the origin of a footprint may stand outside a rectangle, `gap` (m) from it: the sides moved outwards, with round
    /// corners.
    pub(super) fn outside(own: &Footprint, area: &Rectangle, gap: f64) -> Self {
        let keep = own.radius() + gap + INSIDE;
        let (min, max) = (area.min(), area.max());
        if let Some(core) = own.core() {
            let middle = nalgebra::center(&min, &max);
            let corners = [min, Point2::new(max.x, min.y), max, Point2::new(min.x, max.y)].map(|at| at - middle);
            let mut border = Self::default();
            let area = Core::hull(&corners).map(|area| area.sum(&core.mirrored()));
            border.grow(middle, area.as_ref(), keep);
            return border;
        }
        let corners = [min, max, Point2::new(min.x, max.y), Point2::new(max.x, min.y)];
        let circles = corners.into_iter().map(|centre| Circle::whole(centre, keep)).collect();
        Self { circles, sides: sides(min, max, keep), ..Self::default() }
    }

    /// Adds the outline of a core at `at` that is grown by `radius`; `None` stands for a point.
    fn grow(&mut self, at: Point2<f64>, core: Option<&Core>, radius: f64) {
        let Some(core) = core else {
            self.circles.push(Circle::whole(at, radius));
            return;
        };
        let edges: SmallVec<[[Vector2<f64>; 2]; 8]> = core.edges().collect();
        let normal = |[start, end]: &[Vector2<f64>; 2]| {
            let along = (end - start) / distance(Point2::from(*start), Point2::from(*end));
            Vector2::new(along.y, -along.x)
        };
        let mut before = edges.last().map(normal).unwrap_or_default();
        for edge in &edges {
            let (normal, [start, end]) = (normal(edge), edge);
            // Round the end of a segment the arc is half a circle: in two quarters.
            let turned = Vector2::new(-before.y, before.x);
            let quarter = if before.perp(&normal).abs() < 1e-9 { Some(turned) } else { None };
            for span in [Some([before, quarter.unwrap_or(normal)]), quarter.map(|middle| [middle, normal])] {
                self.circles.extend(span.map(|span| Circle { centre: at + start, radius, span: Some(span) }));
            }
            self.edges.push(Edge { start: at + start + normal * radius, end: at + end + normal * radius });
            before = normal;
        }
    }

    /// Adds the points where two borders meet.
    pub(super) fn meet(&self, other: &Self, mut add: impl FnMut(Point2<f64>)) {
        for circle in &self.circles {
            other.circles.iter().flat_map(|theirs| circle.meet(theirs)).for_each(&mut add);
            other.sides.iter().flat_map(|side| circle.meet_side(side)).for_each(&mut add);
            other.edges.iter().flat_map(|edge| circle.meet_edge(edge)).for_each(&mut add);
        }
        for side in &self.sides {
            other.circles.iter().flat_map(|theirs| theirs.meet_side(side)).for_each(&mut add);
            other.sides.iter().filter_map(|theirs| side.meet(theirs)).for_each(&mut add);
            other.edges.iter().filter_map(|edge| edge.meet(&side.edge()?)).for_each(&mut add);
        }
        for edge in &self.edges {
            other.circles.iter().flat_map(|theirs| theirs.meet_edge(edge)).for_each(&mut add);
            other.sides.iter().filter_map(|side| edge.meet(&side.edge()?)).for_each(&mut add);
            other.edges.iter().filter_map(|theirs| edge.meet(theirs)).for_each(&mut add);
        }
    }

    /// Adds the points of its curves nearest to and farthest from `point`.
    pub(super) fn extremes(&self, point: Point2<f64>, mut add: impl FnMut(Point2<f64>)) {
        self.circles.iter().flat_map(|circle| circle.extremes(point)).for_each(&mut add);
        self.sides.iter().flat_map(|side| side.extremes(point)).for_each(&mut add);
        self.edges.iter().flat_map(|edge| edge.extremes(point)).for_each(add);
    }

    /// No point of its circles and edges is nearer to `point` than this, m. For a border without sides: that round an obstacle.
    pub(super) fn nearest(&self, point: Point2<f64>) -> f64 {
        let away = |circle: &Circle| (distance(circle.centre, point) - circle.radius).abs();
        let edges = self.edges.iter().map(|edge| edge.nearest(point));
        self.circles.iter().map(away).chain(edges).fold(f64::INFINITY, f64::min)
    }

    /// No point of the border is farther from `point` than this, m.
    pub(super) fn farthest(&self, point: Point2<f64>) -> f64 {
        // Where there are sides or edges and circles, their ends lie on the circles.
        self.circles.iter().map(|circle| distance(circle.centre, point) + circle.radius).fold(0.0, f64::max)
    }
}

/// How far apart two origins are where the obstacle no longer hinders the release, and where the object no longer hinders a grasp
/// of the obstacle, m. Of long objects that is only near enough.
fn apart(own: Placed<'_>, obstacle: Placed<'_>, gripper: &Gripper) -> [f64; 2] {
    let clear = gripper.margin() + INSIDE;
    [
        reach(own, gripper) + obstacle.footprint.circumradius() + clear,
        reach(obstacle, gripper) + own.footprint.circumradius() + clear,
    ]
}

/// How far from an object's origin another one can hinder a grasp of it, without the margin, m.
fn reach(placed: Placed<'_>, gripper: &Gripper) -> f64 {
    match (placed.object.grasps(), gripper.palm()) {
        (Grasps::EveryYaw, None) => gripper.corner_distance(placed.footprint),
        _ => placed.object.reach(gripper) - gripper.margin(),
    }
}

/// How far the origin of a footprint stays from the sides of a rectangle to which the footprint keeps a gap, m: from the lower
/// ones, then from the upper ones.
pub(super) fn insets(own: &Footprint, gap: f64) -> [Vector2<f64>; 2] {
    let [low, high] = own.extents();
    let keep = |extent: f64| extent + gap + INSIDE;
    [Vector2::new(keep(-low.x), keep(-low.y)), Vector2::new(keep(high.x), keep(high.y))]
}

/// The sides of the rectangle, moved outwards by `keep`.
fn sides(min: Point2<f64>, max: Point2<f64>, keep: f64) -> SmallVec<[Side; 4]> {
    let vertical = |at| Side { direction: Direction::Vertical, at, from: min.y, to: max.y };
    let horizontal = |at| Side { direction: Direction::Horizontal, at, from: min.x, to: max.x };
    let (left, right) = (vertical(min.x - keep), vertical(max.x + keep));
    SmallVec::from_buf([left, right, horizontal(min.y - keep), horizontal(max.y + keep)])
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::scene::{Pose, Shape};

    /// A polygon of some points, or a disc where they are on one line.
    fn footprint(points: &[(f64, f64)], radius: f64, (x, y, yaw): (f64, f64, f64)) -> Footprint {
        let points: Vec<Vector2<f64>> = points.iter().map(|&(x, y)| Vector2::new(x, y)).collect();
        let shape = Core::hull(&points).map_or(Shape::disc(radius + 0.01), |core| Shape::grown(Some(core), radius));
        Footprint::new(shape, Pose { at: Point2::new(x, y), yaw })
    }

    fn points() -> impl Strategy<Value = Vec<(f64, f64)>> {
        proptest::collection::vec((-0.3..0.3_f64, -0.3..0.3_f64), 1..7)
    }

    proptest! {
        #[test]
        fn a_border_keeps_the_gap_exactly_wherever_one_stands_on_it(
            (own, theirs) in (points(), points()), (radius, others) in (0.0..0.1_f64, 0.0..0.1_f64),
            place in (-1.0..1.0_f64, -1.0..1.0_f64, 0.0..7.0_f64), yaw in 0.0..7.0_f64, gap in 0.0..0.02_f64,
            asked in proptest::collection::vec((-2.0..2.0_f64, -2.0..2.0_f64), 8),
        ) {
            let own = footprint(&own, radius, (0.0, 0.0, yaw));
            let obstacle = footprint(&theirs, others, place);
            let mirrored = own.core().map(Core::mirrored);
            let keep = own.radius() + obstacle.radius() + gap;
            let border = Border::round(obstacle.at(), obstacle.core(), mirrored.as_ref(), keep);
            for (x, y) in asked {
                let (mut nearest, asked) = (f64::INFINITY, Point2::new(x, y));
                border.extremes(asked, |at| {
                    let stands = own.moved_to(Pose { at, yaw });
                    nearest = nearest.min(distance(at, asked));
                    assert!((stands.gap(&obstacle) - gap).abs() < 1e-9, "{at} {}", stands.gap(&obstacle));
                });
                // The nearest point of the border is among them: nearer ones are free or too near.
                let stands = own.moved_to(Pose { at: asked, yaw });
                if stands.gap(&obstacle) >= gap {
                    prop_assert!((stands.gap(&obstacle) - gap - nearest).abs() < 1e-9);
                }
            }
        }
    }
}
