//! One job: show, cancel, delete.

use core::time::Duration;
use std::sync::Arc;
use std::time::Instant;

use axum::Json;
use axum::extract::rejection::PathRejection;
use axum::extract::{Path, State};
use axum::http::StatusCode;
use axum::response::Response;
use tokio::time::sleep;

use super::calls::{JobCalls, accepted};
use super::problems::{OneJobProblems, job_id, no_such_job};
use super::query::Parameters;
use crate::api::access::Caller;
use crate::api::running::Running;
use crate::jobs::{Cancellation, Job, JobId, JobState, Owner, Removal, Timestamp, job_ended};
use crate::metrics::Ended;
use crate::wire::{JobBody, Problem, ProblemKind};

/// The longest long poll, ms: proxies and clients tolerate this much.
const MAX_WAIT_MS: u64 = 60_000;
/// The poll interval of waiting requests: hints of other servers may be lost. Thousands may wait, and each poll reads
/// from the store.
pub(super) const LOOK_AGAIN: Duration = Duration::from_secs(3);

/// Show a job
///
/// With `wait_ms` the answer comes when the job has ended or the wait is over.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}",
    operation_id = "show_job",
    tag = "jobs",
    params(
        ("id" = String, Path, description = "The job."),
        ("wait_ms" = Option<u32>, Query, minimum = 0, maximum = 60000, description = "How long to wait for the job's end, ms."),
    ),
    responses(
        (status = 200, description = "The job.", body = JobBody, content_type = "application/json"),
        OneJobProblems,
    )
)]
pub(in crate::api) async fn show(
    State(calls): State<Arc<JobCalls>>,
    caller: Caller,
    id: Result<Path<String>, PathRejection>,
    parameters: Parameters,
) -> Result<Json<JobBody>, Problem> {
    let id = job_id(id)?;
    let wait = parameters.only(&["wait_ms"])?.number("wait_ms", 0..=MAX_WAIT_MS)?.unwrap_or_default();
    let job = if wait == 0 {
        find(&calls, &caller.owner, id).await?
    } else {
        wait_for(&calls, &caller, id, Duration::from_millis(wait)).await?
    };
    Ok(Json(job.body()))
}

/// Cancel a job
///
/// A queued job is cancelled at once. A running job stops and keeps its best answer so far as its result.
#[utoipa::path(
    post,
    path = "/v1/jobs/{id}/cancel",
    operation_id = "cancel_job",
    tag = "jobs",
    params(("id" = String, Path, description = "The job.")),
    responses(
        (status = 202, description = "The job is cancelled, or will be in a moment.", body = JobBody,
         content_type = "application/json"),
        (status = 409, description = "The job had already ended.", body = Problem, content_type = "application/problem+json"),
        OneJobProblems,
    )
)]
pub(in crate::api) async fn cancel(
    State(calls): State<Arc<JobCalls>>,
    caller: Caller,
    id: Result<Path<String>, PathRejection>,
) -> Result<Response, Problem> {
    let id = job_id(id)?;
    let Running { store, runner, metrics, .. } = &*calls.running;
    let cancelled = store.cancel(&caller.owner, id, Timestamp::now()).await;
    match cancelled.map_err(|error| calls.unavailable(&error))? {
        Cancellation::Unknown => Err(no_such_job()),
        Cancellation::Finished => Err(Problem::new(ProblemKind::JobFinished, "an ended job can't be cancelled")),
        Cancellation::Accepted(job) => {
            runner.cancel(id);
            if job.state == JobState::Cancelled {
                job_ended(id, Ended::Cancelled);
                metrics.job_ended(Ended::Cancelled);
            }
            Ok(accepted(Some(id), job.body()))
        }
    }
}

/// Delete a job
///
/// Deletes the job, its result and its idempotency key. The job must have ended.
#[utoipa::path(
    delete,
    path = "/v1/jobs/{id}",
    operation_id = "forget_job",
    tag = "jobs",
    params(("id" = String, Path, description = "The job.")),
    responses(
        (status = 204, description = "The job is deleted."),
        (status = 409, description = "The job has not ended. Cancel it first.", body = Problem,
         content_type = "application/problem+json"),
        OneJobProblems,
    )
)]
pub(in crate::api) async fn forget(
    State(calls): State<Arc<JobCalls>>,
    caller: Caller,
    id: Result<Path<String>, PathRejection>,
) -> Result<StatusCode, Problem> {
    let removal = calls.running.store.forget(&caller.owner, job_id(id)?).await;
    match removal.map_err(|error| calls.unavailable(&error))? {
        Removal::Unknown => Err(no_such_job()),
        Removal::Unfinished => Err(Problem::new(ProblemKind::JobUnfinished, "cancel it first")),
        Removal::Forgotten => Ok(StatusCode::NO_CONTENT),
    }
}

/// A job of the caller.
pub(super) async fn find(calls: &JobCalls, owner: &Owner, id: JobId) -> Result<Job, Problem> {
    let found = calls.running.store.get(owner, id).await;
    found.map_err(|error| calls.unavailable(&error))?.ok_or_else(no_such_job)
}

/// The job once it has ended; or as it is on time-out, at shutdown, or when the key is no longer in force.
async fn wait_for(calls: &JobCalls, caller: &Caller, id: JobId, wait: Duration) -> Result<Job, Problem> {
    let started = Instant::now();
    let waiting = calls.waiting.try_acquire();
    let _waiting = waiting.map_err(|_| calls.too_many("too many clients wait for jobs; ask without `wait_ms`"))?;
    let Running { store, draining, .. } = &*calls.running;
    let watcher = store.hints().watch(id);
    loop {
        let changed = watcher.changed();
        let job = find(calls, &caller.owner, id).await?;
        let left = wait.saturating_sub(started.elapsed());
        if job.state.finished() || left.is_zero() || draining.begun() {
            return Ok(job);
        }
        tokio::select! {
            () = changed => {}
            () = sleep(left.min(LOOK_AGAIN)) => {}
            () = draining.wait() => {}
            () = caller.locked_out() => return Ok(job),
        }
    }
}
