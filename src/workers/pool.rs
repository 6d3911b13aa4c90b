//! The planning pool: a few threads, a bounded queue, and a deadline for every job that counts from the arrival of its
//! request. A job whose caller has gone, or whose deadline has passed, never starts; one that runs is told by its budget.

use std::collections::VecDeque;
use std::io;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use tokio::sync::oneshot;

use super::pending::{Pending, Ticket};
use crate::budget::Budget;

/// A fixed number of threads and the jobs that wait for them.
#[derive(Debug)]
pub struct Pool {
    shared: Arc<Shared>,
    threads: Mutex<Vec<JoinHandle<()>>>,
}

/// Why a job was not taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Refused {
    /// Every thread is busy and the queue is full.
    #[error("every thread is busy and the queue is full")]
    Full,
    /// The pool takes no more jobs.
    #[error("the pool is closed")]
    Closed,
}

#[derive(Debug)]
struct Shared {
    state: Mutex<State>,
    wake: Condvar,
    queue: usize,
}

#[derive(Debug)]
struct State {
    waiting: VecDeque<Waiting>,
    idle: usize,
    open: bool,
}

struct Waiting {
    ticket: Arc<Ticket>,
    run: Box<dyn FnOnce() + Send>,
}

impl core::fmt::Debug for Waiting {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.ticket.fmt(f)
    }
}

/// Searches descend a level, of about 1 kB, for each object of a set. Only what is used takes memory.
const STACK_BYTES: usize = 16 << 20;

impl Pool {
    /// `threads` threads (one at the least), and room for `queue` jobs that wait for one.
    ///
    /// # Errors
    /// If the system gives no thread.
    pub fn new(threads: usize, queue: usize) -> io::Result<Self> {
        let state = State { waiting: VecDeque::new(), idle: 0, open: true };
        let shared = Arc::new(Shared { state: Mutex::new(state), wake: Condvar::new(), queue });
        let pool = Self { shared: Arc::clone(&shared), threads: Mutex::default() };
        for n in 0..threads.max(1) {
            let shared = Arc::clone(&shared);
            shared.lock().idle += 1;
            let thread = std::thread::Builder::new().name(format!("plan-{n}")).stack_size(STACK_BYTES);
            let thread = thread.spawn(move || shared.work())?;
            lock(&pool.threads).push(thread);
        }
        Ok(pool)
    }

    /// Hand in a job whose request arrived at `arrival` and may take `time_limit` from then.
    ///
    /// # Errors
    /// [`Refused`] if there is no room.
    pub fn submit<T: Send + 'static>(
        &self,
        arrival: Instant,
        time_limit: Duration,
        job: impl FnOnce(&Budget<'_>) -> T + Send + 'static,
    ) -> Result<Pending<T>, Refused> {
        let ticket = Arc::new(Ticket::new(arrival, time_limit));
        let (sender, reply) = oneshot::channel();
        let own = Arc::clone(&ticket);
        let run = Box::new(move || {
            // Nobody may be left to hear it.
            let _ = sender.send(own.run(job));
        });
        self.shared.enqueue(Waiting { ticket: Arc::clone(&ticket), run })?;
        Ok(Pending::new(ticket, reply))
    }

    /// True if every thread lives and jobs are taken.
    pub fn ready(&self) -> bool {
        self.shared.lock().open && lock(&self.threads).iter().all(|thread| !thread.is_finished())
    }

    /// The number of threads that wait for a job.
    pub fn idle(&self) -> usize {
        self.shared.lock().idle
    }

    /// The number of threads that run one.
    pub fn busy(&self) -> usize {
        let threads = lock(&self.threads).len();
        threads.saturating_sub(self.idle())
    }

    /// Take no more jobs.
    pub fn close(&self) {
        self.shared.lock().open = false;
        self.shared.wake.notify_all();
    }

    /// Take no more jobs, and wait until those that were taken have come to their end. Blocks.
    pub fn join(&self) {
        self.close();
        let threads = core::mem::take(&mut *lock(&self.threads));
        for thread in threads {
            // A thread ends by a panic only if the process is about to.
            let _ = thread.join();
        }
    }
}

impl Drop for Pool {
    fn drop(&mut self) {
        self.close();
    }
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, State> {
        lock(&self.state)
    }

    fn enqueue(&self, job: Waiting) -> Result<(), Refused> {
        let mut state = self.lock();
        if !state.open {
            return Err(Refused::Closed);
        }
        if state.waiting.len() >= self.queue + state.idle {
            state.waiting.retain(|waiting| !waiting.ticket.abandoned());
        }
        if state.waiting.len() >= self.queue + state.idle {
            return Err(Refused::Full);
        }
        state.waiting.push_back(job);
        drop(state);
        self.wake.notify_one();
        Ok(())
    }

