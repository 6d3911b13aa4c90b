//! What the handlers share: the settings, the planning pool, and the way from a request to bytes that never stalls the
//! threads that serve connections.

use core::time::Duration;
use std::io;
use std::sync::Arc;
use std::time::Instant;

use tokio::sync::Semaphore;
use tokio::task::spawn_blocking;

use super::log;
use super::problem::{internal, not_ready, refused, unread};
use super::reading::{Known, Read, Reading, SMALL_BODY};
use super::settings::ServerSettings;
use crate::budget::Budget;
use crate::jobs::{self, Owner, Runner, Store};
use crate::wire::{Glance, PlanRequest, Problem, RequestLimits};
use crate::workers::{Draining, Engine, Outcome, Pool};

/// The service's state.
pub struct App {
    pub(super) settings: ServerSettings,
    pub(super) engine: Engine,
    pub(super) pool: Pool,
    pub(super) store: Arc<dyn Store>,
    pub(super) runner: Arc<Runner>,
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
    /// Opens the store of jobs and starts the planning threads.
    ///
    /// # Errors
    /// If the store can't be opened, or the system gives no thread.
    pub async fn start(settings: ServerSettings, engine: Engine) -> io::Result<Self> {
        let store = jobs::open(&settings.jobs).await.map_err(io::Error::other)?;
        let pool = Pool::new(settings.threads, settings.queue)?;
        let runner = Arc::new(Runner::new(Arc::clone(&store), &settings.jobs, engine, settings.limits)?);
        let (waiting, streams) = (Semaphore::new(settings.max_waiting), Semaphore::new(settings.max_streams));
        let (submitting, draining) = (Semaphore::new(MAX_SUBMITTING), Draining::default());
        Ok(Self { settings, engine, pool, store, runner, submitting, waiting, streams: Arc::new(streams), draining })
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
        if self.draining.begun() { Err(not_ready()) } else { Ok(()) }
    }

    /// Read a body that is not to be answered at once: a small one here, a large one on the planning pool.
    pub(super) async fn read<T: Send + 'static>(
        &self,
        owner: &Owner,
        arrival: Instant,
        body: Vec<u8>,
        read: impl FnOnce(&[u8], &RequestLimits) -> Result<T, Problem> + Send + 'static,
    ) -> Result<T, Problem> {
        let limits = self.settings.limits;
        if body.len() <= SMALL_BODY {
            return read(&body, &limits);
        }
        let job = move |_: &Budget<'_>| read(&body, &limits);
        let pending = self.pool.submit(owner.as_str(), arrival, READING_LIMIT, job);
        match pending.map_err(refused)?.outcome().await {
            Outcome::Done(read) => read,
            Outcome::TimedOut => Err(unread()),
            Outcome::Panicked => Err(internal()),
        }
    }

    /// Whoever would be refused anyway is refused before the body is read, which costs ten times a glance: under overload
    /// most are, and their reading would take the cores from those that are not.
    fn refuse_unread(&self, arrival: Instant, body: &[u8]) -> Result<(), Problem> {
        if self.pool.idle() > 0 {
            return Ok(());
        }
        let time_limit = Glance::at(body, &self.settings.limits).time_limit;
        self.pool.room(Owner::anonymous().as_str(), time_limit.saturating_sub(arrival.elapsed())).map_err(refused)
    }

    /// Read the body and run `work` on the planning pool; where the time limit comes first, `too_late` says what is left
    /// to say. The limit counts from `arrival`.
    pub(super) async fn answer<R: AsRef<PlanRequest> + Send + Sync + 'static>(
        &self,
        arrival: Instant,
        (body, read): (Vec<u8>, Read<R>),
        work: impl FnOnce(&R, &Budget<'_>) -> Served + Send + 'static,
        too_late: impl FnOnce(Known<'_, R>) -> Served + Send + 'static,
    ) -> Served {
        self.takes_work()?;
        self.refuse_unread(arrival, &body)?;
        let reading = Arc::new(Reading::begin(body, read, self.settings.limits)?);
        log::note_scene(reading.glance().scene_id.as_deref());
        let own = Arc::clone(&reading);
        let job = move |budget: &Budget<'_>| work(own.request()?, budget);
        let pending = self
            .pool
            .submit(Owner::anonymous().as_str(), arrival, reading.glance().time_limit, job)
            .map_err(refused)?;
        match pending.outcome().await {
            Outcome::Done(served) => served,
            Outcome::TimedOut => {
                spawn_blocking(move || too_late(reading.known())).await.unwrap_or_else(|_| Err(internal()))
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
