//! The running parts of the service, independent of requests.

use std::io;
use std::sync::Arc;

use super::settings::ServerSettings;
use crate::computation::{Engine, Planning, Tools};
use crate::jobs::{self, Runner, Store};
use crate::metrics::Metrics;
use crate::workers::Draining;

/// The planning threads, the store of jobs and its workers, the metrics, and the shutdown signal.
pub(super) struct Running {
    pub(super) planning: Arc<Planning>,
    pub(super) store: Arc<dyn Store>,
    pub(super) runner: Arc<Runner>,
    pub(super) metrics: Arc<Metrics>,
    pub(super) draining: Draining,
}

impl Running {
    /// Open the store of jobs and start the threads.
    ///
    /// # Errors
    /// If the store can't be opened, or a thread can't be started.
    pub(super) async fn start(settings: &ServerSettings, engine: Engine, metrics: Arc<Metrics>) -> io::Result<Self> {
        let draining = Draining::default();
        let store = jobs::open(&settings.jobs, Arc::clone(&metrics)).await.map_err(io::Error::other)?;
        let tools = Tools { engine, metrics: Arc::clone(&metrics) };
        let threads = (settings.threads, settings.queue);
        let planning = Planning::start(threads, tools, settings.limits, draining.clone())?;
        let runner = Runner::new(Arc::clone(&store), Arc::clone(&metrics), &settings.jobs, engine, settings.limits)?;
        Ok(Self { planning: Arc::new(planning), store, runner: Arc::new(runner), metrics, draining })
    }

    /// True if new requests are accepted.
    pub(super) fn ready(&self) -> bool {
        !self.draining.begun() && self.planning.ready() && self.runner.ready()
    }
}
