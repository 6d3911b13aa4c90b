//! What the calls about jobs share.

use std::sync::Arc;

use tokio::sync::Semaphore;

use crate::api::body::Bodies;
use crate::api::running::Running;
use crate::api::settings::ServerSettings;
use crate::jobs::CallbackAllow;

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
}
