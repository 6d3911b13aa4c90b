//! Pixels on the table.

use core::ops::Range;

use nalgebra::Point2;

use crate::scene::Table;

/// The paper names no resolution; this one puts 30 pixels across its objects. m per pixel.
pub const DEFAULT_RESOLUTION: f64 = 0.005;

/// The most pixels of an image, with those beyond the table's edge that make it a good size for a Fourier transform. At
/// 16 bytes a pixel the largest image takes 64 MB.
pub(super) const MAX_PIXELS: usize = 4_000_000;

/// The most pixels along one side: a line is transformed in one go, without a look at the time.
pub(super) const MAX_SIDE: usize = 1 << 16;

/// An image of a table: square pixels, row by row from the corner of least x and y. It has up to
/// 4,000,000 pixels, each side up to 65,536 and no prime factor above 5.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Raster {
    /// The corner where it begins, m.
    corner: Point2<f64>,
    /// The side of a pixel, m.
    resolution: f64,
    columns: usize,
    rows: usize,
}

/// An image of the table would have more than 4,000,000 pixels or a side of more than 65,536, or its resolution is no
/// length.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "an image of the table with {resolution} m a pixel has more than {MAX_PIXELS} pixels or {MAX_SIDE} along a side"
)]
pub struct TooFine {
    /// The requested resolution, m per pixel.
    pub resolution: f64,
}

impl Raster {
    /// An image of `table` with pixels of `resolution` (m, positive).
    ///
    /// # Errors
    /// [`TooFine`] for an image above the limits, and for a resolution that is not a positive number.
    pub fn new(resolution: f64, table: &Table) -> Result<Self, TooFine> {
        let top = table.top();
        let sides = top.max() - top.min();
        let side = |length: f64| {
            let pixels = (length / resolution).ceil();
            // Written so that NaN is refused.
            (resolution > 0.0 && pixels <= MAX_SIDE as f64).then(|| good_size(pixels as usize))
        };
        let fits = |(columns, rows): &(usize, usize)| *columns.max(rows) <= MAX_SIDE && columns * rows <= MAX_PIXELS;
        let (columns, rows) = side(sides.x).zip(side(sides.y)).filter(fits).ok_or(TooFine { resolution })?;
        Ok(Self { corner: top.min(), resolution, columns, rows })
    }

    /// The side of a pixel, m.
    pub(super) fn resolution(&self) -> f64 {
        self.resolution
    }

    pub(super) fn columns(&self) -> usize {
        self.columns
    }

    pub(super) fn rows(&self) -> usize {
        self.rows
    }

    pub(super) fn pixels(&self) -> usize {
        self.columns * self.rows
    }

    /// The position of a pixel in the image.
    pub(super) fn at(&self, column: usize, row: usize) -> usize {
        row * self.columns + column
    }

    /// The middle of a pixel, m.
    pub(super) fn centre(&self, column: usize, row: usize) -> Point2<f64> {
        let middle = |pixel: usize| (pixel as f64 + 0.5) * self.resolution;
        Point2::new(self.corner.x + middle(column), self.corner.y + middle(row))
    }

    /// The columns whose middle is strictly between two values of x, m.
    pub(super) fn columns_between(&self, low: f64, high: f64) -> Range<usize> {
        self.between(low - self.corner.x, high - self.corner.x, self.columns)
    }

    /// The rows whose middle is strictly between two values of y, m.
    pub(super) fn rows_between(&self, low: f64, high: f64) -> Range<usize> {
        self.between(low - self.corner.y, high - self.corner.y, self.rows)
    }

    fn between(&self, low: f64, high: f64, count: usize) -> Range<usize> {
        let pixel = |length: f64| length / self.resolution - 0.5;
        // The cast saturates: a negative number becomes 0.
        let start = (pixel(low).floor() + 1.0) as usize;
        let end = pixel(high).ceil() as usize;
        start.min(count)..end.clamp(start.min(count), count)
    }
}

/// The least number from `least` on that has no prime factor above 5: lines of such lengths are transformed fast.
fn good_size(least: usize) -> usize {
    let mut size = least.max(1);
    while [2, 3, 5].iter().fold(size, |rest, &prime| without(rest, prime)) > 1 {
        size += 1;
    }
    size
}

/// `number` without its factors `prime`.
fn without(mut number: usize, prime: usize) -> usize {
    while number.is_multiple_of(prime) {
        number /= prime;
    }
    number
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::scenes::TestScene;

    fn raster(resolution: f64, width: f64, height: f64) -> Result<(usize, usize), TooFine> {
        let scene = TestScene::new(3).table(width, height).disc("t", 0.0, 0.0, 0.01).build("t");
        Raster::new(resolution, scene.table()).map(|raster| (raster.columns(), raster.rows()))
    }

    #[test]
    fn an_image_covers_the_table_and_its_sides_are_good_sizes() {
        assert_eq!(raster(0.005, 1.2, 0.7), Ok((240, 144)));
        assert_eq!(raster(0.01, 0.07, 0.071), Ok((8, 8)));
        assert_eq!(raster(1.0, 0.1, 0.1), Ok((1, 1)));
        assert_eq!(good_size(2049), 2160);
    }

    #[test]
    fn what_takes_too_many_pixels_is_refused() {
        assert_eq!(raster(0.001, 2.0, 2.0), Ok((2000, 2000)));
        assert_eq!(raster(0.001, 2.001, 2.0), Err(TooFine { resolution: 0.001 }));
        // 65,536 pixels along a side is a good size, one more is too many.
        assert_eq!(raster(0.001, 65.536, 0.05), Ok((65_536, 50)));
        assert_eq!(raster(0.001, 65.537, 0.05), Err(TooFine { resolution: 0.001 }));
        for resolution in [0.0, -1.0, 1e-300, f64::INFINITY - f64::INFINITY] {
            assert!(raster(resolution, 2.0, 2.0).is_err(), "{resolution}");
        }
    }

    #[test]
    fn only_middles_strictly_between_count() {
        let scene = TestScene::new(3).table(8.0, 8.0).disc("t", 0.0, 0.0, 0.01).build("t");
        let raster = Raster::new(1.0, scene.table()).unwrap();
        assert_eq!(raster.columns_between(1.5, 4.5), 2..4);
        assert_eq!(raster.rows_between(1.4, 4.6), 1..5);
        assert_eq!(raster.rows_between(-9.0, 99.0), 0..8);
        assert!(raster.columns_between(2.6, 2.4).is_empty() && raster.columns_between(-9.0, -8.0).is_empty());
        assert!(raster.columns_between(20.0, 30.0).is_empty());
    }
}
