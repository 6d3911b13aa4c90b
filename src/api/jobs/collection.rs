//! The collection of a caller's jobs: submit one or several, list.

use core::time::Duration;
use std::sync::Arc;
use std::time::Instant;

use axum::Json;
use axum::body::Body;
use axum::extract::State;
use axum::http::Request;
use axum::response::Response;
use tokio::time::timeout;

use super::calls::{JobCalls, accepted};
use super::problems::JobProblems;
use super::query::Parameters;
use super::submission::{Shape, check_callbacks, key, new_jobs};
use crate::api::access::Caller;
use crate::api::problem::RequestProblems;
use crate::computation::{internal, note_scene};
use crate::jobs::{Job, JobState, Owner, Page, Timestamp};
use crate::wire::{
    BatchBody, JobBody, JobListBody, JobRequest, JobSceneBody, JobsBody, Problem, RequestLimits, read_batch, read_job,
};

/// How long a submission waits for its permit: enough for a fleet that starts at once, since the store takes hundreds a
/// second.
const SUBMIT_PATIENCE: Duration = Duration::from_secs(1);
/// The most jobs on a page, and the default: one screen, and a small answer.
const MAX_PAGE: u64 = 100;
const DEFAULT_PAGE: u64 = 20;

/// Reads a body with job requests.
type Read = fn(&[u8], &RequestLimits) -> Result<Vec<JobRequest>, Problem>;

/// Plan later
///
/// Accepts a scene and answers at once. The job is on disk by then. A request with an `Idempotency-Key` can be
/// repeated: it is accepted only once, as long as its job is kept.
#[utoipa::path(
    post,
    path = "/v1/jobs",
    operation_id = "submit_job",
    tag = "jobs",
    params(("Idempotency-Key" = Option<String>, Header, max_length = 255,
        description = "The caller's name for the request. The same key with the same body gives the same job.")),
    request_body(content = JobSceneBody, content_type = "application/json", description = "The scene and how to plan."),
    responses(
        (status = 202, description = "The job.", body = JobBody, content_type = "application/json",
         headers(("Location" = String, description = "The path of the job."),
                 ("Retry-After" = u32, description = "Seconds to wait before asking for the job."))),
        RequestProblems,
    )
)]
pub(in crate::api) async fn submit(
    State(calls): State<Arc<JobCalls>>,
    caller: Caller,
    request: Request<Body>,
) -> Result<Response, Problem> {
    let read: Read = |body, limits| Ok(vec![read_job(body, limits)?]);
    let jobs = take(&calls, &caller.owner, request, (read, Shape::One)).await?;
    let job = jobs.first().ok_or_else(internal)?;
    Ok(accepted(Some(job.id), job.body()))
}

/// Plan several scenes later
///
/// All are accepted, or none. An `Idempotency-Key` names the request as a whole.
#[utoipa::path(
    post,
    path = "/v1/jobs/batch",
    operation_id = "submit_jobs",
    tag = "jobs",
    params(("Idempotency-Key" = Option<String>, Header, max_length = 255,
        description = "The caller's name for the request. The same key with the same body gives the same jobs.")),
    request_body(content = BatchBody, content_type = "application/json", description = "The scenes."),
    responses(
        (status = 202, description = "The jobs, in the order of the scenes.", body = JobsBody,
         content_type = "application/json", headers(("Retry-After" = u32, description = "Seconds to wait before asking for the job."))),
        RequestProblems,
    )
)]
pub(in crate::api) async fn batch(
    State(calls): State<Arc<JobCalls>>,
    caller: Caller,
    request: Request<Body>,
) -> Result<Response, Problem> {
    let jobs = take(&calls, &caller.owner, request, (read_batch, Shape::Batch)).await?;
    Ok(accepted(None, JobsBody { jobs: jobs.iter().map(Job::body).collect() }))
}

