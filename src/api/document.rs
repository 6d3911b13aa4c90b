//! The interface document, made from the code.

use core::time::Duration;
use std::sync::LazyLock;

use utoipa::OpenApi;
use utoipa::openapi::header::HeaderBuilder;
use utoipa::openapi::path::{Operation, Parameter};
use utoipa::openapi::schema::SchemaType;
use utoipa::openapi::security::{HttpAuthScheme, HttpBuilder, SecurityRequirement, SecurityScheme};
use utoipa::openapi::{ObjectBuilder, PathItem, RefOr, Schema, Type};
use utoipa_axum::router::OpenApiRouter;

use super::access::{Need, NotAdmitted};
use super::examples;
use super::operations;
use super::problem::described;
use crate::keys::Scope;
use crate::wire::{Problem, ProblemKind};

#[derive(OpenApi)]
#[openapi(
    info(
        title = "singulate",
        description = "Plans the fewest relocations that free an object on a crowded table, with proof; takes objects away to \
            drop-offs, and clears a table.\n\n\
            Lengths are metres and angles are radians. Fields that end in `_ms` are milliseconds. A verdict is an answer, \
            not an error. Every error is a problem document (RFC 9457). It lists all faults of the body at once, each with \
            its JSON pointer. An unknown path is a 404, another method on a known path a 405 with `Allow`. A client must \
            refuse an `action` or a `verdict` that it doesn't know.",
        contact(),
        license(name = "MIT", identifier = "MIT")
    ),
    tags(
        (name = "planning", description = "Plans and their check, the survey of a table, and the shadows and options of its objects."),
        (name = "jobs", description = "Plans that are made in the background."),
        (name = "operation", description = "Probes, version, metrics and this document."),
    ),
    components(schemas(Problem))
)]
struct Blank;

/// The document without its paths.
fn blank() -> utoipa::openapi::OpenApi {
    let mut document = Blank::openapi();
    document.info.contact = None;
    document
}

/// The interface document.
fn openapi() -> utoipa::openapi::OpenApi {
    let blank = OpenApiRouter::with_openapi(blank());
    let routed = operations::operations().into_iter().fold(blank, |router, (need, (schemas, mut paths, route))| {
        paths.paths.values_mut().for_each(|item| {
            describe_need(need, item);
            describe_parameters(item);
        });
        router.routes((schemas, paths, route))
    });
    let mut document = routed.into_openapi();
    let components = document.components.get_or_insert_default();
    let bearer = HttpBuilder::new().scheme(HttpAuthScheme::Bearer).description(Some(BEARER)).build();
    components.add_security_scheme(SCHEME, SecurityScheme::Http(bearer));
    components.schemas.values_mut().for_each(describe_nullable_fields);
    examples::add(&mut document);
    document
}

/// The name and the description of the security scheme.
const SCHEME: &str = "bearer";
const BEARER: &str = "An API key from the operator. The scopes beside it name what the key must be for. A service that runs without keys asks for none, hence the empty alternative.";

/// Describe the access that an operation needs, and its problems.
fn describe_need(need: Need, item: &mut PathItem) {
    let (security, problems) = match need {
        Need::Nothing => return,
        Need::AnyKey => (vec![SecurityRequirement::new(SCHEME, [""; 0])], &KEY_PROBLEMS[..2]),
        Need::OneOf(scopes) => {
            let one = |scope: &Scope| SecurityRequirement::new(SCHEME, [scope.as_str()]);
            (scopes.iter().map(one).collect::<Vec<_>>(), &KEY_PROBLEMS[..])
        }
    };
    // One document for all services, with keys or without: clients generated from it can send a key in both cases.
    let security = [&[SecurityRequirement::default()], &security[..]].concat();
    for operation in operations(item) {
        operation.security = Some(security.clone());
        for (refused, description) in problems {
            let example = refused.problem();
            let mut response = described(&example, description);
            if example.kind() == ProblemKind::Unauthorized {
                let text = ObjectBuilder::new().schema_type(Type::String).build();
                let header =
                    HeaderBuilder::new().schema(Some(text)).description(Some("`Bearer` and the reason (RFC 6750)."));
                response.headers.insert("WWW-Authenticate".to_owned(), header.build().into());
            }
            operation.responses.responses.insert(example.status().to_string(), response.into());
        }
    }
}

/// The derive types an optional header as "text or null", but a header is never null.
fn describe_parameters(item: &mut PathItem) {
    for parameter in operations(item).filter_map(|operation| operation.parameters.as_mut()).flatten() {
        if let RefOr::T(Parameter { schema: Some(RefOr::T(Schema::Object(schema))), .. }) = parameter
            && let SchemaType::Array(types) = &schema.schema_type
            && let Some(stated) = types.iter().find(|stated| **stated != Type::Null)
        {
            schema.schema_type = SchemaType::Type(stated.clone());
        }
    }
}

fn operations(item: &mut PathItem) -> impl Iterator<Item = &mut Operation> {
    [&mut item.get, &mut item.post, &mut item.delete].into_iter().flatten()
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

/// The descriptions of key problems, those of any key first.
const KEY_PROBLEMS: [(NotAdmitted, &str); 3] = [
    (NotAdmitted::WrongKey, "The key is missing or not valid."),
    (NotAdmitted::Rate(Duration::ZERO), "The key was used more often than its rate allows."),
    (NotAdmitted::Scope(&[Scope::Plan]), "The key lacks the scope for this call."),
];

/// The same text, built once.
pub(super) fn served() -> &'static str {
    static SERVED: LazyLock<String> = LazyLock::new(openapi_json);
    &SERVED
}
