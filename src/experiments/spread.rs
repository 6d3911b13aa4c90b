//! Mean and median of figures.

use core::time::Duration;

/// Mean and median of some figures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// The arithmetic mean.
    pub mean: f64,
    /// The median.
    pub median: f64,
}

impl Spread {
    /// `None` without figures.
    pub(super) fn of(figures: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut sorted: Vec<f64> = figures.into_iter().collect();
        sorted.sort_unstable_by(f64::total_cmp);
        let (below, above) = (*sorted.get(sorted.len().checked_sub(1)? / 2)?, sorted[sorted.len() / 2]);
        Some(Self { mean: sorted.iter().sum::<f64>() / sorted.len() as f64, median: f64::midpoint(below, above) })
    }

    /// Of times, in seconds.
    pub(super) fn of_times(times: impl IntoIterator<Item = Duration>) -> Option<Self> {
        Self::of(times.into_iter().map(|time| time.as_secs_f64()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_in_the_middle_whatever_the_order() {
        assert_eq!(Spread::of([9.0, 1.0, 2.0]), Some(Spread { mean: 4.0, median: 2.0 }));
        assert_eq!(Spread::of([4.0, 1.0, 9.0, 2.0]), Some(Spread { mean: 4.0, median: 3.0 }));
        assert_eq!(Spread::of([]), None);
    }
}
