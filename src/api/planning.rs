//! The planning calls: `POST /v1/plans`, `/v1/plans/verify`, `/v1/survey`, `/v1/knowledge`.

use std::sync::Arc;
use std::time::Instant;

use axum::body::Body;
use axum::extract::State;
use axum::http::{Request, header};
use axum::response::{IntoResponse, Response};

use super::accept;
use super::access::Caller;
use super::body::Bodies;
use super::problem::RequestProblems;
use crate::computation::calls::{Knowledge, Plan, Survey, Verification};
use crate::computation::{Computation, Form, Planning};
use crate::wire::{AnswerBody, KnowledgeBody, Problem, SceneBody, SurveyBody, VerificationBody, VerifyBody};

/// The state of the planning calls.
pub(super) struct PlanningCalls {
    pub(super) planning: Arc<Planning>,
    pub(super) bodies: Arc<Bodies>,
}

impl PlanningCalls {
    /// Answer in the client's preferred form.
    async fn answer<C: Computation>(
        &self,
        caller: &Caller,
        request: Request<Body>,
        forms: &[Form],
        computation: impl FnOnce(Form) -> C,
    ) -> Result<Response, Problem> {
        let arrival = Instant::now();
        let form = accept::choose(request.headers(), forms)?;
        let body = self.bodies.receive(request).await?;
        let bytes = self.planning.answer(caller.owner.as_str(), arrival, body, computation(form)).await?;
        Ok(([(header::CONTENT_TYPE, form.media_type())], bytes).into_response())
    }
}

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
    State(calls): State<Arc<PlanningCalls>>,
    caller: Caller,
    request: Request<Body>,
) -> Result<Response, Problem> {
    calls.answer(&caller, request, &[Form::Json, Form::Svg], Plan).await
}

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
    State(calls): State<Arc<PlanningCalls>>,
    caller: Caller,
    request: Request<Body>,
) -> Result<Response, Problem> {
    calls.answer(&caller, request, &[Form::Json], |_| Verification).await
}

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
    State(calls): State<Arc<PlanningCalls>>,
    caller: Caller,
    request: Request<Body>,
) -> Result<Response, Problem> {
    calls.answer(&caller, request, &[Form::Json], |_| Survey).await
}

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
    State(calls): State<Arc<PlanningCalls>>,
    caller: Caller,
    request: Request<Body>,
) -> Result<Response, Problem> {
    calls.answer(&caller, request, &[Form::Json], |_| Knowledge).await
}
