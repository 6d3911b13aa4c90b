//! What the handlers share: the settings, the planning pool, and the way from a request to bytes that never stalls the
//! threads that serve connections.

use core::time::Duration;
use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use tokio::sync::Semaphore;
use tokio::task::spawn_blocking;
use tokio::time::timeout;

use super::problem::{internal, refused};
use super::settings::ServerSettings;
use crate::budget::Budget;
use crate::jobs::{Outcome, Pool, Refused};
use crate::plan::check::{self, Report};
use crate::plan::{self, Answer, Claim, PlanError, Settings, SurveyEntry};
use crate::scene::Scene;
use crate::wire::{PlanRequest, Problem, RequestLimits};

/// Bodies up to this many bytes are read where they arrive: about a millisecond.
const SMALL_BODY: usize = 64 * 1024;

/// How long a large body may wait for its turn to be read.
const READING_PATIENCE: Duration = Duration::from_millis(500);

/// The computations that the service offers. The default is the planner; a test may stand in another.
#[derive(Clone, Copy)]
pub struct Engine {
    /// Plan for the scene's target.
    pub plan: fn(&Scene, &Settings, &Budget<'_>) -> Result<Answer, PlanError>,
    /// Every movable object as the target.
    pub survey: fn(&Scene, &Budget<'_>) -> Result<Vec<SurveyEntry>, PlanError>,
    /// Check a stated answer.
    pub check: fn(&Scene, &Claim, &Budget<'_>) -> Report,
}

impl Default for Engine {
    fn default() -> Self {
        Self { plan: plan::plan, survey: plan::survey, check: check::check }
    }
}

/// The service's state.
pub struct App {
    pub(super) settings: ServerSettings,
    pub(super) engine: Engine,
    pub(super) pool: Pool,
    large_bodies: Semaphore,
    draining: AtomicBool,
}

/// The body of a response.
pub(super) type Served = Result<Vec<u8>, Problem>;

impl App {
    /// Starts the planning threads.
    ///
    /// # Errors
    /// If the system gives no thread.
    pub fn new(settings: ServerSettings, engine: Engine) -> io::Result<Self> {
        let pool = Pool::new(settings.threads, settings.queue)?;
        let large_bodies = Semaphore::new(settings.threads.max(1));
        Ok(Self { settings, engine, pool, large_bodies, draining: AtomicBool::new(false) })
    }

    /// From now on the service says that it is not ready, though it still answers what reaches it.
    pub(super) fn drain(&self) {
        self.draining.store(true, Ordering::Relaxed);
    }

    /// True if new requests are welcome.
    pub(super) fn ready(&self) -> bool {
        !self.draining.load(Ordering::Relaxed) && self.pool.ready()
    }

    /// Read a body, a large one away from the threads that serve connections.
    pub(super) async fn parse<T: Send + 'static>(
        &self,
        body: Vec<u8>,
        read: fn(&[u8], &RequestLimits) -> Result<T, Problem>,
    ) -> Result<T, Problem> {
        let limits = self.settings.limits;
        if body.len() <= SMALL_BODY {
            return read(&body, &limits);
        }
        let Ok(permit) = timeout(READING_PATIENCE, self.large_bodies.acquire()).await else {
            return Err(refused(Refused::Full));
        };
        let result = spawn_blocking(move || read(&body, &limits)).await;
        drop(permit);
        result.unwrap_or_else(|_| Err(internal()))
    }

    /// Run `work` on the planning pool; where the time limit comes first, `too_late` says what is left to say. The limit
    /// counts from `arrival`.
    pub(super) async fn compute<R: AsRef<PlanRequest> + Send + Sync + 'static>(
        &self,
        arrival: Instant,
        request: Arc<R>,
        work: impl FnOnce(&R, &Budget<'_>) -> Served + Send + 'static,
        too_late: impl FnOnce(&R) -> Served + Send + 'static,
    ) -> Served {
        let time_limit = (*request).as_ref().time_limit;
        let own = Arc::clone(&request);
        let pending = self.pool.submit(arrival, time_limit, move |budget| work(&own, budget)).map_err(refused)?;
        match pending.outcome().await {
            Outcome::Done(served) => served,
            Outcome::TimedOut => spawn_blocking(move || too_late(&request)).await.unwrap_or_else(|_| Err(internal())),
            Outcome::Panicked => Err(internal()),
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
