//! What the handlers share: the settings, the planning pool, and the way from a request to bytes that never stalls the
//! threads that serve connections.

use std::io;
use std::sync::Arc;
use std::time::Instant;

use tokio::task::spawn_blocking;

use super::log;
use super::problem::{internal, not_ready, refused};
use super::reading::{Known, Read, Reading};
use super::settings::ServerSettings;
use crate::budget::Budget;
use crate::wire::{PlanRequest, Problem};
use crate::workers::{Draining, Engine, Outcome, Pool};

/// The service's state.
pub struct App {
    pub(super) settings: ServerSettings,
    pub(super) engine: Engine,
    pub(super) pool: Pool,
    pub(super) draining: Draining,
}

/// Who asks. Everybody, as long as there are no keys.
const OWNER: &str = "anonymous";

/// The body of a response.
pub(super) type Served = Result<Vec<u8>, Problem>;

impl App {
    /// Starts the planning threads.
    ///
    /// # Errors
    /// If the system gives no thread.
    pub fn new(settings: ServerSettings, engine: Engine) -> io::Result<Self> {
        let pool = Pool::new(settings.threads, settings.queue)?;
        Ok(Self { settings, engine, pool, draining: Draining::default() })
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
        !self.draining.begun() && self.pool.ready()
    }

    /// Nothing new begins while the service drains.
    ///
    /// # Errors
    /// A problem while it does.
    pub(super) fn takes_work(&self) -> Result<(), Problem> {
        if self.draining.begun() { Err(not_ready()) } else { Ok(()) }
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
        let reading = Arc::new(Reading::begin(body, read, self.settings.limits)?);
        log::note_scene(reading.glance().scene_id.as_deref());
        let own = Arc::clone(&reading);
        let job = move |budget: &Budget<'_>| work(own.request()?, budget);
        let pending = self.pool.submit(OWNER, arrival, reading.glance().time_limit, job).map_err(refused)?;
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
