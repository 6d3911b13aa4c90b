//! `POST /v1/plans/verify`.

use std::sync::Arc;
use std::time::Instant;

use axum::body::Body;
use axum::extract::State;
use axum::http::{Request, header};
use axum::response::{IntoResponse, Response};

use super::accept::{self, Form};
use super::access::Caller;
use super::app::{App, json};
use super::body;
use super::document::RequestProblems;
use super::reading::Known;
use crate::wire::{Problem, VerificationBody, VerifyBody, VerifyRequest, read_verify};
use singulate_planner::budget::Budget;

/// Check a stated answer
///
/// The independent checker replays the plan on the scene and re-checks whatever is stated besides: locks, landmarks, the
/// bound.
#[utoipa::path(
    post,
    path = "/v1/plans/verify",
    operation_id = "verify",
    tag = "planning",
    request_body(content = VerifyBody, content_type = "application/json", description = "A scene and a stated answer."),
    responses(
        (status = 200, description = "Whether the answer holds, and all that does not.",
         body = VerificationBody, content_type = "application/json"),
        RequestProblems,
    )
)]
pub(super) async fn verify(
    State(app): State<Arc<App>>,
    caller: Caller,
    request: Request<Body>,
) -> Result<Response, Problem> {
    let arrival = Instant::now();
    let form = accept::choose(request.headers(), &[Form::Json])?;
    let body = body::receive(request, &app).await?;
    let engine = app.engine;
    let work = move |VerifyRequest { request, claim }: &VerifyRequest, budget: &Budget<'_>| {
        json(&VerificationBody::new(&(engine.check)(&request.scene, claim, budget)))
    };
    let too_late = |_: Known<'_, VerifyRequest>| json(&VerificationBody::timed_out());
    let bytes = app.answer(&caller.owner, arrival, (body, read_verify), work, too_late).await?;
    Ok(([(header::CONTENT_TYPE, form.media_type())], bytes).into_response())
}
