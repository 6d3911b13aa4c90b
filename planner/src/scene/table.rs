//! The table and its keep-outs.

use core::fmt;

use nalgebra::Point2;

/// An axis-parallel rectangle with positive sides, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rectangle {
    pub(super) min: Point2<f64>,
    pub(super) max: Point2<f64>,
}

impl Rectangle {
    /// Its sides along x and y, m.
    pub fn sides(&self) -> (f64, f64) {
        (self.max.x - self.min.x, self.max.y - self.min.y)
    }

    /// Lower left corner.
    pub fn min(&self) -> Point2<f64> {
        self.min
    }

    /// Upper right corner.
    pub fn max(&self) -> Point2<f64> {
        self.max
    }

    /// True if the point is inside or on the border.
    pub fn contains(&self, point: Point2<f64>) -> bool {
        (self.min.x..=self.max.x).contains(&point.x) && (self.min.y..=self.max.y).contains(&point.y)
    }

    /// Least distance from a point inside to the border, m; negative for a point outside.
    pub fn depth(&self, point: Point2<f64>) -> f64 {
        let (x, y) = (point.x, point.y);
        (x - self.min.x).min(self.max.x - x).min(y - self.min.y).min(self.max.y - y)
    }

    /// Distance from a point to the rectangle, m; 0 inside.
    pub fn distance(&self, point: Point2<f64>) -> f64 {
        let x = (self.min.x - point.x).max(point.x - self.max.x).max(0.0);
        let y = (self.min.y - point.y).max(point.y - self.max.y).max(0.0);
        (x * x + y * y).sqrt()
    }
}

impl fmt::Display for Rectangle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { min, max } = self;
        write!(f, "x from {} to {}, y from {} to {}", min.x, max.x, min.y, max.y)
    }
}

/// The table top.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    pub(super) top: Rectangle,
    pub(super) keep_out: Vec<Rectangle>,
}

impl Table {
    /// The whole top.
    pub fn top(&self) -> Rectangle {
        self.top
    }

    /// Rectangles on which nothing may be placed; they don't block fingers.
    pub fn keep_out(&self) -> &[Rectangle] {
        &self.keep_out
    }
}
