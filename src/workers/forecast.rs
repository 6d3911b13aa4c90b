//! How long a computation that comes now would wait for a thread.

use core::time::Duration;

/// The weight of the latest computation in the mean. Small enough that one slow survey among quick plans passes for an
/// exception; large enough that a busy pool knows of a change within some dozens of computations.
const LATEST: f64 = 1.0 / 16.0;

/// The mean time of recent computations, for as long as they had their thread: those that were cut off by a deadline or
/// a hang-up count too, for a thread was busy with them.
///
/// The arithmetic mean, not the median: what waits behind ninety quick ones and ten slow ones waits for the ten.
#[derive(Debug, Default)]
pub(super) struct Forecast {
    mean: Option<Duration>,
}

impl Forecast {
    /// A computation had a thread for so long.
    pub(super) fn note(&mut self, took: Duration) {
        self.mean = Some(match self.mean {
            Some(mean) => mean.mul_f64(1.0 - LATEST) + took.mul_f64(LATEST),
            None => took,
        });
    }

    /// How long it takes so many threads to come to the end of these computations, each given by the time that it may
    /// still take; `None` where nothing is known yet.
    ///
    /// Whatever runs is taken to run for the mean time from now on. Times scatter over five orders of magnitude, so how
    /// long one has run says nothing of when it will end; but its deadline ends it for certain.
    pub(super) fn wait(&self, threads: usize, left: impl Iterator<Item = Duration>) -> Option<Duration> {
        let mean = self.mean?;
        let work: Duration = left.map(|left| left.min(mean)).sum();
        Some(work / u32::try_from(threads).unwrap_or(u32::MAX).max(1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: fn(u64) -> Duration = Duration::from_millis;

    #[test]
    fn nothing_is_foreseen_before_anything_has_ended() {
        let mut forecast = Forecast::default();
        assert_eq!(forecast.wait(1, [MS(60_000)].into_iter()), None);
        forecast.note(MS(10));
        assert_eq!(forecast.wait(1, core::iter::empty()), Some(Duration::ZERO));
    }

    #[test]
    fn threads_share_the_work_and_deadlines_end_it() {
        let mut forecast = Forecast::default();
        forecast.note(MS(100));
        let left = [MS(1000), MS(1000), MS(40), MS(0)];
        assert_eq!(forecast.wait(1, left.into_iter()), Some(MS(240)));
        assert_eq!(forecast.wait(2, left.into_iter()), Some(MS(120)));
    }

    #[test]
    fn the_mean_follows_what_is_recent() {
        let mut forecast = Forecast::default();
        let mean = |forecast: &Forecast| forecast.wait(1, [Duration::MAX].into_iter()).unwrap();
        forecast.note(MS(1000));
        forecast.note(MS(1000));
        assert_eq!(mean(&forecast), MS(1000));
        for _ in 0..100 {
            forecast.note(MS(1));
        }
        assert!(mean(&forecast) < MS(4), "{:?}", mean(&forecast));
        forecast.note(MS(1000));
        assert!(mean(&forecast) < MS(100), "one exception changes little: {:?}", mean(&forecast));
    }
}
