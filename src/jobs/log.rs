//! The log lines of a job's life: started or resumed, and ended.

use std::time::Instant;

use super::job::{JobId, Owner};
use super::store::{Claim, Claimed};
use super::timestamp::Timestamp;
use super::work::Concluded;
use crate::metrics::{Ended, milliseconds};

/// The fence of a job's first claim.
const FIRST: i64 = 1;

/// One worker's lines about one job.
#[derive(Debug)]
pub(super) struct Lines {
    job: JobId,
    owner: Owner,
    scene_id: Option<String>,
    started: Instant,
}

impl Lines {
    /// The worker begins. A job that was claimed before is resumed: its worker was lost, or handed it back, or never heard of the claim.
    pub(super) fn begin(claimed: &Claimed, scene_id: Option<String>) -> Self {
        let Claimed { claim: Claim { id: job, fence }, owner, attempt, created_at, .. } = claimed;
        let age_ms = milliseconds(Timestamp::now().since(*created_at));
        let what = if *fence > FIRST { "job resumed" } else { "job started" };
        tracing::info!(%job, owner = owner.as_str(), scene_id, attempt, age_ms, "{what}");
        Self { job: *job, owner: owner.clone(), scene_id, started: Instant::now() }
    }

    /// The job has ended in this state, and that is kept.
    pub(super) fn end(&self, state: Ended, concluded: &Concluded) {
        let Self { job, owner, scene_id, started } = self;
        let (owner, state, ms) = (owner.as_str(), state.as_str(), milliseconds(started.elapsed()));
        let verdict = concluded.verdict.map(tracing::field::display);
        let problem = concluded.cause.map(|cause| tracing::field::display(cause.problem));
        let code = concluded.cause.and_then(|cause| cause.code).map(tracing::field::display);
        tracing::info!(%job, owner, scene_id, state, verdict, problem, code, ms, "job ended");
    }
}

/// A job has ended without a worker.
pub fn job_ended(job: JobId, state: Ended) {
    tracing::info!(%job, state = state.as_str(), "job ended");
}
