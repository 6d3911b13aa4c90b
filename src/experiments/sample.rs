//! What a sample says: mean and median of figures, confidence intervals of rates.

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

/// The 97.5th percentile of the standard normal distribution.
const Z: f64 = 1.959_963_984_540_054;

/// An interval of rates, 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConfidenceInterval {
    /// Its lower end.
    pub low: f64,
    /// Its upper end.
    pub high: f64,
}

impl ConfidenceInterval {
    /// The 95 % score interval of Wilson (1927) for the rate of `hits` in `trials`. Unlike the usual ± it is meaningful
    /// for 0 in 20, too. Without trials it is [0, 1].
    pub fn wilson(hits: usize, trials: usize) -> Self {
        if trials == 0 {
            return Self { low: 0.0, high: 1.0 };
        }
        let (count, rate) = (trials as f64, hits as f64 / trials as f64);
        let middle = rate + Z * Z / (2.0 * count);
        let half = Z * (rate * (1.0 - rate) / count + Z * Z / (4.0 * count * count)).sqrt();
        let whole = 1.0 + Z * Z / count;
        // Rounding could leave the range.
        Self { low: ((middle - half) / whole).max(0.0), high: ((middle + half) / whole).min(1.0) }
    }

    /// True if some rate is in both.
    pub fn overlaps(&self, other: &Self) -> bool {
        self.low <= other.high && other.low <= self.high
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

    fn check(hits: usize, trials: usize, low: f64, high: f64) {
        let interval = ConfidenceInterval::wilson(hits, trials);
        assert!((interval.low - low).abs() < 5e-5 && (interval.high - high).abs() < 5e-5, "{hits} {interval:?}");
    }

    #[test]
    fn the_interval_is_what_wilson_gives() {
        // Newcombe (1998), Table I, method 3.
        check(81, 263, 0.2553, 0.3662);
        check(15, 148, 0.0624, 0.1605);
        check(0, 20, 0.0, 0.1611);
        check(1, 29, 0.0061, 0.1718);
        check(29, 29, 0.8830, 1.0);
        check(0, 0, 0.0, 1.0);
    }

    #[test]
    fn intervals_overlap_in_a_common_rate() {
        let interval = |low, high| ConfidenceInterval { low, high };
        assert!(interval(0.1, 0.3).overlaps(&interval(0.3, 0.4)) && interval(0.3, 0.4).overlaps(&interval(0.1, 0.3)));
        assert!(interval(0.1, 0.9).overlaps(&interval(0.3, 0.4)) && !interval(0.1, 0.2).overlaps(&interval(0.3, 0.4)));
    }
}
