//! A computation from its caller's side: how long it may take, whether anybody still waits for it, and what became of it.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use tokio::sync::{Notify, oneshot};
use tokio::time::sleep_until;

use singulate_planner::budget::{Budget, Clock};

/// How long after the deadline a running computation may still deliver. The answer must leave within 50 ms of it, and on a
/// busy machine it takes a while to be written.
const DELIVERY_GRACE: Duration = Duration::from_millis(20);

/// What a computation that is to finish soon has left: for the places of the best set so far, and their check. The core is
/// to be free within 20 ms, and half of that is for the loops to hear of it and for a last replay.
const LAST_WORDS: Duration = Duration::from_millis(10);

/// A limit too long to be added to a clock's time stands for this one.
const FAR: Duration = Duration::from_hours(24 * 365);

/// What became of a computation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome<T> {
    /// It came to an end.
    Done(T),
    /// Its deadline passed first, or it was to finish before it had begun.
    TimedOut,
    /// It panicked.
    Panicked,
}

/// A computation that was taken. Dropping this cancels it.
#[derive(Debug)]
pub struct Pending<T> {
    ticket: Arc<Ticket>,
    reply: oneshot::Receiver<Outcome<T>>,
}

/// Calls a computation to its end while somebody else waits for its outcome. All clones call the same.
#[derive(Debug, Clone)]
pub struct Recall(Arc<Ticket>);

impl Recall {
    /// The computation delivers the best so far; where it still waits for a thread, it has timed out.
    pub fn finish_soon(&self) {
        self.0.finish_soon();
    }
}

/// What the caller and the thread share about one computation.
#[derive(Debug)]
pub(super) struct Ticket {
    arrival: Instant,
    time_limit: Duration,
    /// Time that the caller took back, ns.
    withdrawn: AtomicU64,
    /// Told when that happens.
    recalled: Notify,
    cancelled: AtomicBool,
    started: AtomicBool,
}

impl Ticket {
    pub(super) fn new(arrival: Instant, time_limit: Duration) -> Self {
        Self {
            arrival,
            time_limit: time_limit.min(FAR),
            withdrawn: AtomicU64::new(0),
            recalled: Notify::new(),
            cancelled: AtomicBool::new(false),
            started: AtomicBool::new(false),
        }
    }

    fn deadline(&self) -> Instant {
        self.arrival + self.time_limit
    }

    /// How long it may still take.
    pub(super) fn left(&self) -> Duration {
        self.time_limit.saturating_sub(self.elapsed()).saturating_sub(self.withdrawn())
    }

    /// True once it has run, or runs.
    pub(super) fn started(&self) -> bool {
        self.started.load(Ordering::Acquire)
    }

    /// True of one that waits for a thread if nobody waits for the answer any more.
    pub(super) fn abandoned(&self) -> bool {
        self.cancelled() || !self.withdrawn().is_zero() || self.left().is_zero()
    }

    pub(super) fn finish_soon(&self) {
        let spare = self.left().saturating_sub(LAST_WORDS);
        // FAR is far below what this can count. A second call finds nothing to spare.
        self.withdrawn.fetch_max(u64::try_from(spare.as_nanos()).unwrap_or(u64::MAX), Ordering::Relaxed);
        self.recalled.notify_one();
    }

    /// On a thread of the pool.
    pub(super) fn run<T>(&self, computation: impl FnOnce(&Budget<'_>) -> T) -> Outcome<T> {
        if self.abandoned() {
            return Outcome::TimedOut;
        }
        self.started.store(true, Ordering::Release);
        let budget = Budget::new(self, self.time_limit);
        // The computation owns all that it touches, so nothing half-done is left behind.
        catch_unwind(AssertUnwindSafe(|| computation(&budget))).map_or(Outcome::Panicked, Outcome::Done)
    }
}

impl Clock for Ticket {
    fn elapsed(&self) -> Duration {
        self.arrival.elapsed()
    }

    fn cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }

    fn withdrawn(&self) -> Duration {
        Duration::from_nanos(self.withdrawn.load(Ordering::Relaxed))
    }
}

impl<T> Pending<T> {
    pub(super) fn new(ticket: Arc<Ticket>, reply: oneshot::Receiver<Outcome<T>>) -> Self {
        Self { ticket, reply }
    }

    /// The way to its early end.
    pub fn recall(&self) -> Recall {
        Recall(Arc::clone(&self.ticket))
    }

    /// Wait for the computation, but not past its deadline: at once where it still waits for a thread, a little longer
    /// where it runs and is about to deliver. One that was recalled is waited for no less: what it has found by then is
    /// still wanted.
    pub async fn outcome(mut self) -> Outcome<T> {
        let deadline = self.ticket.deadline();
        tokio::select! {
            biased;
            reply = &mut self.reply => return self.replied(reply.ok()),
            () = self.ticket.recalled.notified() => {}
            () = sleep_until(deadline.into()) => {}
        }
        if !self.ticket.started() {
            return Outcome::TimedOut;
        }
        tokio::select! {
            biased;
            reply = &mut self.reply => self.replied(reply.ok()),
            () = sleep_until((deadline + DELIVERY_GRACE).into()) => Outcome::TimedOut,
        }
    }

    fn replied(&self, reply: Option<Outcome<T>>) -> Outcome<T> {
        match reply {
            Some(outcome) => outcome,
            // Its thread died.
            None if self.ticket.started() => Outcome::Panicked,
            // It lost its place in the queue to somebody who has time left.
            None => Outcome::TimedOut,
        }
    }
}

impl<T> Drop for Pending<T> {
    fn drop(&mut self) {
        self.ticket.cancelled.store(true, Ordering::Relaxed);
    }
}