    fn work(&self) {
        while let Some(job) = self.next() {
            (job.run)();
            self.lock().idle += 1;
        }
    }

    /// The next job; `None` once the pool is closed and its queue empty. The calling thread counts as idle until then.
    fn next(&self) -> Option<Waiting> {
        let state = self.lock();
        let wait = |state: &mut State| state.waiting.is_empty() && state.open;
        let mut state = self.wake.wait_while(state, wait).unwrap_or_else(PoisonError::into_inner);
        state.idle -= 1;
        state.waiting.pop_front()
    }
}

/// No invariant of what these locks guard can be broken by a panic.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicBool, Ordering};

    use super::*;
    use crate::workers::Outcome;

    const LONG: Duration = Duration::from_secs(600);

    /// A job that runs until its budget ends.
    fn endless(budget: &Budget<'_>) {
        while budget.check().is_ok() {
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    fn wait_until(mut condition: impl FnMut() -> bool) {
        let start = Instant::now();
        while !condition() {
            assert!(start.elapsed() < Duration::from_secs(60), "waited in vain");
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    #[tokio::test]
    async fn a_job_delivers() {
        let pool = Pool::new(2, 0).unwrap();
        let pending = pool.submit(Instant::now(), LONG, |_| 7).unwrap();
        assert_eq!(pending.outcome().await, Outcome::Done(7));
    }

    #[tokio::test]
    async fn a_panic_is_told_and_the_thread_lives_on() {
        let pool = Pool::new(1, 1).unwrap();
        let pending = pool.submit(Instant::now(), LONG, |_| -> u8 { panic!("on purpose") }).unwrap();
        assert_eq!(pending.outcome().await, Outcome::Panicked);
        let pending = pool.submit(Instant::now(), LONG, |_| 7).unwrap();
        assert_eq!(pending.outcome().await, Outcome::Done(7));
        assert!(pool.ready());
    }

    #[tokio::test]
    async fn a_full_pool_refuses_until_a_caller_hangs_up() {
        let pool = Pool::new(1, 1).unwrap();
        let running = pool.submit(Instant::now(), LONG, endless).unwrap();
        wait_until(|| pool.idle() == 0);
        assert_eq!(pool.busy(), 1);
        let waiting = pool.submit(Instant::now(), LONG, endless).unwrap();
        assert_eq!(pool.submit(Instant::now(), LONG, endless).unwrap_err(), Refused::Full);
        drop(waiting);
        let waiting = pool.submit(Instant::now(), LONG, |_| 7).unwrap();
        drop(running);
        assert_eq!(waiting.outcome().await, Outcome::Done(7));
    }

    #[tokio::test]
    async fn a_job_that_waits_past_its_deadline_never_starts() {
        let pool = Pool::new(1, 1).unwrap();
        let running = pool.submit(Instant::now(), LONG, endless).unwrap();
        wait_until(|| pool.idle() == 0);
        let began = Arc::new(AtomicBool::new(false));
        let mark = Arc::clone(&began);
        let job = move |_: &Budget<'_>| mark.store(true, Ordering::Relaxed);
        let waiting = pool.submit(Instant::now(), Duration::from_millis(5), job).unwrap();
        assert_eq!(waiting.outcome().await, Outcome::TimedOut);
        drop(running);
        wait_until(|| pool.idle() == 1);
        assert!(!began.load(Ordering::Relaxed));
    }

    #[tokio::test]
    async fn a_job_that_ignores_its_budget_is_not_waited_for() {
        let pool = Pool::new(1, 1).unwrap();
        let (release, held) = std::sync::mpsc::channel::<()>();
        let job = move |_: &Budget<'_>| held.recv().is_ok();
        let pending = pool.submit(Instant::now(), Duration::from_millis(5), job).unwrap();
        assert_eq!(pending.outcome().await, Outcome::TimedOut);
        drop(release);
    }

    #[tokio::test]
    async fn a_closed_pool_finishes_what_it_has() {
        let pool = Pool::new(1, 1).unwrap();
        let first = pool.submit(Instant::now(), Duration::from_millis(20), endless).unwrap();
        wait_until(|| pool.idle() == 0);
        let second = pool.submit(Instant::now(), LONG, |_| 7).unwrap();
        pool.join();
        assert!(!pool.ready());
        assert_eq!(pool.submit(Instant::now(), LONG, |_| 7).unwrap_err(), Refused::Closed);
        assert_eq!((first.outcome().await, second.outcome().await), (Outcome::Done(()), Outcome::Done(7)));
    }
}
