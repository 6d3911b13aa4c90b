//! Refusals and failures of computations, as problems and as metrics.

use crate::metrics::Refusal;
use crate::wire::{Problem, ProblemKind};
use crate::workers::Refused;

/// The pool has no room for a computation.
impl From<Refused> for Problem {
    fn from(refused: Refused) -> Self {
        let overloaded = Self::new(ProblemKind::Overloaded, refused.to_string());
        match refused {
            Refused::Full => overloaded,
            Refused::TooLate { retry_after } => overloaded.with_retry_after(retry_after),
            Refused::Closed => not_ready(),
        }
    }
}

/// The same as a metric.
impl From<Refused> for Refusal {
    fn from(refused: Refused) -> Self {
        match refused {
            Refused::Full => Self::Full,
            Refused::TooLate { .. } => Self::TooLate,
            Refused::Closed => Self::NotReady,
        }
    }
}

/// The service shuts down.
pub(super) fn not_ready() -> Problem {
    Problem::new(ProblemKind::NotReady, "the service shuts down and begins nothing new")
}

/// The body was not read within its time limit, so there is nothing to answer.
pub(super) fn unread() -> Problem {
    Problem::new(ProblemKind::Overloaded, "the body could not be read within its time limit")
}

/// The scene was read, but its answer was not done within the time limit, and a part of it is of no use.
pub(super) fn late() -> Problem {
    Problem::new(ProblemKind::Overloaded, "the answer was not done within the time limit")
}

/// A defect of the service.
pub fn internal() -> Problem {
    Problem::new(ProblemKind::Internal, "the request could not be answered")
}
