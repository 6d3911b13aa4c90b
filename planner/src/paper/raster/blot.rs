//! Black on white: which pixels lie within some distance of discs and rectangles.

use nalgebra::Point2;

use super::grid::Raster;
use crate::budget::{Budget, Interrupted};
use crate::paper::angles::radius;
use crate::scene::{Footprint, Rectangle};

/// The points nearer than `reach` to a rectangle; for a disc the rectangle is its centre.
#[derive(Debug, Clone, Copy)]
pub(super) struct Blot {
    min: Point2<f64>,
    max: Point2<f64>,
    /// m.
    reach: f64,
}

impl Blot {
    /// The points nearer than `beyond` (m) to the disc.
    pub(super) fn disc(disc: &Footprint, beyond: f64) -> Self {
        Self { min: disc.at(), max: disc.at(), reach: radius(disc) + beyond }
    }

    /// The points nearer than `reach` (m) to the rectangle.
    pub(super) fn round(area: &Rectangle, reach: f64) -> Self {
        Self { min: area.min(), max: area.max(), reach }
    }

    /// The values of x between which it covers the line at height y, m.
    fn stretch(&self, y: f64) -> Option<(f64, f64)> {
        let away = (self.min.y - y).max(y - self.max.y).max(0.0);
        (away < self.reach).then(|| {
            let half = (self.reach * self.reach - away * away).sqrt();
            (self.min.x - half, self.max.x + half)
        })
    }
}

/// The image of `blots`: true for each pixel whose middle is in one. A blot costs the same per row, whatever its width.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub(super) fn image(raster: &Raster, blots: &[Blot], budget: &Budget<'_>) -> Result<Vec<bool>, Interrupted> {
    let mut image = Vec::with_capacity(raster.pixels());
    // Per pixel of the row the number of blots that begin there, less those that end.
    let mut change = vec![0_i32; raster.columns() + 1];
    for row in 0..raster.rows() {
        budget.check()?;
        change.fill(0);
        let y = raster.centre(0, row).y;
        for (low, high) in blots.iter().filter_map(|blot| blot.stretch(y)) {
            let columns = raster.columns_between(low, high);
            change[columns.start] += 1;
            change[columns.end] -= 1;
        }
        let mut depth = 0;
        image.extend(change[..raster.columns()].iter().map(|change| {
            depth += change;
            depth > 0
        }));
    }
    Ok(image)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::scenes::TestScene;

    #[test]
    fn a_pixel_is_black_when_its_middle_is_nearer_than_the_reach() {
        let scene = TestScene::new(3)
            .table(1.5, 1.0)
            .keep_out([0.4, 0.33, 0.9, 0.5])
            .keep_out([1.0, 0.0, 1.01, 0.01])
            .disc("a", 0.2, 0.9, 0.15)
            .disc("b", 0.35, 0.8, 0.001)
            .disc("t", 1.4, 0.3, 0.2)
            .build("t");
        let raster = Raster::new(0.01, scene.table()).unwrap();
        let blots = scene.objects().iter().map(|object| Blot::disc(object.footprint(), 0.013));
        let areas = scene.table().keep_out().iter().map(|area| Blot::round(area, 0.072));
        let image = image(&raster, &blots.chain(areas).collect::<Vec<_>>(), &Budget::unlimited()).unwrap();
        let mut black = 0;
        for (column, row) in (0..raster.rows()).flat_map(|row| (0..raster.columns()).map(move |at| (at, row))) {
            let pixel = |radius| Footprint::disc(raster.centre(column, row), radius);
            let near = scene.objects().iter().any(|object| object.footprint().gap(&pixel(0.013)) < 0.0)
                || scene.table().keep_out().iter().any(|area| pixel(0.072).gap_outside(area) < 0.0);
            assert_eq!(image[raster.at(column, row)], near, "{column} {row}");
            black += usize::from(near);
        }
        assert!(black > 3000, "{black}");
    }
}
