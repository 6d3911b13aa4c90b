//! One claimed job in a worker: its plan, and its log lines.

use std::sync::Arc;
use std::time::Instant;

use tokio::sync::watch;

use super::end::Concluded;
use super::job::{JobId, Owner};
use super::store::{Claim, Claimed};
use super::timestamp::Timestamp;
use crate::computation::Tools;
use crate::metrics::{Ended, milliseconds};
use crate::wire::{AnswerBody, Glance, Problem, RequestLimits, read_job};
use crate::workers::{Pending, Pool, PoolOutcome, Recall, Refused};
use singulate_planner::budget::Budget;
use singulate_planner::search::{Incumbent, Progress};

/// One owner for all jobs in the pool: the store already takes owners in turn, so a claimed job must not wait again.
const WORKER: &str = "worker";

/// The fence of a job's first claim.
const FIRST: i64 = 1;

/// A job in a worker.
pub(super) struct Work {
    pending: Pending<Concluded>,
    body: Arc<Vec<u8>>,
    glance: Glance,
}

impl Work {
    /// Starts planning. The time limit counts from now; incumbents go to `watcher`.
    ///
    /// # Errors
    /// [`Refused`] if every worker is busy.
    pub(super) fn begin(
        body: Vec<u8>,
        pool: &Pool,
        tools: &Tools,
        limits: RequestLimits,
        watcher: watch::Sender<Option<Incumbent>>,
    ) -> Result<Self, Refused> {
        let (arrival, body) = (Instant::now(), Arc::new(body));
        let glance = Glance::at(&body, &limits);
        let (own, tools) = (Arc::clone(&body), tools.clone());
        let job = move |budget: &Budget<'_>| {
            let observer = |incumbent| {
                watcher.send_if_modified(|last| last.replace(incumbent) != Some(incumbent));
            };
            plan(&own, &tools, &limits, budget, &observer).unwrap_or_else(Concluded::from)
        };
        let pending = pool.submit(WORKER, arrival, glance.time_limit, job)?;
        Ok(Self { pending, body, glance })
    }

    /// A handle to end it early.
    pub(super) fn recall(&self) -> Recall {
        self.pending.recall()
    }

    /// The caller's name for the scene.
    pub(super) fn scene_id(&self) -> Option<String> {
        self.glance.scene_id.clone()
    }

    /// How the job ends.
    pub(super) async fn end(self) -> Concluded {
        match self.pending.outcome().await {
            PoolOutcome::Done(concluded) => concluded,
            // Only a planner that ignores its time is abandoned; its best so far is not available.
            PoolOutcome::TimedOut => {
                AnswerBody::unread(&self.glance).map_or_else(Concluded::internal, |answer| Concluded::with(&answer))
            }
            PoolOutcome::Panicked => {
                tracing::error!(scene = %String::from_utf8_lossy(&self.body), "planning panicked");
                Concluded::internal()
            }
        }
    }
}

fn plan(
    body: &[u8],
    tools: &Tools,
    limits: &RequestLimits,
    budget: &Budget<'_>,
    progress: Progress<'_>,
) -> Result<Concluded, Problem> {
    // The body was valid when accepted, but maybe by another version with other limits.
    let request = read_job(body, limits)?.plan;
    let judged = tools.answer(&request, budget, progress)?;
    Ok(Concluded::with(&AnswerBody::new(&request, &judged)))
}

/// The log lines of one worker about one job.
#[derive(Debug)]
pub(super) struct Lines {
    job: JobId,
    owner: Owner,
    scene_id: Option<String>,
    started: Instant,
}

impl Lines {
    /// Logs the start. A job that was claimed before is resumed: its worker was lost, handed it back, or never received
    /// the claim.
    pub(super) fn begin(claimed: &Claimed, scene_id: Option<String>) -> Self {
        let Claimed { claim: Claim { id: job, fence }, owner, attempt, created_at, .. } = claimed;
        let age_ms = milliseconds(Timestamp::now().since(*created_at));
        let what = if *fence > FIRST { "job resumed" } else { "job started" };
        tracing::info!(%job, owner = owner.as_str(), scene_id, attempt, age_ms, "{what}");
        Self { job: *job, owner: owner.clone(), scene_id, started: Instant::now() }
    }

    /// Logs the end, once it is stored.
    pub(super) fn end(&self, state: Ended, concluded: &Concluded) {
        let Self { job, owner, scene_id, started } = self;
        let (owner, state, ms) = (owner.as_str(), state.as_str(), milliseconds(started.elapsed()));
        let verdict = concluded.verdict;
        let problem = concluded.cause.map(|cause| tracing::field::display(cause.problem));
        let code = concluded.cause.and_then(|cause| cause.code).map(tracing::field::display);
        tracing::info!(%job, owner, scene_id, state, verdict, problem, code, ms, "job ended");
    }
}
