//! Problems as responses, with their headers and `Retry-After`, and as the interface document describes them.

use core::any::Any;
use core::time::Duration;
use std::collections::BTreeMap;

use axum::Json;
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use utoipa::IntoResponses;
use utoipa::openapi::header::HeaderBuilder;
use utoipa::openapi::{self, ContentBuilder, ObjectBuilder, Ref, RefOr, ResponseBuilder, Type};

use crate::computation::internal;
use crate::wire::{Problem, ProblemKind};

/// The media type of a problem document.
pub(super) const PROBLEM_JSON: &str = "application/problem+json";

/// The challenge to a caller without a key (RFC 6750, section 3).
pub(super) const CHALLENGE: &str = "Bearer realm=\"singulate\"";

/// The default `Retry-After` of a refusal.
const RETRY_AFTER: Duration = Duration::from_secs(1);

/// The longest `Retry-After` from a forecast: by then the whole queue has timed out, since no time limit is longer by
/// default.
const MAX_RETRY_AFTER: Duration = Duration::from_secs(60);

impl IntoResponse for Problem {
    fn into_response(self) -> Response {
        let status = StatusCode::from_u16(self.status()).unwrap_or(StatusCode::INTERNAL_SERVER_ERROR);
        let kind = self.kind();
        let cause = self.cause();
        let retry_after = comes_again(kind).then(|| seconds(&self));
        let close = match kind {
            // The rest of the body may still be in transit.
            ProblemKind::BodyTimeout | ProblemKind::BodyTooLarge => true,
            // A new connection may reach another process.
            ProblemKind::NotReady => true,
            _ => false,
        };
        let mut response = (status, Json(self)).into_response();
        // For the log.
        response.extensions_mut().insert(cause);
        let headers = response.headers_mut();
        headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(PROBLEM_JSON));
        if kind == ProblemKind::Unauthorized {
            headers.insert(header::WWW_AUTHENTICATE, HeaderValue::from_static(CHALLENGE));
        }
        if let Some(seconds) = retry_after {
            headers.insert(header::RETRY_AFTER, HeaderValue::from(seconds));
        }
        if close {
            headers.insert(header::CONNECTION, HeaderValue::from_static("close"));
        }
        response
    }
}

/// True if the same request may succeed later.
fn comes_again(kind: ProblemKind) -> bool {
    use ProblemKind::{NotReady, Overloaded, RateExceeded, StoreUnavailable};
    matches!(kind, Overloaded | NotReady | StoreUnavailable | RateExceeded)
}

/// `Retry-After` in whole seconds, rounded up.
fn seconds(problem: &Problem) -> u64 {
    let after = problem.retry_after().unwrap_or(RETRY_AFTER).max(RETRY_AFTER);
    // The time from a key's rate is exact, not a forecast.
    let after = if problem.kind() == ProblemKind::RateExceeded { after } else { after.min(MAX_RETRY_AFTER) };
    after.as_secs() + u64::from(after.subsec_nanos() > 0)
}

/// A panic in a handler.
#[expect(clippy::needless_pass_by_value, reason = "the signature that the layer calls")]
pub(super) fn panicked(panic: Box<dyn Any + Send + 'static>) -> Response {
    let words = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let words = words.or_else(|| panic.downcast_ref::<String>().cloned());
    tracing::error!(panic = words.as_deref().unwrap_or("without words"), "a handler panicked");
    internal().into_response()
}

/// Unknown path.
pub(super) async fn not_found() -> Problem {
    Problem::new(ProblemKind::NotFound, "/openapi.json lists the paths")
}

/// Wrong method; the router adds `Allow`.
pub(super) async fn method_not_allowed() -> Problem {
    Problem::new(ProblemKind::MethodNotAllowed, "see the header Allow")
}

/// The problems of every request with a body.
pub(super) struct RequestProblems;

/// Each problem's description and example detail. The schema's own example is the 422.
const REQUEST_PROBLEMS: [(ProblemKind, &str, &str); 8] = [
    (ProblemKind::MalformedJson, "The body is not JSON, or incomplete.", "the body is empty"),
    (ProblemKind::NotAcceptable, "`Accept` admits none of the available formats.", "served here: application/json"),
    (ProblemKind::BodyTimeout, "The body came too slowly.", "the body was not complete after 5 s"),
    (
        ProblemKind::BodyTooLarge,
        "The body is larger than the limit, 4,000,000 bytes by default.",
        "a body has at most 4000000 bytes",
    ),
    (
        ProblemKind::UnsupportedMediaType,
        "The body is not declared as JSON in UTF-8.",
        "there is no Content-Type; send application/json",
    ),
    (ProblemKind::InvalidRequest, "The request is invalid: every fault with its JSON pointer.", ""),
    (
        ProblemKind::CheckFailed,
        "A bug of the service. An answer that fails its check is not served.",
        "the answer is withheld; the scene is in the log",
    ),
    (
        ProblemKind::Overloaded,
        "The service shuts down, or every thread is busy and none is expected to be free within the time limit, or the queue is full.",
        "every thread is busy and the queue is full",
    ),
];

impl IntoResponses for RequestProblems {
    fn responses() -> BTreeMap<String, RefOr<openapi::Response>> {
        let one = |&(kind, description, detail): &(ProblemKind, &str, &str)| {
            let example = Problem::new(kind, detail);
            (example.status().to_string(), described(&example, description).into())
        };
        REQUEST_PROBLEMS.iter().map(one).collect()
    }
}

/// A problem as the document describes it, with an example.
pub(super) fn described(example: &Problem, description: &str) -> openapi::Response {
    let mut content = ContentBuilder::new().schema(Some(Ref::from_schema_name("Problem")));
    if example.kind() != ProblemKind::InvalidRequest {
        content = content.example(serde_json::to_value(example).ok());
    }
    let response = ResponseBuilder::new().description(description).content(PROBLEM_JSON, content.build());
    if !comes_again(example.kind()) {
        return response.build();
    }
    let seconds = ObjectBuilder::new().schema_type(Type::Integer).minimum(Some(0)).build();
    let retry_after =
        HeaderBuilder::new().schema(Some(seconds)).description(Some("Seconds to wait before the next try.")).build();
    response.header("Retry-After", retry_after).build()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::workers::Refused;

    #[test]
    fn retry_after_is_whole_seconds_from_1_to_60() {
        let seconds = |millis| seconds(&Refused::TooLate { retry_after: Duration::from_millis(millis) }.into());
        assert_eq!([0, 10, 1000, 1001, 59_001, 1_000_000].map(seconds), [1, 1, 1, 2, 60, 60]);
        assert_eq!(super::seconds(&Refused::Full.into()), 1);
        let exact = Problem::new(ProblemKind::RateExceeded, "").with_retry_after(Duration::from_millis(999_001));
        assert_eq!(super::seconds(&exact), 1000);
    }
}
