//! The resident memory of a process, looked at again and again.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use super::server::resident;

const EVERY: Duration = Duration::from_millis(250);
/// What is compared: the first seconds under load, when connections, queues and the caches of the store have filled, and the last.
const FILLED: Duration = Duration::from_secs(5);
const SPAN: Duration = Duration::from_secs(5);

pub(super) struct Memory {
    stop: Arc<AtomicBool>,
    thread: thread::JoinHandle<Vec<(Duration, u64)>>,
}

/// kB.
pub(super) struct Resident {
    pub(super) first: u64,
    pub(super) last: u64,
    pub(super) peak: u64,
}

impl Memory {
    pub(super) fn watch(process: u32) -> Self {
        let stop = Arc::new(AtomicBool::new(false));
        let stopped = Arc::clone(&stop);
        let thread = thread::spawn(move || {
            let (started, mut samples) = (Instant::now(), Vec::new());
            while !stopped.load(Ordering::Relaxed) {
                samples.push((started.elapsed(), resident(process)));
                thread::sleep(EVERY);
            }
            samples
        });
        Self { stop, thread }
    }

    pub(super) fn stop(self) -> Resident {
        self.stop.store(true, Ordering::Relaxed);
        let samples = self.thread.join().expect("it reads only");
        let end = samples.last().expect("one at least").0;
        let median = |from: Duration| {
            let within = samples.iter().filter(|(at, _)| (from..=from + SPAN).contains(at));
            let mut sizes: Vec<u64> = within.map(|(_, size)| *size).collect();
            sizes.sort_unstable();
            sizes[sizes.len() / 2]
        };
        let peak = samples.iter().map(|(_, size)| *size).max().expect("one at least");
        Resident { first: median(FILLED), last: median(end.saturating_sub(SPAN)), peak }
    }
}
