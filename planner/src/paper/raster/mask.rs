//! The mask image of a disc.

/// The pixels of a disc round the middle of a pixel: those whose own middle is not farther away than the radius. At
/// least one.
#[derive(Debug, Clone)]
pub(super) struct Mask {
    /// The pixels on either side of the middle, in the middle row and in each row above it. The rows below are the
    /// same.
    reaches: Vec<usize>,
}

impl Mask {
    /// `radius` and `resolution` in m; the memory taken grows with their ratio.
    pub(super) fn new(radius: f64, resolution: f64) -> Self {
        let radius = radius / resolution;
        let reach = |up: usize| (radius * radius - (up * up) as f64).sqrt() as usize;
        Self { reaches: (0..=radius as usize).map(reach).collect() }
    }

    /// The number of pixels.
    pub(super) fn pixels(&self) -> usize {
        let one_side: usize = self.reaches[1..].iter().map(|reach| 2 * reach + 1).sum();
        2 * self.reaches[0] + 1 + 2 * one_side
    }

    /// Its lines round the pixel (0, 0) of a periodic image, each as (row, reach): the line covers the columns from 0
    /// to the reach, and as many (without column 0) from the other end. The image is at least as large as the mask.
    pub(super) fn lines(&self, rows: usize) -> impl Iterator<Item = (usize, usize)> + '_ {
        let up = self.reaches.iter().copied().enumerate();
        let down = self.reaches.iter().enumerate().skip(1).map(move |(down, reach)| (rows - down, *reach));
        up.chain(down)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mask_has_the_pixels_within_the_radius() {
        for (radius, expected) in [(0.001, 1), (0.005, 5), (0.0071, 9), (0.01, 13), (0.075, 709)] {
            let mask = Mask::new(radius, 0.005);
            assert_eq!(mask.pixels(), expected, "{radius}");
            let line = |(row, reach)| (0..=reach).chain(64 - reach..64).map(move |column| (column, row));
            let mut pixels: Vec<(usize, usize)> = mask.lines(48).flat_map(line).collect();
            pixels.sort_unstable();
            pixels.dedup();
            assert_eq!(pixels.len(), expected, "{radius}");
            let back = |step: usize, size: usize| step.min(size - step);
            let apart = |&(right, up): &(usize, usize)| back(right, 64).pow(2) + back(up, 48).pow(2);
            let far = pixels.iter().map(apart).max().unwrap() as f64;
            assert!(far.sqrt() * 0.005 <= radius, "{radius}");
        }
    }
}
