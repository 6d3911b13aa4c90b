//! What the handlers share: the settings, the planning pool, and the way from a request to bytes that never stalls the
//! threads that serve connections.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use tokio::task::spawn_blocking;
use tracing::Span;

use super::edge;
use super::problem::{internal, refusal, refused};
use super::reading::{Known, Read, Reading};
use super::settings::ServerSettings;
use crate::budget::Budget;
use crate::metrics::{Metrics, Queue, Refusal};
use crate::traces::Context;
use crate::wire::{PlanRequest, Problem};
use crate::workers::{Engine, Outcome, Pool};

/// The service's state.
pub struct App {
    pub(super) settings: ServerSettings,
    pub(super) engine: Engine,
    pub(super) pool: Pool,
    pub(super) metrics: Arc<Metrics>,
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
        Ok(Self { settings, engine, pool, metrics: Arc::default(), draining: AtomicBool::new(false) })
    }

    /// From now on the service says that it is not ready, though it still answers what reaches it.
    pub(super) fn drain(&self) {
        self.draining.store(true, Ordering::Relaxed);
    }

    /// True if new requests are welcome.
    pub(super) fn ready(&self) -> bool {
        !self.draining.load(Ordering::Relaxed) && self.pool.ready()
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
        let reading = Arc::new(Reading::begin(body, read, self.settings.limits)?);
        edge::note_scene(reading.glance().scene_id.as_deref());
        let (own, metrics, span, context) =
            (Arc::clone(&reading), Arc::clone(&self.metrics), Span::current(), Context::current());
        let queued = Instant::now();
        let job = move |budget: &Budget<'_>| {
            metrics.waited(Queue::Plan, queued.elapsed());
            // What is logged and traced on the other thread is the request's too.
            let _context = context.attach();
            span.in_scope(|| work(own.request()?, budget))
        };
        let pending = self.pool.submit(arrival, reading.glance().time_limit, job).map_err(|error| {
            self.metrics.refused(refusal(error));
            refused(error)
        })?;
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
