//! The pool: a few threads, a bounded queue, and a deadline for every computation that counts from the arrival of its
//! request. One whose caller has gone, or whose deadline has passed, never starts; one that runs is told by its budget; one
//! that, by all that is known, could not start in time is refused at once.

use std::io;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use tokio::sync::oneshot;

use super::forecast::Forecast;
use super::pending::{Pending, Ticket};
use super::queue::Queue;
use singulate_planner::budget::Budget;

/// A fixed number of threads and the computations that wait for them.
#[derive(Debug)]
pub struct Pool {
    pub(super) shared: Arc<Shared>,
    threads: Mutex<Vec<JoinHandle<()>>>,
}

/// Why a computation was not taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Refused {
    /// Every thread is busy and the queue is full.
    #[error("every thread is busy and the queue is full")]
    Full,
    /// Every thread is busy, and by the time of recent computations none will be free before the deadline.
    #[error("no thread is likely to be free within the time limit")]
    TooLate {
        /// When one may be.
        retry_after: Duration,
    },
    /// The pool takes no more.
    #[error("the pool is closed")]
    Closed,
}

#[derive(Debug)]
pub(super) struct Shared {
    state: Mutex<State>,
    wake: Condvar,
    threads: usize,
    queue: usize,
}

#[derive(Debug)]
pub(super) struct State {
    waiting: Queue<Waiting>,
    /// One for each busy thread.
    running: Vec<Arc<Ticket>>,
    pub(super) forecast: Forecast,
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

/// A computation may descend ten thousand levels, of about 1 kB each. Only what is used takes memory.
const STACK_BYTES: usize = 16 << 20;

impl Pool {
    /// `threads` threads (one at the least), and room for `queue` computations that wait for one.
    ///
    /// # Errors
    /// If the system gives no thread.
    pub fn new(threads: usize, queue: usize) -> io::Result<Self> {
        let threads = threads.max(1);
        let forecast = Forecast::default();
        let state = State { waiting: Queue::new(), running: Vec::new(), forecast, idle: threads, open: true };
        let shared = Arc::new(Shared { state: Mutex::new(state), wake: Condvar::new(), threads, queue });
        let pool = Self { shared: Arc::clone(&shared), threads: Mutex::default() };
        for n in 0..threads {
            let shared = Arc::clone(&shared);
            let thread = std::thread::Builder::new().name(format!("plan-{n}")).stack_size(STACK_BYTES);
            let thread = thread.spawn(move || shared.work())?;
            lock(&pool.threads).push(thread);
        }
        Ok(pool)
    }

    /// Hand in a computation whose request arrived at `arrival` and may take `time_limit` from then. Those of different
    /// owners take turns.
    ///
    /// # Errors
    /// [`Refused`] if there is no room, or no time.
    pub fn submit<T: Send + 'static>(
        &self,
        owner: &str,
        arrival: Instant,
        time_limit: Duration,
        computation: impl FnOnce(&Budget<'_>) -> T + Send + 'static,
    ) -> Result<Pending<T>, Refused> {
        let ticket = Arc::new(Ticket::new(arrival, time_limit));
        let (sender, reply) = oneshot::channel();
        let own = Arc::clone(&ticket);
        let run = Box::new(move || {
            // Nobody may be left to hear it.
            let _ = sender.send(own.run(computation));
        });
        self.shared.enqueue(owner, Waiting { ticket: Arc::clone(&ticket), run })?;
        Ok(Pending::new(ticket, reply))
    }

    /// Would a computation be taken that came now and may still take `left`? Answered at once, and cheaper than the
    /// computation is made.
    ///
    /// # Errors
    /// [`Refused`] if there is no room, or no time.
    pub fn room(&self, owner: &str, left: Duration) -> Result<(), Refused> {
        self.shared.room(&mut self.shared.lock(), owner, left)
    }

    /// True if every thread lives and computations are taken.
    pub fn ready(&self) -> bool {
        self.shared.lock().open && lock(&self.threads).iter().all(|thread| !thread.is_finished())
    }

    /// The number of threads that wait for a computation.
    pub fn idle(&self) -> usize {
        self.shared.lock().idle
    }

    /// The number of threads that compute.
    pub fn busy(&self) -> usize {
        self.shared.lock().running.len()
    }

    /// Everything that runs delivers the best so far, and nothing that waits begins.
    pub fn finish_soon(&self) {
        let state = self.shared.lock();
        let waiting = state.waiting.iter().map(|waiting| &waiting.ticket);
        state.running.iter().chain(waiting).for_each(|ticket| ticket.finish_soon());
    }

    /// Take no more computations.
    pub fn close(&self) {
        self.shared.lock().open = false;
        self.shared.wake.notify_all();
    }

    /// Take no more computations, and wait until those that were taken have come to their end. Blocks.
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
    pub(super) fn lock(&self) -> MutexGuard<'_, State> {
        lock(&self.state)
    }

    fn enqueue(&self, owner: &str, newcomer: Waiting) -> Result<(), Refused> {
        let mut state = self.lock();
        self.room(&mut state, owner, newcomer.ticket.left())?;
        state.waiting.push(owner, newcomer);
        drop(state);
        self.wake.notify_one();
        Ok(())
    }

    fn room(&self, state: &mut State, owner: &str, left: Duration) -> Result<(), Refused> {
        if !state.open {
            return Err(Refused::Closed);
        }
        if !state.thread_free() {
            state.waiting.retain(|waiting| !waiting.ticket.abandoned());
        }
        if state.waiting.len() >= self.queue + state.idle {
            return Err(Refused::Full);
        }
        // A free thread begins at once, whatever the past says.
        if !state.thread_free()
            && let Some(wait) = state.wait(owner, self.threads)
            && wait >= left
        {
            return Err(Refused::TooLate { retry_after: wait });
        }
        Ok(())
    }

    fn work(&self) {
        while let Some(Waiting { ticket, run }) = self.next() {
            let began = Instant::now();
            run();
            let took = began.elapsed();
            let mut state = self.lock();
            state.running.retain(|running| !Arc::ptr_eq(running, &ticket));
            if ticket.started() {
                state.forecast.note(took);
            }
            state.idle += 1;
        }
    }

    /// The next computation; `None` once the pool is closed and its queue empty. The calling thread counts as idle until
    /// then.
    fn next(&self) -> Option<Waiting> {
        let state = self.lock();
        let wait = |state: &mut State| state.waiting.len() == 0 && state.open;
        let mut state = self.wake.wait_while(state, wait).unwrap_or_else(PoisonError::into_inner);
        state.idle -= 1;
        let next = state.waiting.pop()?;
        state.running.push(Arc::clone(&next.ticket));
        Some(next)
    }
}

impl State {
    /// True if a thread is left for a newcomer, once each idle one has taken one of those that wait.
    fn thread_free(&self) -> bool {
        self.waiting.len() < self.idle
    }

    /// How long the owner's next computation would wait for a thread, as far as anything is known.
    fn wait(&self, owner: &str, threads: usize) -> Option<Duration> {
        let ahead = self.waiting.ahead_of(owner).map(|waiting| &waiting.ticket);
        self.forecast.wait(threads, self.running.iter().chain(ahead).map(|ticket| ticket.left()))
    }
}

/// No invariant of what these locks guard can be broken by a panic.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
