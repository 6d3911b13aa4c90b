//! `POST /v1/knowledge`.

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
use super::problem::{late, unread};
use super::reading::Known;
use crate::wire::{KnowledgeBody, PlanRequest, Problem, SceneBody, read_scene};
use singulate_planner::budget::Budget;
use singulate_planner::knowledge::NoBase;
use singulate_planner::plan::known;

/// Shadows and options of every object
///
/// What is known before any search, by the scene's `grasp_model`: which obstacle blocks which yaws, and which sets of
/// obstacles would have to go. With `sector` the paper's polar histogram too. The scene's `target`, `search`, `placement`
/// and `objective` have no part in it. What is not done within `time_limit_ms` is a 503.
#[utoipa::path(
    post,
    path = "/v1/knowledge",
    operation_id = "knowledge",
    tag = "planning",
    request_body(content = SceneBody, content_type = "application/json", description = "The scene."),
    responses(
        (status = 200, description = "What is known of each object.",
         body = KnowledgeBody, content_type = "application/json"),
        RequestProblems,
    )
)]
pub(super) async fn knowledge(
    State(app): State<Arc<App>>,
    caller: Caller,
    request: Request<Body>,
) -> Result<Response, Problem> {
    let arrival = Instant::now();
    let form = accept::choose(request.headers(), &[Form::Json])?;
    let body = body::receive(request, &app).await?;
    let work = move |request: &PlanRequest, budget: &Budget<'_>| {
        let known = known(&request.scene, request.settings.grasp_model, budget);
        let known = known.map_err(|error| match error {
            NoBase::Interrupted => late(),
            NoBase::TooLarge => Problem::too_dense(error.to_string()),
        })?;
        json(&KnowledgeBody::new(&request.scene, &known))
    };
    let too_late = |known: Known<'_, PlanRequest>| match known {
        Known::Request(_) => Err(late()),
        Known::Glance(_) => Err(unread()),
    };
    let bytes = app.answer(&caller.owner, arrival, (body, read_scene), work, too_late).await?;
    Ok(([(header::CONTENT_TYPE, form.media_type())], bytes).into_response())
}