/// List jobs
///
/// The caller's own jobs, the latest first, without their results.
#[utoipa::path(
    get,
    path = "/v1/jobs",
    operation_id = "list_jobs",
    tag = "jobs",
    params(
        ("state" = Option<crate::wire::JobStateWord>, Query, description = "Only jobs in this state."),
        ("cursor" = Option<String>, Query, description = "The `next_cursor` of the previous page."),
        ("limit" = Option<u32>, Query, minimum = 1, maximum = 100, description = "The most jobs on a page. Default: 20."),
    ),
    responses(
        (status = 200, description = "One page.", body = JobListBody, content_type = "application/json"),
        JobProblems,
    )
)]
pub(in crate::api) async fn list(
    State(calls): State<Arc<JobCalls>>,
    caller: Caller,
    parameters: Parameters,
) -> Result<Json<JobListBody>, Problem> {
    let parameters = parameters.only(&["state", "cursor", "limit"])?;
    let states = JobState::ALL.map(JobState::as_str).join(", ");
    let state = parameters.read("state", format_args!("one of {states}"), |text| text.parse().ok())?;
    let before = parameters.read("cursor", "the `next_cursor` of the previous page", |text| text.parse().ok())?;
    let limit = parameters.number("limit", 1..=MAX_PAGE)?.unwrap_or(DEFAULT_PAGE);
    let limit = usize::try_from(limit).unwrap_or(usize::MAX);
    // One more, to see whether there is a next page.
    let page = Page { state, before, limit: limit + 1 };
    let listed = calls.running.store.list(&caller.owner, page).await;
    let jobs = listed.map_err(|error| calls.unavailable(&error))?;
    let next_cursor = (jobs.len() > limit).then(|| jobs[limit - 1].id.to_string());
    Ok(Json(JobListBody { jobs: jobs.iter().take(limit).map(Job::body).collect(), next_cursor }))
}

/// Submits the jobs of a body.
async fn take(
    calls: &JobCalls,
    owner: &Owner,
    request: Request<Body>,
    (read, shape): (Read, Shape),
) -> Result<Vec<Job>, Problem> {
    let arrival = Instant::now();
    let planning = &calls.running.planning;
    planning.takes_work()?;
    let key = key(request.headers())?;
    let body = calls.bodies.receive(request).await?;
    let _submitting = match timeout(SUBMIT_PATIENCE, calls.submitting.acquire()).await {
        Ok(Ok(place)) => place,
        _ => return Err(calls.too_many("too many requests submit jobs at a time; this one was not accepted")),
    };
    let (own, allow) = (owner.clone(), calls.callback_allow.clone());
    let new = move |body: &[u8], limits: &RequestLimits| {
        let mut requests = read(body, limits)?;
        check_callbacks(&mut requests, shape, &allow)?;
        Ok(new_jobs(requests, body, &own, key.as_deref()))
    };
    let jobs = planning.read(owner.as_str(), arrival, body, new).await?;
    if let [job] = &jobs[..] {
        note_scene(job.scene_id.as_deref());
    }
    calls.running.store.submit(&jobs, Timestamp::now()).await.map_err(|error| calls.not_accepted(error))
}

#[cfg(test)]
mod tests {
    use axum::http::{StatusCode, header};
    use tower::ServiceExt;

    use super::*;
    use crate::api::{App, Engine, ServerSettings, router};
    use crate::jobs::JobSettings;

    #[tokio::test]
    async fn only_so_many_requests_hand_in_jobs_at_a_time() {
        let jobs = JobSettings { url: "sqlite::memory:".to_owned(), ..JobSettings::default() };
        let settings = ServerSettings { jobs, ..ServerSettings::default() };
        let app = Arc::new(App::start(settings, Engine::default()).await.unwrap());
        let ask = async || {
            let request = Request::post("/v1/jobs").header(header::CONTENT_TYPE, "application/json");
            router(&app).oneshot(request.body(Body::from("{}")).unwrap()).await.unwrap()
        };
        let submitting = &app.parts.jobs.submitting;
        let others = submitting.available_permits().try_into().unwrap();
        let others = submitting.acquire_many(others).await.unwrap();
        let refused = ask().await;
        assert_eq!(refused.status(), StatusCode::SERVICE_UNAVAILABLE);
        assert!(refused.headers().contains_key(header::RETRY_AFTER));
        drop(others);
        assert_eq!(ask().await.status(), StatusCode::UNPROCESSABLE_ENTITY);
    }
}
