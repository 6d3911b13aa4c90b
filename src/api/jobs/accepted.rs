//! The 202 answer for accepted jobs.

use axum::Json;
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Serialize;

use crate::jobs::JobId;

/// When to poll a job, s; long polls and event streams report earlier.
const RETRY_AFTER: &str = "1";

/// 202 with `Location` and `Retry-After`.
pub(super) fn accepted(id: Option<JobId>, body: impl Serialize) -> Response {
    let mut response = (StatusCode::ACCEPTED, [(header::RETRY_AFTER, RETRY_AFTER)], Json(body)).into_response();
    let location = id.and_then(|id| HeaderValue::try_from(format!("/v1/jobs/{id}")).ok());
    if let Some(location) = location {
        response.headers_mut().insert(header::LOCATION, location);
    }
    response
}
