//! The pool: a few threads, a bounded queue, and a deadline per computation, counted from the arrival of its request. A
//! computation whose caller has gone or whose deadline has passed never starts. A running one is stopped through its
//! budget. One that is not expected to start in time is refused at once.

use std::io;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use tokio::sync::oneshot;

use super::forecast::Forecast;
use super::pending::{Pending, Ticket};
use super::queue::Queue;
use singulate_planner::budget::Budget;

/// A fixed number of threads and the queue for them.
#[derive(Debug)]
pub struct Pool {
    pub(super) shared: Arc<Shared>,
    threads: Mutex<Vec<JoinHandle<()>>>,
}

/// Why a computation was refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Refused {
    /// Every thread is busy and the queue is full.
    #[error("every thread is busy and the queue is full")]
    Full,
    /// Every thread is busy, and none is expected to be free before the deadline.
    #[error("no thread is likely to be free within the time limit")]
    TooLate {
        /// When a thread is expected to be free.
        retry_after: Duration,
    },
    /// The pool is closed.
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
    /// The running computations, one per busy thread.
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

/// The search for places calls itself once per relocated object: at the default limit up to 10,000 levels deep, of a
/// 1 to 2 kB each. A thread's usual 2 MB would do for some 1,500. Only used pages take memory.
const STACK_BYTES: usize = 64 << 20;

impl Pool {
    /// `threads` threads (at least one), and a queue of `queue` places.
    ///
    /// # Errors
    /// If a thread can't be started.
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

    /// Submit a computation whose request arrived at `arrival` with this time limit. Owners take turns.
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
            // The caller may have gone.
            let _ = sender.send(own.run(computation));
        });
        self.shared.enqueue(owner, Waiting { ticket: Arc::clone(&ticket), run })?;
        Ok(Pending::new(ticket, reply))
    }

    /// Admission check for a computation with this much time left. Cheaper than making the computation.
    ///
    /// # Errors
    /// [`Refused`] if there is no room, or no time.
    pub fn room(&self, owner: &str, left: Duration) -> Result<(), Refused> {
        self.shared.room(&mut self.shared.lock(), owner, left)
    }

    /// True if every thread is alive and the pool is open.
    pub fn ready(&self) -> bool {
        self.shared.lock().open && lock(&self.threads).iter().all(|thread| !thread.is_finished())
    }

    /// The number of idle threads.
    pub fn idle(&self) -> usize {
        self.shared.lock().idle
    }

    /// The number of busy threads.
    pub fn busy(&self) -> usize {
        self.shared.lock().running.len()
    }

    /// Running computations deliver the best so far, and queued ones never start.
    pub fn finish_soon(&self) {
        let state = self.shared.lock();
        let waiting = state.waiting.iter().map(|waiting| &waiting.ticket);
        state.running.iter().chain(waiting).for_each(|ticket| ticket.finish_soon());
    }

    /// Accept no more computations.
    pub fn close(&self) {
        self.shared.lock().open = false;
        self.shared.wake.notify_all();
    }

    /// Close the pool and wait until all accepted computations have ended. Blocks.
    pub fn join(&self) {
        self.close();
        let threads = core::mem::take(&mut *lock(&self.threads));
        for thread in threads {
            // A thread panics only if the process is about to end.
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
        // A free thread begins at once, whatever the forecast.
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

    /// The next computation; `None` once the pool is closed and its queue empty. Meanwhile the calling thread counts as
    /// idle.
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
    /// True if an idle thread remains after each queued computation has got one.
    fn thread_free(&self) -> bool {
        self.waiting.len() < self.idle
    }

    /// How long the owner's next computation would wait for a thread; `None` if there is no forecast.
    fn wait(&self, owner: &str, threads: usize) -> Option<Duration> {
        let ahead = self.waiting.ahead_of(owner).map(|waiting| &waiting.ticket);
        self.forecast.wait(threads, self.running.iter().chain(ahead).map(|ticket| ticket.left()))
    }
}

/// A panic can't break an invariant of the locked data.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
