//! Forecasts how long a new computation would wait for a thread.

use core::time::Duration;

/// The weight of the latest computation in the moving mean: it follows a change within some dozens of computations.
const LATEST: f64 = 1.0 / 16.0;
/// Cap on one computation, in means. One survey of a minute among quick plans must not cause plans to be refused that
/// would start at once. If long ones keep coming, the mean follows within some dozens of them.
const EXCEPTION: u32 = 4;
/// The least mean for this cap: scheduling alone makes quick computations differ by as much.
const QUICK: Duration = Duration::from_millis(1);
/// No forecast before this many have ended.
const LEAST_KNOWN: u32 = 8;

/// The moving mean of how long computations had a thread. Those cut off by a deadline or a hang-up count too, since a
/// thread was busy with them.
///
/// The arithmetic mean, not the median: behind ninety quick and ten slow computations, the wait is for the ten.
#[derive(Debug, Default)]
pub(super) struct Forecast {
    mean: Duration,
    known: u32,
}

impl Forecast {
    /// Adds a computation that had a thread for this long.
    pub(super) fn note(&mut self, took: Duration) {
        self.known = self.known.saturating_add(1);
        let took = took.min(EXCEPTION * self.mean.max(QUICK));
        self.mean = self.mean.mul_f64(1.0 - LATEST) + took.mul_f64(LATEST);
    }

    /// How long this many threads need for these computations, each given by the time left to its deadline; `None` if
    /// nothing is known yet.
    ///
    /// A running computation is assumed to run for the mean time from now on. Times range over five orders of
    /// magnitude, so the time already spent does not predict the end; only the deadline bounds it.
    pub(super) fn wait(&self, threads: usize, left: impl Iterator<Item = Duration>) -> Option<Duration> {
        if self.known < LEAST_KNOWN {
            return None;
        }
        let work: Duration = left.map(|left| left.min(self.mean)).sum();
        Some(work / u32::try_from(threads).unwrap_or(u32::MAX).max(1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: fn(u64) -> Duration = Duration::from_millis;

    /// A forecast after this many computations of this length.
    fn after(count: u32, took: Duration) -> Forecast {
        let mut forecast = Forecast::default();
        (0..count).for_each(|_| forecast.note(took));
        forecast
    }

    fn mean(forecast: &Forecast) -> Duration {
        forecast.wait(1, [Duration::MAX].into_iter()).unwrap()
    }

    #[test]
    fn nothing_is_foreseen_before_some_have_ended() {
        assert_eq!(after(7, MS(10)).wait(1, [MS(60_000)].into_iter()), None);
        assert_eq!(after(8, MS(10)).wait(1, core::iter::empty()), Some(Duration::ZERO));
    }

    #[test]
    fn threads_share_the_work_and_deadlines_end_it() {
        let forecast = after(1000, MS(100));
        let left = [MS(1000), MS(1000), MS(40), MS(0)];
        let about = |wait: Duration, expected: Duration| assert!(wait.abs_diff(expected) < MS(1), "{wait:?}");
        about(forecast.wait(1, left.into_iter()).unwrap(), MS(240));
        about(forecast.wait(2, left.into_iter()).unwrap(), MS(120));
    }

    #[test]
    fn the_mean_follows_what_is_recent() {
        let mut forecast = after(1000, MS(100));
        (0..100).for_each(|_| forecast.note(MS(1)));
        assert!(mean(&forecast) < MS(4), "{:?}", mean(&forecast));
        (0..60).for_each(|_| forecast.note(MS(1000)));
        assert!(mean(&forecast) > MS(800), "{:?}", mean(&forecast));
    }

    #[test]
    fn one_long_computation_among_quick_ones_is_an_exception() {
        let mut forecast = after(100, MS(1));
        forecast.note(MS(60_000));
        assert!(mean(&forecast) < MS(2), "{:?}", mean(&forecast));
        let mut forecast = after(1, MS(60_000));
        (0..20).for_each(|_| forecast.note(MS(1)));
        assert!(mean(&forecast) < MS(2), "{:?}", mean(&forecast));
    }
}
