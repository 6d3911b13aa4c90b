//! The possible problems of a request, for the interface document.

use std::collections::BTreeMap;

use utoipa::IntoResponses;
use utoipa::openapi::header::HeaderBuilder;
use utoipa::openapi::{ContentBuilder, ObjectBuilder, Ref, RefOr, Response, ResponseBuilder, Type};

use super::problem::{PROBLEM_JSON, comes_again};
use crate::wire::{Problem, ProblemKind};

/// The problems of every request with a body.
pub(super) struct RequestProblems;

/// Each problem's description and example detail. The schema's own example is the 422.
const REQUEST_PROBLEMS: [(ProblemKind, &str, &str); 8] = [
    (ProblemKind::MalformedJson, "The body is not JSON, or incomplete.", "the body is empty"),
    (ProblemKind::NotAcceptable, "No representation that `Accept` admits.", "served here: application/json"),
    (ProblemKind::BodyTimeout, "The body came too slowly.", "the body was not complete after 5 s"),
    (
        ProblemKind::BodyTooLarge,
        "The body is larger than the limit, 4,000,000 bytes by default.",
        "a body has at most 4000000 bytes",
    ),
    (
        ProblemKind::UnsupportedMediaType,
        "The body is not declared to be JSON in UTF-8.",
        "there is no Content-Type; send application/json",
    ),
    (ProblemKind::InvalidRequest, "The request is invalid: every fault with its JSON pointer.", ""),
    (
        ProblemKind::CheckFailed,
        "A defect of the service; an answer that failed its own check is withheld.",
        "the answer is withheld; the scene is in the log",
    ),
    (
        ProblemKind::Overloaded,
        "Every thread is busy, and the queue is full or no thread is likely to be free within the time limit; or the service shuts down.",
        "every thread is busy and the queue is full",
    ),
];

impl IntoResponses for RequestProblems {
    fn responses() -> BTreeMap<String, RefOr<Response>> {
        let response = |&(kind, description, detail): &(ProblemKind, &str, &str)| {
            let example = Problem::new(kind, detail);
            (example.status().to_string(), problem(&example, description).into())
        };
        REQUEST_PROBLEMS.iter().map(response).collect()
    }
}

/// A problem's description with an example.
pub(super) fn problem(example: &Problem, description: &str) -> Response {
    let mut content = ContentBuilder::new().schema(Some(Ref::from_schema_name("Problem")));
    if example.kind() != ProblemKind::InvalidRequest {
        content = content.example(serde_json::to_value(example).ok());
    }
    let response = ResponseBuilder::new().description(description).content(PROBLEM_JSON, content.build());
    if !comes_again(example.kind()) {
        return response.build();
    }
    let seconds = ObjectBuilder::new().schema_type(Type::Integer).minimum(Some(0)).build();
    let retry_after = HeaderBuilder::new().schema(Some(seconds)).description(Some("When to come again, s.")).build();
    response.header("Retry-After", retry_after).build()
}
