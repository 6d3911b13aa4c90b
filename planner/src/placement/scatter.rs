//! Places that no border curve gives: round a point, and all over an area.

use nalgebra::{Point2, Vector2};

/// How many places there are round a point.
const SPIRAL: u32 = 512;
/// π(3 − √5): turns by it never line up.
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;
/// How many places are spread over an area.
const SPREAD: u32 = 1024;

/// Places up to `reach` (m) from `centre`, the denser the nearer.
pub(super) fn spiral(centre: Point2<f64>, reach: f64) -> impl Iterator<Item = Point2<f64>> {
    (1..=SPIRAL).map(move |n| {
        let (turn, apart) = (GOLDEN_ANGLE * f64::from(n), reach * f64::from(n) / f64::from(SPIRAL));
        centre + Vector2::new(libm::cos(turn), libm::sin(turn)) * apart
    })
}

/// Places spread evenly over the rectangle from `min` to `max`.
pub(super) fn even(min: Point2<f64>, max: Point2<f64>) -> impl Iterator<Item = Point2<f64>> {
    let size = max - min;
    (1..=SPREAD).map(move |n| min + size.component_mul(&Vector2::new(radical_inverse(n, 2), radical_inverse(n, 3))))
}

/// The digits of `n` mirrored at the point: Halton's sequence, evenly spread at any length.
fn radical_inverse(mut n: u32, base: u32) -> f64 {
    let (mut result, mut digit) = (0.0, 1.0 / f64::from(base));
    while n > 0 {
        result += f64::from(n % base) * digit;
        n /= base;
        digit /= f64::from(base);
    }
    result
}
