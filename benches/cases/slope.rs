//! Growth as a slope.

use super::cases::count;

/// The slope of a line through some points, by least squares.
pub(crate) fn slope(points: &[(f64, f64)]) -> f64 {
    let n = count(points.len());
    let (x, y) = points.iter().fold((0.0, 0.0), |(x, y), point| (x + point.0 / n, y + point.1 / n));
    let (above, below) =
        points.iter().fold((0.0, 0.0), |(a, b), p| (a + (p.0 - x) * (p.1 - y), b + (p.0 - x) * (p.0 - x)));
    above / below
}
