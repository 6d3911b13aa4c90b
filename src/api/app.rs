//! What the handlers share: the settings, the planning pool, and the way from a request to bytes that never stalls the
//! threads that serve connections.

use core::time::Duration;
use std::io;
use std::sync::Arc;
use std::time::Instant;

use tokio::sync::Semaphore;
use tokio::task::spawn_blocking;
use tracing::Span;

use super::body::{self, Received};
use super::edge;
use super::problem::{internal, not_ready, refusal, refused, unread};
use super::reading::{Known, Read, Reading, SMALL_BODY};
use super::settings::ServerSettings;
use crate::jobs::{self, Owner, Runner, Store};
use crate::keys::Keys;
use crate::metrics::{Metrics, Queue, Refusal};
use crate::traces::Context;
use crate::wire::{Glance, PlanRequest, Problem, RequestLimits};
use crate::workers::{Draining, Engine, Outcome, Pending, Pool, Refused};
use singulate_planner::budget::Budget;

/// The service's state.
pub struct App {
    pub(super) settings: ServerSettings,
    /// Who may call; without keys everybody may.
    pub(super) keys: Option<Keys>,
    pub(super) engine: Engine,
    pub(super) pool: Pool,
    pub(super) store: Arc<dyn Store>,
    pub(super) runner: Arc<Runner>,
    pub(super) metrics: Arc<Metrics>,
    /// Room for bodies, in pieces.
    pub(super) bodies: Arc<Semaphore>,
    /// Room for requests that hand in jobs.
    pub(super) submitting: Semaphore,
    /// Room for clients that wait for a job.
    pub(super) waiting: Semaphore,
    /// Room for streams of events.
    pub(super) streams: Arc<Semaphore>,
    pub(super) draining: Draining,
}

/// How long a body may wait to be read where nothing else limits its time.
const READING_LIMIT: Duration = Duration::from_secs(5);

/// Requests that may hand in jobs at a time. Their writes stand in one line with those of the workers, a millisecond or two
/// each: behind many more of them jobs would begin and end late.
const MAX_SUBMITTING: usize = 32;

/// The body of a response.
pub(super) type Served = Result<Vec<u8>, Problem>;

impl App {
    /// Reads the keys, opens the store of jobs and starts the planning threads.
    ///
    /// # Errors
    /// If the keys are faulty, the store can't be opened, or the system gives no thread.
    pub async fn start(settings: ServerSettings, engine: Engine) -> io::Result<Self> {
        let keys = settings.api_keys_file.as_deref().map(Keys::open).transpose().map_err(io::Error::other)?;
        let metrics = Arc::<Metrics>::default();
        let store = jobs::open(&settings.jobs, Arc::clone(&metrics)).await.map_err(io::Error::other)?;
        let pool = Pool::new(settings.threads, settings.queue)?;
        let runner = Runner::new(Arc::clone(&store), Arc::clone(&metrics), &settings.jobs, engine, settings.limits)?;
        let (waiting, streams) = (Semaphore::new(settings.max_waiting), Semaphore::new(settings.max_streams));
        let bodies = body::room(settings.max_body_bytes);
        Ok(Self {
            settings,
            keys,
            engine,
            pool,
            store,
            runner: Arc::new(runner),
            metrics,
            submitting: Semaphore::new(MAX_SUBMITTING),
            bodies: Arc::new(bodies),
            waiting,
            streams: Arc::new(streams),
            draining: Draining::default(),
        })
    }

    /// Take over what the keys file says whenever that changes.
    pub(super) async fn watch_keys(&self) {
        if let Some(keys) = &self.keys {
            keys.watch().await;
        }
    }

    /// From now on the service says that it is not ready, and begins nothing new.
    pub(super) fn drain(&self) {
        tracing::info!(computations = self.pool.busy(), "draining");
        self.draining.begin();
    }

    /// The time for draining is nearly over.
    pub(super) fn finish_soon(&self) {
        tracing::warn!(computations = self.pool.busy(), "what still runs has to deliver the best so far");
        self.pool.finish_soon();
    }

