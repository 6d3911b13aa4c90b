//! The problems of job calls.

use std::collections::BTreeMap;

use axum::extract::Path;
use axum::extract::rejection::PathRejection;
use utoipa::IntoResponses;
use utoipa::openapi::{RefOr, Response};

use super::calls::JobCalls;
use crate::api::problem::described;
use crate::jobs::{JobId, StoreError, SubmitError};
use crate::metrics::Refusal;
use crate::wire::{Problem, ProblemKind};

impl JobCalls {
    /// The limit on concurrent requests is reached.
    pub(super) fn too_many(&self, detail: &str) -> Problem {
        self.running.metrics.refused(Refusal::Limit);
        Problem::new(ProblemKind::Overloaded, detail)
    }

    /// The store failed.
    pub(super) fn unavailable(&self, error: &StoreError) -> Problem {
        self.running.metrics.refused(Refusal::StoreUnavailable);
        tracing::warn!(%error, "a request was not answered");
        unanswered()
    }

    /// The submission failed.
    pub(super) fn not_accepted(&self, error: SubmitError) -> Problem {
        match error {
            SubmitError::Full => {
                self.running.metrics.refused(Refusal::Full);
                Problem::new(ProblemKind::Overloaded, "the queue of jobs is full")
            }
            SubmitError::KeyReused => Problem::new(ProblemKind::KeyReused, "this key came with another body before"),
            SubmitError::Store(error) => self.unavailable(&error),
        }
    }
}

/// The store did not answer.
fn unanswered() -> Problem {
    Problem::new(ProblemKind::StoreUnavailable, "the call may have taken effect all the same; repeat it")
}

/// There is no such job.
pub(super) fn no_such_job() -> Problem {
    let detail = "there is no job with this id, or it is no longer kept";
    Problem::new(ProblemKind::NotFound, detail).with_title("There is no such job")
}

/// A job id in a path.
///
/// # Errors
/// `no_such_job` if it is not an id.
pub(super) fn job_id(name: Result<Path<String>, PathRejection>) -> Result<JobId, Problem> {
    // A path that is not UTF-8 is not an id either.
    let Ok(Path(text)) = name else { return Err(no_such_job()) };
    text.parse().map_err(|_| no_such_job())
}

/// The problems of all job calls.
pub(super) struct JobProblems;

impl IntoResponses for JobProblems {
    fn responses() -> BTreeMap<String, RefOr<Response>> {
        let unavailable = described(&unanswered(), "The store of jobs can't be reached, or too many clients wait.");
        let invalid = described(&Problem::invalid(Vec::new()), "A parameter is unknown or out of range.");
        BTreeMap::from([("503".to_owned(), unavailable.into()), ("422".to_owned(), invalid.into())])
    }
}

/// The problems of calls for one job.
pub(super) struct OneJobProblems;

impl IntoResponses for OneJobProblems {
    fn responses() -> BTreeMap<String, RefOr<Response>> {
        let mut responses = JobProblems::responses();
        responses.insert("404".to_owned(), described(&no_such_job(), "There is no such job.").into());
        responses
    }
}
