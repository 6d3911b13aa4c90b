//! Scattered places, beside those on border curves: a spiral round a point, and an even spread over an area.

use nalgebra::{Point2, Vector2};

/// The number of places of a spiral.
const SPIRAL: u32 = 512;
/// The golden angle π(3 − √5), rad: multiples of it never line up.
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;
/// The number of places spread over an area.
const SPREAD: u32 = 1024;

/// Places up to `reach` (m) from `centre`, denser near it (Vogel's spiral).
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

/// The radical inverse of `n`: its digits mirrored at the point. Two coprime bases give the Halton sequence, which is
/// evenly spread at any length.
fn radical_inverse(mut n: u32, base: u32) -> f64 {
    let (mut result, mut digit) = (0.0, 1.0 / f64::from(base));
    while n > 0 {
        result += f64::from(n % base) * digit;
        n /= base;
        digit /= f64::from(base);
    }
    result
}
