//! How late the machine itself is: what a bound on time has to allow for.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

const TICK: Duration = Duration::from_millis(10);

/// The value that 99 of 100 don't exceed; nothing where there is none.
pub(crate) fn p99(sorted: &[Duration]) -> Duration {
    sorted.get((sorted.len() * 99).div_ceil(100).saturating_sub(1)).copied().unwrap_or_default()
}

/// Sleeps for a tick at a time and notes how much longer each sleep was.
pub(crate) struct Timer {
    stop: Arc<AtomicBool>,
    thread: thread::JoinHandle<Vec<Duration>>,
}

impl Timer {
    pub(crate) fn start() -> Self {
        let stop = Arc::new(AtomicBool::new(false));
        let stopped = Arc::clone(&stop);
        let thread = thread::spawn(move || {
            let mut lateness = Vec::new();
            while !stopped.load(Ordering::Relaxed) {
                let started = Instant::now();
                thread::sleep(TICK);
                lateness.push(started.elapsed().saturating_sub(TICK));
            }
            lateness
        });
        Self { stop, thread }
    }

    /// The 99th percentile of the lateness.
    pub(crate) fn stop(self) -> Duration {
        self.stop.store(true, Ordering::Relaxed);
        let mut lateness = self.thread.join().expect("it counts only");
        lateness.sort_unstable();
        p99(&lateness)
    }
}
