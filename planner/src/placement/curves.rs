//! The border curves of free space: circles and arcs round obstacles, lines along table, keep-outs and straight edges.

use nalgebra::{Point2, Vector2};

use crate::scene::distance;

/// A circle on which an origin may lie, or an arc of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Circle {
    pub(super) centre: Point2<f64>,
    pub(super) radius: f64,
    /// The directions of an arc's ends, counter-clockwise and less than half a turn apart; `None` for the whole circle.
    pub(super) span: Option<[Vector2<f64>; 2]>,
}

/// A straight piece in any direction.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    pub(super) start: Point2<f64>,
    pub(super) end: Point2<f64>,
}

/// A segment of a line x = `at` or y = `at`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Side {
    pub(super) direction: Direction,
    pub(super) at: f64,
    /// Its ends, in the other coordinate.
    pub(super) from: f64,
    pub(super) to: f64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Direction {
    Vertical,
    Horizontal,
}

impl Side {
    fn point(&self, along: f64) -> Point2<f64> {
        match self.direction {
            Direction::Vertical => Point2::new(self.at, along),
            Direction::Horizontal => Point2::new(along, self.at),
        }
    }

    /// The same as an edge; `None` for a side of a table that is too small.
    pub(super) fn edge(&self) -> Option<Edge> {
        (self.from <= self.to).then(|| Edge { start: self.point(self.from), end: self.point(self.to) })
    }

    fn holds(&self, along: f64) -> bool {
        (self.from..=self.to).contains(&along)
    }

    /// The point where it crosses a side of the other direction.
    pub(super) fn meet(&self, other: &Self) -> Option<Point2<f64>> {
        (self.direction != other.direction && self.holds(other.at) && other.holds(self.at))
            .then(|| self.point(other.at))
    }

    /// Its ends, and the foot of the perpendicular from `point` if that lies between them.
    pub(super) fn extremes(&self, point: Point2<f64>) -> impl Iterator<Item = Point2<f64>> + use<> {
        let along = if self.direction == Direction::Vertical { point.y } else { point.x };
        let foot = self.holds(along).then(|| self.point(along));
        let ends = (self.from <= self.to).then(|| [self.point(self.from), self.point(self.to)]);
        ends.into_iter().flatten().chain(foot)
    }
}

impl Edge {
    /// The point where it crosses another one.
    pub(super) fn meet(&self, other: &Self) -> Option<Point2<f64>> {
        let (along, others, towards) = (self.end - self.start, other.end - other.start, other.start - self.start);
        // Shares of both lengths, times `across`: most pairs don't meet, and need no division.
        let across = along.perp(&others);
        let sign = if across < 0.0 { -1.0 } else { 1.0 };
        let within = |share: f64| (0.0..=across.abs()).contains(&(sign * share));
        let share = towards.perp(&others);
        (across != 0.0 && within(share) && within(towards.perp(&along))).then(|| self.start + along * (share / across))
    }

    /// Its ends, and the foot of the perpendicular from `point` if that lies between them.
    pub(super) fn extremes(&self, point: Point2<f64>) -> impl Iterator<Item = Point2<f64>> + use<> {
        let (start, along) = (self.start, self.end - self.start);
        let share = (point - start).dot(&along) / along.dot(&along);
        let foot = (0.0..=1.0).contains(&share).then(|| start + along * share);
        [self.start, self.end].into_iter().chain(foot)
    }

    /// Its least distance from a point, m.
    pub(super) fn nearest(&self, point: Point2<f64>) -> f64 {
        self.extremes(point).map(|on| distance(on, point)).fold(f64::INFINITY, f64::min)
    }
}

impl Circle {
    /// A whole circle.
    pub(super) fn whole(centre: Point2<f64>, radius: f64) -> Self {
        Self { centre, radius, span: None }
    }

    /// True if a point of the circle is on the arc.
    fn holds(&self, point: Point2<f64>) -> bool {
        let away = point - self.centre;
        self.span.is_none_or(|[from, to]| from.perp(&away) >= 0.0 && away.perp(&to) >= 0.0)
    }

    /// The points where the circle meets a straight piece.
    pub(super) fn meet_edge(&self, edge: &Edge) -> impl Iterator<Item = Point2<f64>> + use<> {
        let (along, towards) = (edge.end - edge.start, self.centre - edge.start);
        let length = along.dot(&along);
        let (middle, away) = (towards.dot(&along) / length, along.perp(&towards));
        let square = self.radius * self.radius / length - away * away / (length * length);
        let shares = (square >= 0.0).then(|| [middle - square.sqrt(), middle + square.sqrt()]);
        let (circle, start) = (*self, edge.start);
        let within = shares.into_iter().flatten().filter(|share| (0.0..=1.0).contains(share));
        within.map(move |share| start + along * share).filter(move |point| circle.holds(*point))
    }

    /// The two points where two circles meet; the same point twice where they touch.
    pub(super) fn meet(&self, other: &Self) -> impl Iterator<Item = Point2<f64>> + use<> {
        let (one, two) = (*self, *other);
        self.meet_whole(other).into_iter().flatten().filter(move |point| one.holds(*point) && two.holds(*point))
    }

