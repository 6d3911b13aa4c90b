//! The border curves of free space: circles round obstacles, lines along table and keep-outs.

use nalgebra::{Point2, Vector2};

use crate::scene::distance;

/// A circle on which a centre may lie.
#[derive(Debug, Clone, Copy)]
pub(super) struct Circle {
    pub(super) centre: Point2<f64>,
    pub(super) radius: f64,
}

/// A line x = `at` or y = `at`.
#[derive(Debug, Clone, Copy)]
pub(super) enum Line {
    Vertical(f64),
    Horizontal(f64),
}

impl Circle {
    /// Where two circles meet; touching ones meet twice in the same point.
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

    /// Where the circle meets a line.
    pub(super) fn meet_line(&self, line: Line) -> Option<[Point2<f64>; 2]> {
        let Point2 { coords: c } = self.centre;
        let offset = match line {
            Line::Vertical(at) => at - c.x,
            Line::Horizontal(at) => at - c.y,
        };
        let square = self.radius * self.radius - offset * offset;
        let half = if square < 0.0 { return None } else { square.sqrt() };
        Some(match line {
            Line::Vertical(at) => [Point2::new(at, c.y - half), Point2::new(at, c.y + half)],
            Line::Horizontal(at) => [Point2::new(c.x - half, at), Point2::new(c.x + half, at)],
        })
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
        assert_eq!(a.meet_line(Line::Vertical(3.0)), Some([Point2::new(3.0, -4.0), Point2::new(3.0, 4.0)]));
        assert_eq!(a.meet_line(Line::Horizontal(6.0)), None);
    }
}
