//! The border curves of free space: circles round obstacles, lines along table and keep-outs.

use nalgebra::{Point2, Vector2};

use crate::scene::distance;

/// A circle on which a centre may lie.
#[derive(Debug, Clone, Copy)]
pub(super) struct Circle {
    pub(super) centre: Point2<f64>,
    pub(super) radius: f64,
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

impl Circle {
    /// The two points where two circles meet; the same point twice where they touch.
    pub(super) fn meet(&self, other: &Self) -> Option<[Point2<f64>; 2]> {
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
        let side = *side;
        points.into_iter().flatten().filter(move |&along| side.holds(along)).map(move |along| side.point(along))
    }

    /// The points of the circle nearest to and farthest from `point`.
    pub(super) fn extremes(&self, point: Point2<f64>) -> [Point2<f64>; 2] {
        let apart = distance(self.centre, point);
        let direction = if apart > 0.0 { (point - self.centre) / apart } else { Vector2::new(1.0, 0.0) };
        [self.centre + direction * self.radius, self.centre - direction * self.radius]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn circles_meet_where_both_are() {
        let a = Circle { centre: Point2::new(0.0, 0.0), radius: 5.0 };
        let b = Circle { centre: Point2::new(6.0, 0.0), radius: 5.0 };
        assert_eq!(a.meet(&b), Some([Point2::new(3.0, 4.0), Point2::new(3.0, -4.0)]));
        assert_eq!(a.meet(&Circle { centre: Point2::new(11.0, 0.0), radius: 5.0 }), None);
        assert_eq!(a.meet(&Circle { centre: Point2::new(1.0, 0.0), radius: 1.0 }), None);
    }

    #[test]
    fn sides_meet_only_within_their_ends() {
        let circle = Circle { centre: Point2::new(0.0, 0.0), radius: 5.0 };
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