    fn meet_whole(&self, other: &Self) -> Option<[Point2<f64>; 2]> {
        let apart = distance(self.centre, other.centre);
        if apart <= 0.0 || apart > self.radius + other.radius || apart < (self.radius - other.radius).abs() {
            return None;
        }
        let along = (apart * apart + self.radius * self.radius - other.radius * other.radius) / (2.0 * apart);
        let across = (self.radius * self.radius - along * along).max(0.0).sqrt();
        let direction = (other.centre - self.centre) / apart;
        let foot = self.centre + direction * along;
        let aside = Vector2::new(-direction.y, direction.x) * across;
        Some([foot + aside, foot - aside])
    }

    /// The points where the circle meets a side.
    pub(super) fn meet_side(&self, side: &Side) -> impl Iterator<Item = Point2<f64>> + use<> {
        let Point2 { coords: c } = self.centre;
        let (across, along) = match side.direction {
            Direction::Vertical => (side.at - c.x, c.y),
            Direction::Horizontal => (side.at - c.y, c.x),
        };
        let square = self.radius * self.radius - across * across;
        let points = (square >= 0.0).then(|| [along - square.sqrt(), along + square.sqrt()]);
        let (side, circle) = (*side, *self);
        let on_side = points.into_iter().flatten().filter(move |&along| side.holds(along));
        on_side.map(move |along| side.point(along)).filter(move |point| circle.holds(*point))
    }

    /// The points of the circle nearest to and farthest from `point`.
    pub(super) fn extremes(&self, point: Point2<f64>) -> impl Iterator<Item = Point2<f64>> + use<> {
        let apart = distance(self.centre, point);
        let direction = if apart > 0.0 { (point - self.centre) / apart } else { Vector2::new(1.0, 0.0) };
        let circle = *self;
        let both = [self.centre + direction * self.radius, self.centre - direction * self.radius];
        both.into_iter().filter(move |point| circle.holds(*point))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn circles_meet_where_both_are() {
        let circle = |x, radius| Circle::whole(Point2::new(x, 0.0), radius);
        let a = circle(0.0, 5.0);
        let meet = |other: Circle| a.meet(&other).collect::<Vec<_>>();
        assert_eq!(meet(circle(6.0, 5.0)), [Point2::new(3.0, 4.0), Point2::new(3.0, -4.0)]);
        assert_eq!(meet(circle(11.0, 5.0)), []);
        assert_eq!(meet(circle(1.0, 1.0)), []);
        let upper = Circle { span: Some([Vector2::new(0.0, 1.0), Vector2::new(-1.0, 0.1)]), ..circle(6.0, 5.0) };
        assert_eq!(meet(upper), [Point2::new(3.0, 4.0)]);
    }

    #[test]
    fn edges_meet_within_their_ends() {
        let edge = |[a, b]: [f64; 2], [c, d]: [f64; 2]| Edge { start: Point2::new(a, b), end: Point2::new(c, d) };
        let up = edge([0.0, 0.0], [2.0, 2.0]);
        assert_eq!(up.meet(&edge([0.0, 2.0], [2.0, 0.0])), Some(Point2::new(1.0, 1.0)));
        assert_eq!(up.meet(&edge([3.0, 0.0], [3.0, 9.0])), None);
        assert_eq!(up.meet(&edge([1.0, 0.0], [3.0, 2.0])), None);
        let circle = Circle::whole(Point2::new(0.0, 0.0), 5.0);
        let met: Vec<_> = circle.meet_edge(&edge([3.0, 0.0], [3.0, 9.0])).collect();
        assert_eq!(met, [Point2::new(3.0, 4.0)]);
        assert_eq!(up.nearest(Point2::new(3.0, 3.0)), 2_f64.sqrt());
    }

    #[test]
    fn sides_meet_only_within_their_ends() {
        let circle = Circle::whole(Point2::new(0.0, 0.0), 5.0);
        let side = |direction, at, from, to| Side { direction, at, from, to };
        let meet = |side: Side| circle.meet_side(&side).collect::<Vec<_>>();
        assert_eq!(meet(side(Direction::Vertical, 3.0, -9.0, 9.0)), [Point2::new(3.0, -4.0), Point2::new(3.0, 4.0)]);
        assert_eq!(meet(side(Direction::Vertical, 3.0, 0.0, 9.0)), [Point2::new(3.0, 4.0)]);
        assert_eq!(meet(side(Direction::Horizontal, 6.0, -9.0, 9.0)), []);
        let across = side(Direction::Horizontal, 1.0, -9.0, 9.0);
        assert_eq!(across.meet(&side(Direction::Vertical, 2.0, 0.0, 3.0)), Some(Point2::new(2.0, 1.0)));
        assert_eq!(across.meet(&side(Direction::Vertical, 2.0, 2.0, 3.0)), None);
        assert_eq!(across.meet(&across), None);
    }
}
