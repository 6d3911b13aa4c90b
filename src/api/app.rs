//! Builds the service from its parts.

use std::io;
use std::sync::Arc;

use super::access::Gate;
use super::body::Bodies;
use super::docs::DocumentText;
use super::document;
use super::jobs::JobCalls;
use super::operations::Parts;
use super::planning::PlanningCalls;
use super::running::Running;
use super::settings::ServerSettings;
use crate::computation::Engine;
use crate::metrics::Metrics;

/// The service's state.
pub struct App {
    pub(super) settings: ServerSettings,
    pub(super) gate: Arc<Gate>,
    pub(super) running: Arc<Running>,
    /// The state of the operations.
    pub(super) parts: Parts,
}

impl App {
    /// Read the keys, open the store of jobs and start the planning threads.
    ///
    /// # Errors
    /// If the keys are invalid, the store can't be opened, or a thread can't be started.
    pub async fn start(settings: ServerSettings, engine: Engine) -> io::Result<Self> {
        let metrics = Arc::<Metrics>::default();
        let gate = Gate::open(settings.api_keys_file.as_deref(), Arc::clone(&metrics)).map_err(io::Error::other)?;
        let bodies = Arc::new(Bodies::new(&settings, Arc::clone(&metrics)));
        let running = Arc::new(Running::start(&settings, engine, metrics).await?);
        let parts = Parts {
            planning: Arc::new(PlanningCalls { planning: Arc::clone(&running.planning), bodies: Arc::clone(&bodies) }),
            jobs: Arc::new(JobCalls::new(&settings, Arc::clone(&running), bodies)),
            running: Arc::clone(&running),
            document: DocumentText(document::served),
        };
        Ok(Self { settings, gate: Arc::new(gate), running, parts })
    }

    /// From now on the service reports that it is not ready, and refuses new work.
    pub(super) fn drain(&self) {
        tracing::info!(computations = self.running.planning.busy(), "draining");
        self.running.draining.begin();
    }

    /// The time for draining is nearly over: recall running computations.
    pub(super) fn finish_soon(&self) {
        tracing::warn!(
            computations = self.running.planning.busy(),
            "running computations must deliver their best answers now"
        );
        self.running.planning.finish_soon();
    }
}
