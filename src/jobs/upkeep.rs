//! Pauses between retries of store calls, and the periodic sweep for expired leases and jobs.

use core::time::Duration;
use std::sync::Arc;

use tokio::time::{MissedTickBehavior, interval, sleep};

use super::end::job_ended;
use super::store::{Store, Swept};
use super::timestamp::Timestamp;
use crate::metrics::{Ended, Metrics};
use crate::workers::Draining;

/// The first and the longest pause after a failure: short for a hiccup, long enough for a store that is starting.
const LEAST: Duration = Duration::from_millis(50);
const GREATEST: Duration = Duration::from_secs(2);

/// A pause that doubles each time.
#[derive(Debug)]
pub(super) struct Pause(Duration);

impl Default for Pause {
    fn default() -> Self {
        Self(LEAST)
    }
}

impl Pause {
    /// Waits, and doubles the next pause.
    pub(super) async fn pass(&mut self) {
        let length = self.0;
        self.0 = (2 * length).min(GREATEST);
        sleep(length).await;
    }
}

/// The sweep interval: a quarter of the lease, so that a lost worker's job waits hardly longer than its lease. The
/// bounds avoid constant sweeping, and expired jobs that still show as queued.
const OFTEN: Duration = Duration::from_millis(50);
const SELDOM: Duration = Duration::from_secs(1);

/// Sweeps the store at intervals until `draining`.
pub(super) async fn sweep(store: Arc<dyn Store>, metrics: Arc<Metrics>, lease: Duration, draining: Draining) {
    let mut due = interval((lease / 4).clamp(OFTEN, SELDOM));
    due.set_missed_tick_behavior(MissedTickBehavior::Delay);
    while draining.unless_begun(due.tick()).await.is_some() {
        match store.sweep(Timestamp::now()).await {
            Ok(swept) => tell(&swept, &metrics),
            Err(error) => tracing::warn!(%error, "the store could not be swept"),
        }
    }
}

/// Logs and counts the changes of a sweep, job by job.
fn tell(swept: &Swept, metrics: &Metrics) {
    for job in &swept.requeued {
        tracing::warn!(%job, "job lost its worker and is queued again");
    }
    for job in &swept.poisoned {
        tracing::error!(%job, "job has lost three workers and is not tried again");
    }
    let ended =
        [(&swept.poisoned, Ended::Failed), (&swept.cancelled, Ended::Cancelled), (&swept.expired, Ended::Expired)];
    for (jobs, state) in ended {
        for job in jobs {
            job_ended(*job, state);
            metrics.job_ended(state);
        }
    }
}
