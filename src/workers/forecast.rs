//! How long a computation that comes now would wait for a thread.

use core::time::Duration;

/// The weight of the latest computation in the mean: a busy pool knows of a change within some dozens of computations.
const LATEST: f64 = 1.0 / 16.0;
/// How many times the mean a computation counts for at the most. One survey of a minute among quick plans must not have
/// the next plans refused that would be answered at once; where long ones go on coming, the mean follows within some dozens of them.
const EXCEPTION: u32 = 4;
/// The least time that a mean is taken for when that is judged: scheduling alone makes quick ones differ by as much.
const QUICK: Duration = Duration::from_millis(1);
/// Nothing is foreseen before so many have ended.
const LEAST_KNOWN: u32 = 8;

/// The mean time of recent computations, for as long as they had their thread: those that were cut off by a deadline or
/// a hang-up count too, for a thread was busy with them.
///
/// The arithmetic mean, not the median: what waits behind ninety quick ones and ten slow ones waits for the ten.
#[derive(Debug, Default)]
pub(super) struct Forecast {
    mean: Duration,
    known: u32,
}

impl Forecast {
    /// A computation had a thread for so long.
    pub(super) fn note(&mut self, took: Duration) {
        self.known = self.known.saturating_add(1);
        let took = took.min(EXCEPTION * self.mean.max(QUICK));
        self.mean = self.mean.mul_f64(1.0 - LATEST) + took.mul_f64(LATEST);
    }

    /// How long it takes so many threads to come to the end of these computations, each given by the time that it may
    /// still take; `None` where nothing is known yet.
    ///
    /// Whatever runs is taken to run for the mean time from now on. Times scatter over five orders of magnitude, so how
    /// long one has run says nothing of when it will end; but its deadline ends it for certain.
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

    /// A forecast that knows of so many computations of so long.
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
