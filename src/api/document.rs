//! `GET /openapi.json`: the interface document, made from the code.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use axum::http::header;
use axum::response::IntoResponse;
use utoipa::openapi::header::HeaderBuilder;
use utoipa::openapi::{ContentBuilder, ObjectBuilder, Ref, RefOr, Response, ResponseBuilder, Type};
use utoipa::{IntoResponses, OpenApi};

use super::problem::PROBLEM_JSON;
use super::router;
use crate::wire::Problem;

#[derive(OpenApi)]
#[openapi(
    info(
        title = "singulate",
        description = "Plans the fewest relocations that free an object on a crowded table, with proof.\n\n\
            Metres and radians everywhere; milliseconds only in fields that end in `_ms`. A verdict is an answer, not an \
            error. Every error is a problem document (RFC 9457) that lists all faults of the body at once, each with its \
            JSON pointer. A client must refuse an `action` or a `verdict` that it doesn't know.",
        contact(),
        license(name = "MIT", identifier = "MIT")
    ),
    tags(
        (name = "planning", description = "Plans, their check, and the survey of a table."),
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
    router::routes().into_openapi()
}

/// The interface document as it is committed and served.
pub fn openapi_json() -> String {
    let mut text = openapi().to_pretty_json().expect("the document is made of strings and numbers");
    text.push('\n');
    text
}

/// The problems of every request with a body.
pub(super) struct RequestProblems;

const REQUEST_PROBLEMS: [(u16, &str); 8] = [
    (400, "The body is not JSON, or incomplete."),
    (406, "No representation that `Accept` admits."),
    (408, "The body came too slowly."),
    (413, "The body is larger than the limit, 4,000,000 bytes by default."),
    (415, "The body is not declared to be JSON in UTF-8."),
    (422, "The request is invalid: every fault with its JSON pointer."),
    (500, "A defect of the service; an answer that failed its own check is withheld."),
    (503, "Every thread is busy and the queue is full, or the service shuts down."),
];

impl IntoResponses for RequestProblems {
    fn responses() -> BTreeMap<String, RefOr<Response>> {
        REQUEST_PROBLEMS.iter().map(|(status, text)| (status.to_string(), problem(*status, text).into())).collect()
    }
}

fn problem(status: u16, description: &str) -> Response {
    let content = ContentBuilder::new().schema(Some(Ref::from_schema_name("Problem"))).build();
    let response = ResponseBuilder::new().description(description).content(PROBLEM_JSON, content);
    if status != 503 {
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
