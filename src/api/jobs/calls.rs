//! What the calls about jobs share.

use std::sync::Arc;

use tokio::sync::Semaphore;

use crate::api::body::Bodies;
use crate::api::running::Running;
use crate::api::settings::ServerSettings;
use crate::jobs::{CallbackAllow, Job, JobId, Owner, StoreError, SubmitError};
use crate::metrics::Refusal;
use crate::wire::{Problem, ProblemKind};

use super::problems::no_such_job;

/// Requests that may hand in jobs at a time. Their writes stand in one line with those of the workers, a millisecond or two
/// each: behind many more of them jobs would begin and end late.
const MAX_SUBMITTING: usize = 32;

/// The store, the workers, and how many requests at a time may do what.
pub(in crate::api) struct JobCalls {
    pub(super) running: Arc<Running>,
    pub(super) bodies: Arc<Bodies>,
    /// Who may be told of a job's end.
    pub(super) callback_allow: CallbackAllow,
    /// Room for requests that hand in jobs.
    pub(super) submitting: Semaphore,
    /// Room for clients that wait for a job.
    pub(super) waiting: Semaphore,
    /// Room for streams of events.
    pub(super) streams: Arc<Semaphore>,
}

impl JobCalls {
    /// Nobody waits yet.
    pub(in crate::api) fn new(settings: &ServerSettings, running: Arc<Running>, bodies: Arc<Bodies>) -> Self {
        Self {
            running,
            bodies,
            callback_allow: settings.jobs.callback_allow.clone(),
            submitting: Semaphore::new(MAX_SUBMITTING),
            waiting: Semaphore::new(settings.max_waiting),
            streams: Arc::new(Semaphore::new(settings.max_streams)),
        }
    }

    /// A job of the owner's.
    ///
    /// # Errors
    /// A problem if there is none, or the store failed.
    pub(super) async fn find(&self, owner: &Owner, id: JobId) -> Result<Job, Problem> {
        let found = self.running.store.get(owner, id).await;
        found.map_err(|error| self.unavailable(&error))?.ok_or_else(no_such_job)
    }

    /// As many as may do this already do it.
    pub(super) fn too_many(&self, detail: &str) -> Problem {
        self.running.metrics.refused(Refusal::Limit);
        Problem::new(ProblemKind::Overloaded, detail)
    }

    /// The store failed.
    pub(super) fn unavailable(&self, error: &StoreError) -> Problem {
        self.running.metrics.refused(Refusal::StoreUnavailable);
        tracing::warn!(%error, "a request was not answered");
        Problem::new(ProblemKind::StoreUnavailable, "what was asked for may have happened; ask again")
    }

    /// Jobs were not accepted.
    pub(super) fn not_accepted(&self, error: SubmitError) -> Problem {
        match error {
            SubmitError::Full => {
                self.running.metrics.refused(Refusal::Full);
                Problem::new(ProblemKind::Overloaded, "as many jobs wait as may")
            }
            SubmitError::KeyReused => Problem::new(ProblemKind::KeyReused, "this key came with another body before"),
            SubmitError::Store(error) => self.unavailable(&error),
        }
    }
}
