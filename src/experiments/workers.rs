//! Runs episodes on several threads.

use core::time::Duration;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;
use std::time::Instant;

use singulate_planner::budget::Clock;

/// Makes the clocks of computations: the time limit, and whether another episode has failed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Patience<'a> {
    pub(super) limit: Duration,
    pub(super) failed: &'a AtomicBool,
}

/// A clock that starts now and is cancelled once another episode has failed.
#[derive(Debug)]
pub(super) struct Watch<'a> {
    started: Instant,
    failed: &'a AtomicBool,
}

impl<'a> Patience<'a> {
    pub(super) fn watch(&self) -> Watch<'a> {
        Watch { started: Instant::now(), failed: self.failed }
    }
}

impl Clock for Watch<'_> {
    fn elapsed(&self) -> Duration {
        self.started.elapsed()
    }

    fn cancelled(&self) -> bool {
        self.failed.load(Ordering::Relaxed)
    }
}

/// Run `work` for 0 to `count` on `jobs` threads. The results are in order; `done` gets the number finished after each.
///
/// # Errors
/// The first failure; a flag tells the other threads to stop.
pub(super) fn in_parallel<T: Send, E: Send>(
    count: usize,
    jobs: usize,
    work: impl Fn(usize, &AtomicBool) -> Result<T, E> + Sync,
    mut done: impl FnMut(usize),
) -> Result<Vec<T>, E> {
    let (next, failed) = (AtomicUsize::new(0), AtomicBool::new(false));
    thread::scope(|scope| {
        let (results, arrived) = mpsc::channel();
        for _ in 0..jobs {
            let (results, work, next, failed) = (results.clone(), &work, &next, &failed);
            scope.spawn(move || {
                while !failed.load(Ordering::Relaxed) {
                    let at = next.fetch_add(1, Ordering::Relaxed);
                    if at >= count || results.send((at, work(at, failed))).is_err() {
                        break;
                    }
                }
            });
        }
        drop(results);
        let mut slots: Vec<Option<T>> = (0..count).map(|_| None).collect();
        for (before, (at, result)) in arrived.iter().enumerate() {
            match result {
                Ok(result) => slots[at] = Some(result),
                Err(error) => {
                    failed.store(true, Ordering::Relaxed);
                    return Err(error);
                }
            }
            done(before + 1);
        }
        Ok(slots.into_iter().flatten().collect())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_stand_in_order_whichever_thread_was_first() {
        for jobs in [1, 3, 50] {
            let slow_first = |at, _: &AtomicBool| {
                thread::sleep(Duration::from_micros(if at < 3 { 2000 } else { 0 }));
                Ok::<_, ()>(at)
            };
            let mut heard = Vec::new();
            let results = in_parallel(20, jobs, slow_first, |done| heard.push(done));
            assert_eq!((results, heard), (Ok((0..20).collect()), (1..=20).collect()));
        }
    }

    #[test]
    fn a_failure_ends_what_others_are_at() {
        let work = |at, failed: &AtomicBool| {
            if at == 1 {
                return Err("one failed");
            }
            let watch = Patience { limit: Duration::MAX, failed }.watch();
            while !watch.cancelled() {
                assert!(watch.elapsed() < Duration::from_secs(60), "not told to stop");
                thread::yield_now();
            }
            Ok(())
        };
        assert_eq!(in_parallel(1000, 2, work, |_| ()), Err("one failed"));
    }
}
