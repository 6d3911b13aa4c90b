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
/// Says which objects to move, in which order and to where, so that the gripper can grasp the target. Or proves that no
/// sequence of steps frees it. With a `goal` it frees the cheapest of several, takes several away to drop-offs, or clears
/// the table. Every verdict is a 200. Time spent waiting counts towards `time_limit_ms`. A scene that is too large to be
/// read within it gets `timed_out`, even if it is faulty; to be cleared it is a 503.
#[utoipa::path(
    post,
    path = "/v1/plans",
    operation_id = "plan",
    tag = "planning",
    request_body(content = SceneBody, content_type = "application/json", description = "The scene and how to plan."),
    responses(
        (status = 200, description = "The verdict with its plan and proof, or a drawing if `Accept` prefers one.",
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

/// Check an answer
///
/// The independent checker replays the plan on the scene. It also checks the locks, the landmarks and the bound that
/// the answer states.
#[utoipa::path(
    post,
    path = "/v1/plans/verify",
    operation_id = "verify",
    tag = "planning",
    request_body(content = VerifyBody, content_type = "application/json", description = "A scene and the answer to check."),
    responses(
        (status = 200, description = "Whether the answer holds, and every fault that was found.",
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

/// Survey every object as the target
///
/// Says how many relocations each object would need, without looking for places. Objects that are fixed or too wide are
/// left out. The scene's own `target` or `goal` is required, but does not change the answer. Of the settings only
/// `destination` and the time limit do. `time_limit_ms` is for the whole call: objects that are undecided by then are
/// `timed_out`.
#[utoipa::path(
    post,
    path = "/v1/survey",
    operation_id = "survey",
    tag = "planning",
    request_body(content = SceneBody, content_type = "application/json", description = "The scene."),
    responses(
        (status = 200, description = "The verdict and the bound of each object.",
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
/// Says which obstacle blocks which yaws, and which sets of obstacles would have to go, by the scene's `grasp_model`.
/// With `sector` the paper's polar histogram comes too. The scene's `target` or `goal`, `search`, `placement` and
/// `objective` do not change the answer. A call that is not done within `time_limit_ms` is a 503.
#[utoipa::path(
    post,
    path = "/v1/knowledge",
    operation_id = "knowledge",
    tag = "planning",
    request_body(content = SceneBody, content_type = "application/json", description = "The scene."),
    responses(
        (status = 200, description = "The shadows and options of each object.",
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
