//! The way from a body to the bytes of its answer, which never stalls the threads that serve connections.

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
use crate::workers::{Draining, Outcome, Pending, Pool, Refused};
use singulate_planner::budget::Budget;

/// How long a body may wait to be read where nothing else limits its time.
const READING_LIMIT: Duration = Duration::from_secs(5);

/// The planning calls of one server, and the threads that compute for them.
pub struct Planning {
    pool: Pool,
    tools: Tools,
    limits: RequestLimits,
    draining: Draining,
}

impl Planning {
    /// Start so many threads, with room for so many computations that wait for one.
    ///
    /// # Errors
    /// If the system gives no thread.
    pub fn start(
        (threads, queue): (usize, usize),
        tools: Tools,
        limits: RequestLimits,
        draining: Draining,
    ) -> io::Result<Self> {
        Ok(Self { pool: Pool::new(threads, queue)?, tools, limits, draining })
    }

    /// Nothing new begins while the service drains.
    ///
    /// # Errors
    /// A problem while it does.
    pub fn takes_work(&self) -> Result<(), Problem> {
        if !self.draining.begun() {
            return Ok(());
        }
        self.tools.metrics.refused(Refusal::NotReady);
        Err(not_ready())
    }

    /// Read a body that is not to be answered at once: a small one here, a large one on the pool.
    ///
    /// # Errors
    /// The problem that `read` finds, or one if there is no room or no time for reading.
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
            Outcome::Done(read) => read,
            Outcome::TimedOut => Err(unread()),
            Outcome::Panicked => Err(internal()),
        }
    }

    /// Read the body and compute its answer on the pool, or say what is left to say where the time limit comes first. The
    /// limit counts from `arrival`.
    ///
    /// # Errors
    /// A problem where there is no answer.
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
            Outcome::Done(served) => served,
            Outcome::TimedOut => {
                let told = spawn_blocking(move || computation.too_late(reading.known())).await;
                let told = told.unwrap_or_else(|_| Err(internal()));
                if told.is_err() {
                    self.tools.metrics.refused(Refusal::TooLate);
                }
                told
            }
            Outcome::Panicked => Err(reading.panicked()),
        }
    }

    /// A request that would be refused anyway is refused before its body is read, which costs several times a glance: under overload
    /// most are, and their reading would take the cores from those that are not. The glance, where there was one.
    fn refuse_unread(&self, owner: &str, arrival: Instant, body: &[u8]) -> Result<Option<Glance>, Problem> {
        if self.pool.idle() > 0 {
            return Ok(None);
        }
        let glance = Glance::at(body, &self.limits);
        let left = glance.time_limit.saturating_sub(arrival.elapsed());
        self.pool.room(owner, left).map_err(|error| self.turn_away(error))?;
        Ok(Some(glance))
    }

    /// Run `work` on the pool. What is logged and traced there is the request's too.
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

    /// True if every thread lives and computations are taken.
    pub fn ready(&self) -> bool {
        self.pool.ready()
    }

    /// The number of threads that compute.
    pub fn busy(&self) -> usize {
        self.pool.busy()
    }

    /// Everything that runs delivers the best so far, and nothing that waits begins.
    pub fn finish_soon(&self) {
        self.pool.finish_soon();
    }

    /// Take no more computations, and wait until those that were taken have come to their end. Blocks.
    pub fn join(&self) {
        self.pool.join();
    }
}

/// Name the scene in the log lines of the request that is about it.
pub fn note_scene(scene_id: Option<&str>) {
    if let Some(scene_id) = scene_id {
        Span::current().record("scene_id", scene_id);
    }
}
