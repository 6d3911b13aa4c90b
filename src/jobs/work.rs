//! One claimed job on its way through a worker.

use std::sync::Arc;
use std::time::Instant;

use tokio::sync::watch;

use super::job::End;
use crate::computation::Engine;
use crate::metrics::Metrics;
use crate::wire::{AnswerBody, Cause, Glance, Problem, ProblemKind, RequestLimits, VerdictWord, read_job};
use crate::workers::{Outcome, Pending, Pool, Recall, Refused};
use singulate_planner::budget::{Budget, Incumbent};

/// The store has seen to the turns of owners; a job that it gave is not to wait for another's.
const WORKER: &str = "worker";

/// What a worker needs besides the job.
#[derive(Clone)]
pub(super) struct Tools {
    pub(super) engine: Engine,
    pub(super) limits: RequestLimits,
    pub(super) metrics: Arc<Metrics>,
}

/// An answer as it is kept.
struct Written {
    verdict: VerdictWord,
    json: String,
}

/// How a worker's job ends, and the same in short.
pub(super) struct Concluded {
    pub(super) end: End,
    pub(super) verdict: Option<VerdictWord>,
    pub(super) cause: Option<Cause>,
}

impl From<Result<Written, Problem>> for Concluded {
    fn from(outcome: Result<Written, Problem>) -> Self {
        match outcome {
            Ok(Written { verdict, json }) => Self { end: End::Succeeded(json), verdict: Some(verdict), cause: None },
            Err(problem) => {
                // A problem is made of strings and numbers.
                let end = End::Failed(serde_json::to_string(&problem).unwrap_or_default());
                Self { end, verdict: None, cause: Some(problem.cause()) }
            }
        }
    }
}

/// A job that a worker has.
pub(super) struct Work {
    pending: Pending<Result<Written, Problem>>,
    body: Arc<Vec<u8>>,
    glance: Glance,
}

impl Work {
    /// Begin. The time limit counts from now; the best so far is told to `watcher`.
    ///
    /// # Errors
    /// [`Refused`] if every worker is busy.
    pub(super) fn begin(
        body: Vec<u8>,
        pool: &Pool,
        tools: &Tools,
        watcher: watch::Sender<Option<Incumbent>>,
    ) -> Result<Self, Refused> {
        let (arrival, body) = (Instant::now(), Arc::new(body));
        let glance = Glance::at(&body, &tools.limits);
        let (own, tools) = (Arc::clone(&body), tools.clone());
        let job = move |budget: &Budget<'_>| {
            let observer = |incumbent| {
                watcher.send_if_modified(|last| last.replace(incumbent) != Some(incumbent));
            };
            plan(&own, &tools, &budget.observed(&observer))
        };
        let pending = pool.submit(WORKER, arrival, glance.time_limit, job)?;
        Ok(Self { pending, body, glance })
    }

    /// The way to its early end.
    pub(super) fn recall(&self) -> Recall {
        self.pending.recall()
    }

    /// The caller's name for the scene.
    pub(super) fn scene_id(&self) -> Option<String> {
        self.glance.scene_id.clone()
    }

    /// How the job ends.
    pub(super) async fn end(self) -> Concluded {
        let ended = match self.pending.outcome().await {
            Outcome::Done(answer) => answer,
            // Only a planner that forgets the time is not waited for; nothing of what it knows is at hand.
            Outcome::TimedOut => AnswerBody::unread(&self.glance).ok_or_else(internal).and_then(|body| written(&body)),
            Outcome::Panicked => {
                tracing::error!(scene = %String::from_utf8_lossy(&self.body), "planning panicked");
                Err(internal())
            }
        };
        ended.into()
    }
}

fn plan(body: &[u8], tools: &Tools, budget: &Budget<'_>) -> Result<Written, Problem> {
    // It was read before it was accepted; but that may have been another version, with other limits.
    let request = read_job(body, &tools.limits)?.plan;
    let answer = tools.engine.answer(&request, budget)?;
    tools.metrics.planned(&answer);
    written(&AnswerBody::new(&request, &answer))
}

fn written(body: &AnswerBody) -> Result<Written, Problem> {
    let json = serde_json::to_string(body).map_err(|error| {
        tracing::error!(%error, "an answer could not be written");
        internal()
    })?;
    Ok(Written { verdict: body.verdict, json })
}

fn internal() -> Problem {
    Problem::new(ProblemKind::Internal, "the job could not be planned")
}
