//! How jobs end. The stored answer or problem is written only here.

use super::job::{JobId, MAX_ATTEMPTS};
use crate::metrics::Ended;
use crate::wire::{AnswerBody, LoggedProblem, Problem, ProblemKind, RawJson};

/// The end of a running job. A job that was cancelled ends as cancelled, with the answer if there is one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum End {
    /// With this answer.
    Succeeded(RawJson),
    /// With this problem.
    Failed(RawJson),
}

impl End {
    /// The end of a job that has lost as many workers as allowed.
    pub(super) fn poisoned() -> Self {
        let detail =
            format!("{MAX_ATTEMPTS} workers have been lost while they planned this job; it is not begun again");
        Self::with(&Problem::new(ProblemKind::Poison, detail))
    }

    fn with(problem: &Problem) -> Self {
        Self::Failed(RawJson::write(problem).expect("a problem is made of strings and numbers"))
    }
}

/// How a worker's job ends, in full and for logs and metrics.
pub(super) struct Concluded {
    pub(super) end: End,
    pub(super) verdict: Option<&'static str>,
    pub(super) cause: Option<LoggedProblem>,
}

impl Concluded {
    /// A defect of the service keeps the job from an answer.
    pub(super) fn internal() -> Self {
        Problem::new(ProblemKind::Internal, "the job could not be planned").into()
    }
}

impl Concluded {
    /// With an answer of this verdict.
    pub(super) fn with(answer: &AnswerBody<'_>) -> Self {
        match RawJson::write(answer) {
            Ok(json) => Self { end: End::Succeeded(json), verdict: answer.verdict, cause: None },
            Err(error) => {
                tracing::error!(%error, "an answer could not be written");
                Self::internal()
            }
        }
    }
}

impl From<Problem> for Concluded {
    fn from(problem: Problem) -> Self {
        Self { end: End::with(&problem), verdict: None, cause: Some(problem.cause()) }
    }
}

/// Logs the end of a job that ended without a worker.
pub fn job_ended(job: JobId, state: Ended) {
    tracing::info!(%job, state = state.as_str(), "job ended");
}
