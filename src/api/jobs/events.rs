//! `GET /v1/jobs/{id}/events`: the events of a job, live.

use core::convert::Infallible;
use std::collections::VecDeque;
use std::sync::Arc;

use axum::extract::rejection::PathRejection;
use axum::extract::{Path, State};
use axum::http::{HeaderMap, HeaderName, StatusCode};
use axum::response::sse::{Event as Message, KeepAlive, Sse};
use axum::response::{IntoResponse, Response};
use futures_util::stream::{Stream, unfold};
use tokio::sync::OwnedSemaphorePermit;
use tokio::time::sleep;

use super::calls::JobCalls;
use super::one::{LOOK_AGAIN, find};
use super::problems::{OneJobProblems, job_id};
use crate::api::access::Caller;
use crate::api::running::Running;
use crate::jobs::{Job, Watcher};
use crate::metrics::Open;
use crate::wire::{JobBody, Problem};

const LAST_EVENT_ID: HeaderName = HeaderName::from_static("last-event-id");

/// Follow a job
///
/// Sends the server-sent events `queued`, `running`, `incumbent` and `finished`, beginning with the first. The number
/// of an event is its `id`, its data is the job at that moment. The stream ends with `finished`. If the service shuts
/// down it ends with `draining`, which has no number: connect again to any server, with `Last-Event-ID`. A 204 means
/// that no more events will come.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/events",
    operation_id = "job_events",
    tag = "jobs",
    params(
        ("id" = String, Path, description = "The job."),
        ("Last-Event-ID" = Option<String>, Header, description = "The `id` of the last event that was received. Only later events are sent."),
    ),
    responses(
        (status = 200, description = "The events. The schema describes the data of one event.", body = JobBody, content_type = "text/event-stream"),
        (status = 204, description = "The job has ended, and all its events were received."),
        OneJobProblems,
    )
)]
pub(in crate::api) async fn events(
    State(calls): State<Arc<JobCalls>>,
    caller: Caller,
    id: Result<Path<String>, PathRejection>,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    let id = job_id(id)?;
    let seen = headers.get(LAST_EVENT_ID).and_then(|value| value.to_str().ok()?.parse().ok());
    let job = find(&calls, &caller.owner, id).await?;
    // An unknown id starts from the beginning.
    let seen = seen.filter(|seen| *seen <= job.events.len()).unwrap_or_default();
    if job.state.finished() && seen == job.events.len() {
        return Ok(StatusCode::NO_CONTENT.into_response());
    }
    let slot = Arc::clone(&calls.streams).try_acquire_owned();
    let slot = slot.map_err(|_| calls.too_many("too many clients follow jobs; ask for the job instead"))?;
    let listener = Listener::new(Arc::clone(&calls.running), caller, (job, seen), slot);
    Ok(Sse::new(listener.messages()).keep_alive(KeepAlive::default()).into_response())
}

/// One client of a job's event stream.
struct Listener {
    running: Arc<Running>,
    caller: Caller,
    /// The job when the store was last read.
    job: Job,
    watcher: Watcher,
    /// The number of events seen.
    seen: usize,
    /// Messages to be sent next.
    ready: VecDeque<Message>,
    over: bool,
    _slot: OwnedSemaphorePermit,
    _open: Open,
}

impl Listener {
    fn new(running: Arc<Running>, caller: Caller, (job, seen): (Job, usize), slot: OwnedSemaphorePermit) -> Self {
        let watcher = running.store.hints().watch(job.id);
        let open = running.metrics.stream();
        Self { running, caller, job, watcher, seen, ready: VecDeque::new(), over: false, _slot: slot, _open: open }
    }

    fn messages(self) -> impl Stream<Item = Result<Message, Infallible>> {
        unfold(self, async |mut listener| {
            let message = listener.next().await?;
            Some((Ok(message), listener))
        })
    }

    async fn next(&mut self) -> Option<Message> {
        loop {
            if let Some(message) = self.ready.pop_front() {
                return Some(message);
            }
            if self.over {
                return None;
            }
            let changed = self.watcher.changed();
            match self.running.store.get(&self.caller.owner, self.job.id).await {
                Ok(Some(job)) => self.take(job),
                Ok(None) => self.over = true,
                // The store may be back soon.
                Err(error) => tracing::debug!(%error, "an event stream waits for the store"),
            }
            if self.ready.is_empty() && !self.over {
                tokio::select! {
                    () = changed => {}
                    () = sleep(LOOK_AGAIN) => {}
                    () = self.caller.locked_out() => self.over = true,
                    () = self.running.draining.wait() => {
                        self.ready.push_back(message("draining", &self.job));
                        self.over = true;
                    }
                }
            }
        }
    }

    fn take(&mut self, job: Job) {
        for (at, event) in job.events.iter().enumerate().skip(self.seen) {
            let message = message(event.kind.as_str(), &job.as_of(event));
            self.ready.push_back(message.id((at + 1).to_string()));
        }
        self.seen = self.seen.max(job.events.len());
        self.over = job.state.finished();
        self.job = job;
    }
}

/// An event without a number.
fn message(name: &str, job: &Job) -> Message {
    Message::default().event(name).data(serde_json::to_string(&job.body()).unwrap_or_default())
}
