//! `POST /v1/survey`.

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
use super::problem::unread;
use super::reading::Known;
use crate::wire::{PlanRequest, Problem, SceneBody, SurveyBody, read_scene};
use singulate_planner::budget::Budget;

/// Every movable object as the target
///
/// Logic only: how many relocations each object would need, without places for them. The scene's own `target` must be
/// there, but has no part in the answer, nor has any setting but the time limit. `time_limit_ms` is for the whole call; what is undecided then is `timed_out`.
#[utoipa::path(
    post,
    path = "/v1/survey",
    operation_id = "survey",
    tag = "planning",
    request_body(content = SceneBody, content_type = "application/json", description = "The scene."),
    responses(
        (status = 200, description = "What holds for each movable object.",
         body = SurveyBody, content_type = "application/json"),
        RequestProblems,
    )
)]
pub(super) async fn survey(
    State(app): State<Arc<App>>,
    caller: Caller,
    request: Request<Body>,
) -> Result<Response, Problem> {
    let arrival = Instant::now();
    let form = accept::choose(request.headers(), &[Form::Json])?;
    let body = body::receive(request, &app).await?;
    let engine = app.engine;
    let work = move |request: &PlanRequest, budget: &Budget<'_>| {
        json(&SurveyBody::new(&request.scene, &engine.survey(request, budget)?))
    };
    let too_late = |known: Known<'_, PlanRequest>| match known {
        Known::Request(request) => json(&SurveyBody::timed_out(&request.scene)),
        Known::Glance(_) => Err(unread()),
    };
    let bytes = app.answer(&caller.owner, arrival, (body, read_scene), work, too_late).await?;
    Ok(([(header::CONTENT_TYPE, form.media_type())], bytes).into_response())
}
