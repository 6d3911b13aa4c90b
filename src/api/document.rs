//! `GET /openapi.json`: the interface document, made from the code.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use axum::http::header;
use axum::response::IntoResponse;
use utoipa::openapi::header::HeaderBuilder;
use utoipa::openapi::{ContentBuilder, ObjectBuilder, Ref, RefOr, Response, ResponseBuilder, Schema, Type};
use utoipa::{IntoResponses, OpenApi};

use super::problem::PROBLEM_JSON;
use super::router;
use crate::wire::{Problem, ProblemKind};

#[derive(OpenApi)]
#[openapi(
    info(
        title = "singulate",
        description = "Plans the fewest relocations that free an object on a crowded table, with proof.\n\n\
            Metres and radians everywhere; milliseconds only in fields that end in `_ms`. A verdict is an answer, not an \
            error. Every error is a problem document (RFC 9457) that lists all faults of the body at once, each with its \
            JSON pointer; an unknown path is a 404, a known path with another method a 405 with `Allow`. A client must refuse an `action` or a `verdict` that it doesn't know.",
        contact(),
        license(name = "MIT", identifier = "MIT")
    ),
    tags(
        (name = "planning", description = "Plans, their check, the survey of a table, and what is known before any search."),
        (name = "jobs", description = "Plans that wait for a worker, and for their caller to come back."),
        (name = "operation", description = "Probes, the build, this document."),
    ),
    components(schemas(Problem))
)]
struct Blank;

/// The document without its paths.
pub(super) fn blank() -> utoipa::openapi::OpenApi {
    let mut document = Blank::openapi();
    document.info.contact = None;
    document
}

/// The interface document.
pub fn openapi() -> utoipa::openapi::OpenApi {
    let mut document = router::routes().into_openapi();
    let schemas = document.components.iter_mut().flat_map(|components| components.schemas.values_mut());
    schemas.for_each(describe_nullable_fields);
    document
}

/// The derive describes only the reference in "reference or null"; the description belongs to the field.
fn describe_nullable_fields(schema: &mut RefOr<Schema>) {
    let RefOr::T(Schema::Object(object)) = schema else { return };
    for field in object.properties.values_mut() {
        let RefOr::T(Schema::OneOf(choice)) = field else { continue };
        let described = choice.items.iter_mut().find_map(|item| match item {
            RefOr::Ref(reference) if !reference.description.is_empty() => {
                Some(core::mem::take(&mut reference.description))
            }
            _ => None,
        });
        choice.description = choice.description.take().or(described);
    }
}

/// The interface document as it is committed and served.
pub fn openapi_json() -> String {
    let mut text = openapi().to_pretty_json().expect("the document is made of strings and numbers");
    text.push('\n');
    text
}

/// The problems of every request with a body.
pub(super) struct RequestProblems;

/// What is said of each problem, and its detail in the example. The schema's own example is the 422.
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

pub(super) fn problem(example: &Problem, description: &str) -> Response {
    let mut content = ContentBuilder::new().schema(Some(Ref::from_schema_name("Problem")));
    if example.kind() != ProblemKind::InvalidRequest {
        content = content.example(serde_json::to_value(example).ok());
    }
    let response = ResponseBuilder::new().description(description).content(PROBLEM_JSON, content.build());
    if !matches!(example.kind(), ProblemKind::Overloaded | ProblemKind::StoreUnavailable) {
        return response.build();
    }
    let seconds = ObjectBuilder::new().schema_type(Type::Integer).minimum(Some(0)).build();
    let retry_after = HeaderBuilder::new().schema(Some(seconds)).description(Some("When to come again, s.")).build();
    response.header("Retry-After", retry_after).build()
}

static SERVED: LazyLock<String> = LazyLock::new(openapi_json);

/// This document
///
/// The interface as OpenAPI 3.1; `/docs` shows it as a page.
#[utoipa::path(get, path = "/openapi.json", operation_id = "openapi", tag = "operation", responses(
    (status = 200, description = "The document.", body = Object, content_type = "application/json"),
))]
pub(super) async fn serve() -> impl IntoResponse {
    ([(header::CONTENT_TYPE, "application/json")], SERVED.as_str())
}
