//! How jobs end: the answer or the problem that is kept of one, which is written here, once, and nowhere else.

use super::job::{JobId, MAX_ATTEMPTS};
use crate::metrics::Ended;
use crate::wire::{AnswerBody, Cause, Problem, ProblemKind, RawJson, VerdictWord};

/// How a running job ends. A job whose caller cancelled it ends as cancelled, with the answer if there is one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum End {
    /// With this answer.
    Succeeded(RawJson),
    /// With this problem.
    Failed(RawJson),
}

impl End {
    /// The end of a job that has ended as many workers as it may.
    pub(super) fn poisoned() -> Self {
        let detail =
            format!("{MAX_ATTEMPTS} workers began this job and were not heard of again; it is not begun once more");
        Self::with(&Problem::new(ProblemKind::Poison, detail))
    }

    fn with(problem: &Problem) -> Self {
        Self::Failed(RawJson::write(problem).expect("a problem is made of strings and numbers"))
    }
}

/// How a worker's job ends, and the same in short.
pub(super) struct Concluded {
    pub(super) end: End,
    pub(super) verdict: Option<VerdictWord>,
    pub(super) cause: Option<Cause>,
}

impl Concluded {
    /// A defect of ours keeps the job from an answer.
    pub(super) fn internal() -> Self {
        Problem::new(ProblemKind::Internal, "the job could not be planned").into()
    }
}

impl From<&AnswerBody> for Concluded {
    fn from(answer: &AnswerBody) -> Self {
        match RawJson::write(answer) {
            Ok(json) => Self { end: End::Succeeded(json), verdict: Some(answer.verdict), cause: None },
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

/// A job has ended without a worker.
pub fn job_ended(job: JobId, state: Ended) {
    tracing::info!(%job, state = state.as_str(), "job ended");
}
