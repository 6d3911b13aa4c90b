//! How late the machine itself is: what a bound on time has to allow for.

use std::sync::{Arc, Mutex, MutexGuard, Weak};
use std::thread;
use std::time::{Duration, Instant};

const TICK: Duration = Duration::from_millis(10);

/// The value that 99 of 100 don't exceed; nothing where there is none.
pub(crate) fn p99(sorted: &[Duration]) -> Duration {
    sorted.get((sorted.len() * 99).div_ceil(100).saturating_sub(1)).copied().unwrap_or_default()
}

/// Sleeps for a tick at a time, in a thread for each core, and notes how much longer each sleep was.
pub(crate) struct Timer(Arc<Mutex<Vec<Tick>>>);

/// A sleep: its end, and how much later that was than it should have been.
pub(crate) type Tick = (Instant, Duration);

impl Timer {
    /// The threads end when this is dropped.
    pub(crate) fn start() -> Self {
        let ticks = Arc::default();
        for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
            let weak = Arc::downgrade(&ticks);
            thread::spawn(move || tick(&weak));
        }
        Self(ticks)
    }

    /// All so far.
    pub(crate) fn ticks(&self) -> MutexGuard<'_, Vec<Tick>> {
        self.0.lock().expect("no thread panics with it")
    }

    pub(crate) fn p99(&self) -> Duration {
        let mut lateness: Vec<Duration> = self.ticks().iter().map(|(_, late)| *late).collect();
        lateness.sort_unstable();
        p99(&lateness)
    }
}

fn tick(ticks: &Weak<Mutex<Vec<Tick>>>) {
    while let Some(ticks) = ticks.upgrade() {
        let started = Instant::now();
        thread::sleep(TICK);
        let end = Instant::now();
        ticks.lock().expect("no thread panics with it").push((end, (end - started).saturating_sub(TICK)));
    }
}