    /// True if new requests are welcome.
    pub(super) fn ready(&self) -> bool {
        !self.draining.begun() && self.pool.ready() && self.runner.ready()
    }

    /// Nothing new begins while the service drains.
    ///
    /// # Errors
    /// A problem while it does.
    pub(super) fn takes_work(&self) -> Result<(), Problem> {
        if !self.draining.begun() {
            return Ok(());
        }
        self.metrics.refused(Refusal::NotReady);
        Err(not_ready())
    }

    /// Read a body that is not to be answered at once: a small one here, a large one on the planning pool.
    pub(super) async fn read<T: Send + 'static>(
        &self,
        owner: &Owner,
        arrival: Instant,
        body: Received,
        read: impl FnOnce(&[u8], &RequestLimits) -> Result<T, Problem> + Send + 'static,
    ) -> Result<T, Problem> {
        let limits = self.settings.limits;
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

    /// Run `work` on the planning pool. What is logged and traced there is the request's too.
    fn begin<T: Send + 'static>(
        &self,
        owner: &Owner,
        arrival: Instant,
        time_limit: Duration,
        work: impl FnOnce(&Budget<'_>) -> T + Send + 'static,
    ) -> Result<Pending<T>, Problem> {
        let (metrics, span, context) = (Arc::clone(&self.metrics), Span::current(), Context::current());
        let queued = Instant::now();
        let work = move |budget: &Budget<'_>| {
            metrics.waited(Queue::Plan, queued.elapsed());
            let _context = context.attach();
            span.in_scope(|| work(budget))
        };
        self.pool.submit(owner.as_str(), arrival, time_limit, work).map_err(|error| self.turn_away(error))
    }

    /// A request that would be refused anyway is refused before its body is read, which costs twice a glance: under overload
    /// most are, and their reading would take the cores from those that are not. The glance, where there was one.
    fn refuse_unread(&self, owner: &Owner, arrival: Instant, body: &[u8]) -> Result<Option<Glance>, Problem> {
        if self.pool.idle() > 0 {
            return Ok(None);
        }
        let glance = Glance::at(body, &self.settings.limits);
        let left = glance.time_limit.saturating_sub(arrival.elapsed());
        self.pool.room(owner.as_str(), left).map_err(|error| self.turn_away(error))?;
        Ok(Some(glance))
    }

    fn turn_away(&self, error: Refused) -> Problem {
        self.metrics.refused(refusal(error));
        refused(error)
    }

    /// Read the body and run `work` on the planning pool; where the time limit comes first, `too_late` says what is left
    /// to say. The limit counts from `arrival`.
    pub(super) async fn answer<R: AsRef<PlanRequest> + Send + Sync + 'static>(
        &self,
        owner: &Owner,
        arrival: Instant,
        (body, read): (Received, Read<R>),
        work: impl FnOnce(&R, &Budget<'_>) -> Served + Send + 'static,
        too_late: impl FnOnce(Known<'_, R>) -> Served + Send + 'static,
    ) -> Served {
        self.takes_work()?;
        let glance = self.refuse_unread(owner, arrival, &body)?;
        let reading = Arc::new(Reading::begin(body, glance, read, self.settings.limits)?);
        edge::note_scene(reading.glance().scene_id.as_deref());
        let own = Arc::clone(&reading);
        let time_limit = reading.glance().time_limit;
        let pending = self.begin(owner, arrival, time_limit, move |budget| work(own.request()?, budget))?;
        match pending.outcome().await {
            Outcome::Done(served) => served,
            Outcome::TimedOut => {
                let told = spawn_blocking(move || too_late(reading.known())).await;
                let told = told.unwrap_or_else(|_| Err(internal()));
                if told.is_err() {
                    self.metrics.refused(Refusal::TooLate);
                }
                told
            }
            Outcome::Panicked => Err(reading.panicked()),
        }
    }
}

/// A body as JSON.
pub(super) fn json(body: &impl serde::Serialize) -> Served {
    serde_json::to_vec(body).map_err(|error| {
        tracing::error!(%error, "an answer could not be written");
        internal()
    })
}
