//! Faults as responses: the one place that knows which inner error has which status.

use core::any::Any;

use axum::Json;
use axum::http::{HeaderName, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};

use crate::metrics::Refusal;
use crate::wire::{Problem, ProblemKind};
use crate::workers::Refused;

/// The media type of a problem document.
pub(super) const PROBLEM_JSON: &str = "application/problem+json";

/// When a client that was refused for want of room may come again, s.
const RETRY_AFTER: &str = "1";

impl IntoResponse for Problem {
    fn into_response(self) -> Response {
        let status = StatusCode::from_u16(self.status()).unwrap_or(StatusCode::INTERNAL_SERVER_ERROR);
        let extra: Option<(HeaderName, &'static str)> = match self.kind() {
            ProblemKind::Overloaded | ProblemKind::NotReady => Some((header::RETRY_AFTER, RETRY_AFTER)),
            // The rest of the body may still be on its way.
            ProblemKind::BodyTimeout | ProblemKind::BodyTooLarge => Some((header::CONNECTION, "close")),
            _ => None,
        };
        let mut response = (status, Json(self)).into_response();
        let headers = response.headers_mut();
        headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(PROBLEM_JSON));
        if let Some((name, value)) = extra {
            headers.insert(name, HeaderValue::from_static(value));
        }
        response
    }
}

/// No room for a job.
pub(super) fn refused(refused: Refused) -> Problem {
    let kind = match refused {
        Refused::Full => ProblemKind::Overloaded,
        Refused::Closed => ProblemKind::NotReady,
    };
    Problem::new(kind, refused.to_string())
}

/// The same as a measurement.
pub(super) fn refusal(refused: Refused) -> Refusal {
    match refused {
        Refused::Full => Refusal::Full,
        Refused::Closed => Refusal::NotReady,
    }
}

/// A body that could not be read within its time limit, and nothing can be said without it.
pub(super) fn unread() -> Problem {
    Problem::new(ProblemKind::Overloaded, "the body could not be read within its time limit")
}

/// A scene that was read, but whose answer did not get done within its time limit, and half of it is of no use.
pub(super) fn late() -> Problem {
    Problem::new(ProblemKind::Overloaded, "the answer was not done within the time limit")
}

/// A defect of the service.
pub(super) fn internal() -> Problem {
    Problem::new(ProblemKind::Internal, "the request could not be answered")
}

/// A panic in a handler.
#[expect(clippy::needless_pass_by_value, reason = "the signature that the layer calls")]
pub(super) fn panicked(panic: Box<dyn Any + Send + 'static>) -> Response {
    let words = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let words = words.or_else(|| panic.downcast_ref::<String>().cloned());
    tracing::error!(panic = words.as_deref().unwrap_or("without words"), "a handler panicked");
    internal().into_response()
}

/// No such path.
pub(super) async fn not_found() -> Problem {
    Problem::new(ProblemKind::NotFound, "see /openapi.json for what lives here")
}

/// No such method; the router adds `Allow`.
pub(super) async fn method_not_allowed() -> Problem {
    Problem::new(ProblemKind::MethodNotAllowed, "see the header Allow")
}
