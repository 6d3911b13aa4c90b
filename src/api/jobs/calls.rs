//! What the calls for jobs share: their state, and the answer to what was accepted.

use std::sync::Arc;

use axum::Json;
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Serialize;
use tokio::sync::Semaphore;

use crate::api::body::Bodies;
use crate::api::running::Running;
use crate::api::settings::ServerSettings;
use crate::jobs::{CallbackAllow, JobId};

/// Concurrent submissions. Their writes queue with those of the workers, a millisecond or two each: behind many more,
/// jobs would begin and end late.
const MAX_SUBMITTING: usize = 32;

/// When to poll a job, s; long polls and event streams report earlier.
const RETRY_AFTER: &str = "1";

/// The store, the workers, and the limits on concurrent requests.
pub(in crate::api) struct JobCalls {
    pub(super) running: Arc<Running>,
    pub(super) bodies: Arc<Bodies>,
    /// The allowed receivers of callbacks.
    pub(super) callback_allow: CallbackAllow,
    /// Permits for submissions.
    pub(super) submitting: Semaphore,
    /// Permits for long polls.
    pub(super) waiting: Semaphore,
    /// Permits for event streams.
    pub(super) streams: Arc<Semaphore>,
}

impl JobCalls {
    /// With all permits free.
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

/// 202 with `Location` and `Retry-After`.
pub(super) fn accepted(id: Option<JobId>, body: impl Serialize) -> Response {
    let mut response = (StatusCode::ACCEPTED, [(header::RETRY_AFTER, RETRY_AFTER)], Json(body)).into_response();
    let location = id.and_then(|id| HeaderValue::try_from(format!("/v1/jobs/{id}")).ok());
    if let Some(location) = location {
        response.headers_mut().insert(header::LOCATION, location);
    }
    response
}
