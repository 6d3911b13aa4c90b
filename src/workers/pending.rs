//! A computation from its caller's side: its deadline, its cancellation and its outcome.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use tokio::sync::{Notify, oneshot};
use tokio::time::sleep_until;

use singulate_planner::budget::{Budget, Clock};

/// Grace period after the deadline in which a running computation may deliver. The answer must leave within 50 ms of
/// the deadline, and on a busy machine it takes a while to be written.
const DELIVERY_GRACE: Duration = Duration::from_millis(20);

/// The time left to a recalled computation: to place the best set so far and check the plan. The core must be free
/// within 20 ms; half of that is for the loops to notice and for a last replay.
const LAST_WORDS: Duration = Duration::from_millis(10);

/// Replaces limits too long to be added to a clock's time.
const FAR: Duration = Duration::from_hours(24 * 365);

/// The outcome of a computation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PoolOutcome<T> {
    /// It came to an end.
    Done(T),
    /// Its deadline passed first, or it was recalled before it began.
    TimedOut,
    /// It panicked.
    Panicked,
}

/// An accepted computation. Dropping this cancels it.
#[derive(Debug)]
pub struct Pending<T> {
    ticket: Arc<Ticket>,
    reply: oneshot::Receiver<PoolOutcome<T>>,
}

/// Recalls a computation while another task waits for its outcome. Clones recall the same one.
#[derive(Debug, Clone)]
pub struct Recall(Arc<Ticket>);

impl Recall {
    /// Recall it: it delivers the best so far, or times out if it is still queued.
    pub fn finish_soon(&self) {
        self.0.finish_soon();
    }
}

/// The state of one computation that its caller and its thread share.
#[derive(Debug)]
pub(super) struct Ticket {
    arrival: Instant,
    time_limit: Duration,
    /// Time that was withdrawn, ns.
    withdrawn: AtomicU64,
    /// Notified when that happens.
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

    /// The time left.
    pub(super) fn left(&self) -> Duration {
        self.time_limit.saturating_sub(self.elapsed()).saturating_sub(self.withdrawn())
    }

    /// True once it has started.
    pub(super) fn started(&self) -> bool {
        self.started.load(Ordering::Acquire)
    }

    /// True if a queued computation need not start any more.
    pub(super) fn abandoned(&self) -> bool {
        self.cancelled() || !self.withdrawn().is_zero() || self.left().is_zero()
    }

    pub(super) fn finish_soon(&self) {
        let spare = self.left().saturating_sub(LAST_WORDS);
        // FAR is far below the limit of this counter. A second call withdraws nothing more.
        self.withdrawn.fetch_max(u64::try_from(spare.as_nanos()).unwrap_or(u64::MAX), Ordering::Relaxed);
        self.recalled.notify_one();
    }

    /// Runs the computation on the calling thread, one of the pool's.
    pub(super) fn run<T>(&self, computation: impl FnOnce(&Budget<'_>) -> T) -> PoolOutcome<T> {
        if self.abandoned() {
            return PoolOutcome::TimedOut;
        }
        self.started.store(true, Ordering::Release);
        let budget = Budget::new(self, self.time_limit);
        // The computation owns all its data, so a panic leaves nothing half-done.
        catch_unwind(AssertUnwindSafe(|| computation(&budget))).map_or(PoolOutcome::Panicked, PoolOutcome::Done)
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
    pub(super) fn new(ticket: Arc<Ticket>, reply: oneshot::Receiver<PoolOutcome<T>>) -> Self {
        Self { ticket, reply }
    }

    /// A handle to end it early.
    pub fn recall(&self) -> Recall {
        Recall(Arc::clone(&self.ticket))
    }

    /// Wait for the outcome, but not past the deadline: a queued computation times out at once, a running one has a
    /// grace period to deliver. A recalled one is waited for as long, since its result is still wanted.
    pub async fn outcome(mut self) -> PoolOutcome<T> {
        let deadline = self.ticket.deadline();
        tokio::select! {
            biased;
            reply = &mut self.reply => return self.replied(reply.ok()),
            () = self.ticket.recalled.notified() => {}
            () = sleep_until(deadline.into()) => {}
        }
        if !self.ticket.started() {
            return PoolOutcome::TimedOut;
        }
        tokio::select! {
            biased;
            reply = &mut self.reply => self.replied(reply.ok()),
            () = sleep_until((deadline + DELIVERY_GRACE).into()) => PoolOutcome::TimedOut,
        }
    }

    fn replied(&self, reply: Option<PoolOutcome<T>>) -> PoolOutcome<T> {
        match reply {
            Some(outcome) => outcome,
            // Its thread has died.
            None if self.ticket.started() => PoolOutcome::Panicked,
            // Its time was over or it was recalled, so it was dropped from the queue.
            None => PoolOutcome::TimedOut,
        }
    }
}

impl<T> Drop for Pending<T> {
    fn drop(&mut self) {
        self.ticket.cancelled.store(true, Ordering::Relaxed);
    }
}
