//! A job from its caller's side: how long it may take, whether anybody still waits for it, and what became of it.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use tokio::sync::oneshot;
use tokio::time::sleep_until;

use crate::budget::{Budget, Clock};

/// How long after the deadline a running job may still deliver. The answer must leave within 50 ms of it, and on a busy
/// machine it takes a while to be written.
const DELIVERY_GRACE: Duration = Duration::from_millis(20);

/// A limit too long to be added to a clock's time stands for this one.
const FAR: Duration = Duration::from_hours(24 * 365);

/// What became of a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome<T> {
    /// It came to an end.
    Done(T),
    /// Its deadline passed first.
    TimedOut,
    /// It panicked.
    Panicked,
}

/// A job that was taken. Dropping this cancels it.
#[derive(Debug)]
pub struct Pending<T> {
    ticket: Arc<Ticket>,
    reply: oneshot::Receiver<Outcome<T>>,
}

/// Ends a computation early, with the best so far.
#[derive(Debug, Clone)]
pub struct Ender {
    ticket: Arc<Ticket>,
}

impl Ender {
    /// Let it deliver the best so far.
    pub fn finish_soon(&self) {
        self.ticket.cancelled.store(true, Ordering::Relaxed);
    }
}

/// What the caller and the thread share about one job.
#[derive(Debug)]
pub(super) struct Ticket {
    arrival: Instant,
    time_limit: Duration,
    cancelled: AtomicBool,
    started: AtomicBool,
}

impl Ticket {
    pub(super) fn new(arrival: Instant, time_limit: Duration) -> Self {
        Self { arrival, time_limit, cancelled: AtomicBool::new(false), started: AtomicBool::new(false) }
    }

    fn deadline(&self) -> Instant {
        self.arrival.checked_add(self.time_limit).unwrap_or_else(|| self.arrival + FAR)
    }

    /// True if nobody waits for the answer any more.
    pub(super) fn abandoned(&self) -> bool {
        self.cancelled() || self.elapsed() >= self.time_limit
    }

    /// On a thread of the pool.
    pub(super) fn run<T>(&self, job: impl FnOnce(&Budget<'_>) -> T) -> Outcome<T> {
        self.started.store(true, Ordering::Release);
        if self.abandoned() {
            return Outcome::TimedOut;
        }
        let budget = Budget::new(self, self.time_limit);
        // The job owns all that it touches, so nothing half-done is left behind.
        catch_unwind(AssertUnwindSafe(|| job(&budget))).map_or(Outcome::Panicked, Outcome::Done)
    }
}

impl Clock for Ticket {
    fn elapsed(&self) -> Duration {
        self.arrival.elapsed()
    }

    fn cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }
}

impl<T> Pending<T> {
    /// The means to end the computation while somebody waits for it.
    pub fn ender(&self) -> Ender {
        Ender { ticket: Arc::clone(&self.ticket) }
    }

    pub(super) fn new(ticket: Arc<Ticket>, reply: oneshot::Receiver<Outcome<T>>) -> Self {
        Self { ticket, reply }
    }

    /// Wait for the job, but not past its deadline: at once where it still waits for a thread, a little longer where it
    /// runs and is about to deliver.
    pub async fn outcome(mut self) -> Outcome<T> {
        let deadline = self.ticket.deadline();
        if let Some(outcome) = self.until(deadline).await {
            return outcome;
        }
        if !self.ticket.started.load(Ordering::Acquire) {
            return Outcome::TimedOut;
        }
        self.until(deadline + DELIVERY_GRACE).await.unwrap_or(Outcome::TimedOut)
    }

    async fn until(&mut self, instant: Instant) -> Option<Outcome<T>> {
        tokio::select! {
            biased;
            // A reply that never comes means that its thread died.
            outcome = &mut self.reply => Some(outcome.unwrap_or(Outcome::Panicked)),
            () = sleep_until(instant.into()) => None,
        }
    }
}

impl<T> Drop for Pending<T> {
    fn drop(&mut self) {
        self.ticket.cancelled.store(true, Ordering::Relaxed);
    }
}
