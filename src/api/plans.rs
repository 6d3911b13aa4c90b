//! `POST /v1/plans`.

use std::sync::Arc;
use std::time::Instant;

use axum::body::Body;
use axum::extract::State;
use axum::http::{Request, header};
use axum::response::{IntoResponse, Response};

use super::accept::{self, Form};
use super::access::Caller;
use super::app::{App, Served, json};
use super::body;
use super::document::RequestProblems;
use super::problem::unread;
use super::reading::Known;
use crate::render;
use crate::wire::{AnswerBody, PlanRequest, Problem, SceneBody, read_scene};
use singulate_planner::budget::Budget;
use singulate_planner::plan::{Answer, Statistics, Unplanned, Verdict};

/// Plan now
///
/// Which objects to move, in which order, to where, so that the gripper can grasp the target; or the proof that nothing
/// can free it. Every verdict is a 200. Time spent waiting counts towards `time_limit_ms`;
/// a scene too large to be read within it is `timed_out` unread, even if it is faulty.
#[utoipa::path(
    post,
    path = "/v1/plans",
    operation_id = "plan",
    tag = "planning",
    request_body(content = SceneBody, content_type = "application/json", description = "The scene and how to plan."),
    responses(
        (status = 200, description = "The verdict with its plan and proof; as a drawing where `Accept` prefers one.",
         content((AnswerBody = "application/json"), (String = "image/svg+xml"))),
        RequestProblems,
    )
)]
pub(super) async fn plan(
    State(app): State<Arc<App>>,
    caller: Caller,
    request: Request<Body>,
) -> Result<Response, Problem> {
    let arrival = Instant::now();
    let form = accept::choose(request.headers(), &[Form::Json, Form::Svg])?;
    let body = body::receive(request, &app).await?;
    let (engine, metrics) = (app.engine, Arc::clone(&app.metrics));
    let work = move |request: &PlanRequest, budget: &Budget<'_>| {
        let answer = engine.answer(request, budget)?;
        metrics.planned(&answer);
        write(form, request, &answer)
    };
    let too_late = move |known: Known<'_, PlanRequest>| match (known, form) {
        (Known::Request(request), _) => {
            let verdict = Verdict::TimedOut(Unplanned::default());
            write(form, request, &Answer { verdict, warnings: Vec::new(), statistics: Statistics::default() })
        }
        (Known::Glance(glance), Form::Json) => {
            AnswerBody::unread(glance).map_or_else(|| Err(unread()), |body| json(&body))
        }
        (Known::Glance(_), Form::Svg) => Err(unread()),
    };
    let bytes = app.answer(&caller.owner, arrival, (body, read_scene), work, too_late).await?;
    Ok(([(header::CONTENT_TYPE, form.media_type())], bytes).into_response())
}

fn write(form: Form, request: &PlanRequest, answer: &Answer) -> Served {
    match form {
        Form::Json => json(&AnswerBody::new(request, answer)),
        Form::Svg => Ok(render::svg(&request.scene, answer).into_bytes()),
    }
}
