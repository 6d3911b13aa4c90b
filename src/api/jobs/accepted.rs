//! What is answered where something was accepted that is not done yet.

use axum::Json;
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Serialize;

use crate::jobs::JobId;

/// When it is worth looking at a job, s; long-polls and event streams tell earlier.
const RETRY_AFTER: &str = "1";

/// 202 with where to look and when.
pub(super) fn accepted(id: Option<JobId>, body: impl Serialize) -> Response {
    let mut response = (StatusCode::ACCEPTED, [(header::RETRY_AFTER, RETRY_AFTER)], Json(body)).into_response();
    let location = id.and_then(|id| HeaderValue::try_from(format!("/v1/jobs/{id}")).ok());
    if let Some(location) = location {
        response.headers_mut().insert(header::LOCATION, location);
    }
    response
}
