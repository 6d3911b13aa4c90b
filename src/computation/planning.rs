//! From a body to the bytes of its answer, without blocking the threads that serve connections.

use core::ops::Deref;
use core::time::Duration;
use std::io;
use std::sync::Arc;
use std::time::Instant;

use tokio::task::spawn_blocking;
use tracing::Span;

use super::problem::{internal, not_ready, unread};
use super::reading::{Reading, SMALL_BODY};
use super::{Computation, Served, Tools};
use crate::metrics::{Queue, Refusal};
use crate::traces::Context;
use crate::wire::{Glance, Problem, RequestLimits};
use crate::workers::{Draining, Pending, Pool, PoolOutcome, Refused};
use singulate_planner::budget::Budget;

/// The time limit for reading a body that has no other limit.
const READING_LIMIT: Duration = Duration::from_secs(5);

/// The planning calls of one server, and the threads that compute for them.
pub struct Planning {
    pool: Pool,
    tools: Tools,
    limits: RequestLimits,
    draining: Draining,
}

impl Planning {
    /// Start this many threads, with a queue of this length.
    ///
    /// # Errors
    /// If a thread can't be started.
    pub fn start(
        (threads, queue): (usize, usize),
        tools: Tools,
        limits: RequestLimits,
        draining: Draining,
    ) -> io::Result<Self> {
        Ok(Self { pool: Pool::new(threads, queue)?, tools, limits, draining })
    }

    /// Refuses new work while the service drains.
    ///
    /// # Errors
    /// A problem while it drains.
    pub fn takes_work(&self) -> Result<(), Problem> {
        if !self.draining.begun() {
            return Ok(());
        }
        self.tools.metrics.refused(Refusal::NotReady);
        Err(not_ready())
    }

    /// Read a body that is not answered at once: a small one here, a large one on the pool.
    ///
    /// # Errors
    /// The problem from `read`, or one if there is no room or no time.
    pub async fn read<T: Send + 'static>(
        &self,
        owner: &str,
        arrival: Instant,
        body: impl Deref<Target = [u8]> + Send + 'static,
        read: impl FnOnce(&[u8], &RequestLimits) -> Result<T, Problem> + Send + 'static,
    ) -> Result<T, Problem> {
        let limits = self.limits;
        if body.len() <= SMALL_BODY {
            return read(&body, &limits);
        }
        let pending = self.begin(owner, arrival, READING_LIMIT, move |_| read(&body, &limits))?;
        match pending.outcome().await {
            PoolOutcome::Done(read) => read,
            PoolOutcome::TimedOut => Err(unread()),
            PoolOutcome::Panicked => Err(internal()),
        }
    }

    /// Read the body and compute its answer on the pool, or respond without it if the time limit comes first. The limit
    /// counts from `arrival`.
    ///
    /// # Errors
    /// A problem if there is no answer.
    pub async fn answer<C: Computation>(
        &self,
        owner: &str,
        arrival: Instant,
        body: impl Deref<Target = [u8]> + Send + Sync + 'static,
        computation: C,
    ) -> Served {
        self.takes_work()?;
        let glance = self.refuse_unread(owner, arrival, &body)?;
        let reading = Arc::new(Reading::<C, _>::begin(body, glance, self.limits)?);
        note_scene(reading.glance().scene_id.as_deref());
        let (own, tools) = (Arc::clone(&reading), self.tools.clone());
        let time_limit = reading.glance().time_limit;
        let compute = move |budget: &Budget<'_>| computation.compute(&tools, own.request()?, budget);
        let pending = self.begin(owner, arrival, time_limit, compute)?;
        match pending.outcome().await {
            PoolOutcome::Done(served) => served,
            PoolOutcome::TimedOut => {
                let told = spawn_blocking(move || computation.too_late(reading.known())).await;
                let told = told.unwrap_or_else(|_| Err(internal()));
                if told.is_err() {
                    self.tools.metrics.refused(Refusal::TooLate);
                }
                told
            }
            PoolOutcome::Panicked => Err(reading.panicked()),
        }
    }

    /// When no thread is idle, refuse by the glance alone, before the costlier reading: under overload most requests are
    /// refused. Returns the glance if one was taken.
    fn refuse_unread(&self, owner: &str, arrival: Instant, body: &[u8]) -> Result<Option<Glance>, Problem> {
        if self.pool.idle() > 0 {
            return Ok(None);
        }
        let glance = Glance::at(body, &self.limits);
        let left = glance.time_limit.saturating_sub(arrival.elapsed());
        self.pool.room(owner, left).map_err(|error| self.turn_away(error))?;
        Ok(Some(glance))
    }

    /// Run `work` on the pool. Its log lines and spans belong to the request.
    fn begin<T: Send + 'static>(
        &self,
        owner: &str,
        arrival: Instant,
        time_limit: Duration,
        work: impl FnOnce(&Budget<'_>) -> T + Send + 'static,
    ) -> Result<Pending<T>, Problem> {
        let (metrics, span, context) = (Arc::clone(&self.tools.metrics), Span::current(), Context::current());
        let queued = Instant::now();
        let work = move |budget: &Budget<'_>| {
            metrics.waited(Queue::Plan, queued.elapsed());
            let _context = context.attach();
            span.in_scope(|| work(budget))
        };
        self.pool.submit(owner, arrival, time_limit, work).map_err(|error| self.turn_away(error))
    }

    fn turn_away(&self, error: Refused) -> Problem {
        self.tools.metrics.refused(error.into());
        error.into()
    }

    /// True if every thread is alive and the pool is open.
    pub fn ready(&self) -> bool {
        self.pool.ready()
    }

    /// The number of busy threads.
    pub fn busy(&self) -> usize {
        self.pool.busy()
    }

    /// Running computations deliver the best so far, and queued ones never start.
    pub fn finish_soon(&self) {
        self.pool.finish_soon();
    }

    /// Close the pool and wait until all accepted computations have ended. Blocks.
    pub fn join(&self) {
        self.pool.join();
    }
}

/// Add the scene's id to the log lines of the request.
pub fn note_scene(scene_id: Option<&str>) {
    if let Some(scene_id) = scene_id {
        Span::current().record("scene_id", scene_id);
    }
}
