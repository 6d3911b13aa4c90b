//! `GET /openapi.json`, `/docs/`: the interface document, as JSON and as a page. All files are in the binary.

use std::sync::{Arc, LazyLock};

use axum::extract::rejection::PathRejection;
use axum::extract::{Path, State};
use axum::http::header;
use axum::response::{IntoResponse, Redirect, Response};
use utoipa_swagger_ui::Config;

use super::problem::not_found;
use crate::computation::internal;
use crate::wire::{AnyObject, Problem};

// The page's validator is a service on the internet, so it is off.
static CONFIG: LazyLock<Arc<Config<'static>>> =
    LazyLock::new(|| Arc::new(Config::from("../openapi.json").validator_url("none").use_base_layout()));

/// Gives the text of the interface document. The document names every operation, also the one that serves it; that
/// operation gets the text this way, since it must not name the document in turn.
#[derive(Clone, Copy)]
pub(super) struct DocumentText(pub(super) fn() -> &'static str);

/// This document
///
/// The interface as OpenAPI 3.1. `/docs` shows it as a page.
#[utoipa::path(get, path = "/openapi.json", operation_id = "openapi", tag = "operation", responses(
    (status = 200, description = "The document.", body = AnyObject, content_type = "application/json"),
))]
pub(super) async fn document(State(DocumentText(text)): State<DocumentText>) -> impl IntoResponse {
    ([(header::CONTENT_TYPE, "application/json")], text())
}

/// Redirects until `/` has a page of its own.
pub(super) async fn from_root() -> Redirect {
    Redirect::temporary("/docs/")
}

/// The page's files are relative to the folder.
pub(super) async fn to_folder() -> Redirect {
    Redirect::permanent("/docs/")
}

pub(super) async fn page() -> Result<Response, Problem> {
    send("").await
}

pub(super) async fn file(name: Result<Path<String>, PathRejection>) -> Result<Response, Problem> {
    match name {
        Ok(Path(name)) => send(&name).await,
        // No file has a name that is not UTF-8.
        Err(_) => Err(not_found().await),
    }
}

async fn send(name: &str) -> Result<Response, Problem> {
    let Some(file) = utoipa_swagger_ui::serve(name, Arc::clone(&CONFIG)).map_err(|_| internal())? else {
        return Err(not_found().await);
    };
    let encoding = file.gzpipped.then_some([(header::CONTENT_ENCODING, "gzip")]);
    Ok(([(header::CONTENT_TYPE, file.content_type)], encoding, file.bytes.into_owned()).into_response())
}
