//! Sees to what time brings: leases, jobs and callbacks that are over.

use core::time::Duration;
use std::sync::Arc;

use tokio::time::{MissedTickBehavior, interval};

use super::store::{Store, Swept};
use super::timestamp::Timestamp;
use crate::metrics::{Ended, Metrics};
use crate::workers::Draining;

/// How often to look: four times a lease, so that a lost worker's job waits hardly longer than its lease; but not all the
/// time, and not so seldom that an expired job is seen waiting.
const OFTEN: Duration = Duration::from_millis(50);
const SELDOM: Duration = Duration::from_secs(1);

/// Sweep the store now and then until `draining`.
pub(super) async fn sweep(store: Arc<dyn Store>, metrics: Arc<Metrics>, lease: Duration, draining: Draining) {
    let mut due = interval((lease / 4).clamp(OFTEN, SELDOM));
    due.set_missed_tick_behavior(MissedTickBehavior::Delay);
    while draining.unless_begun(due.tick()).await.is_some() {
        match store.sweep(Timestamp::now()).await {
            Ok(swept) => {
                tell(&swept);
                count(&swept, &metrics);
            }
            Err(error) => tracing::warn!(%error, "the store could not be swept"),
        }
    }
}

fn tell(swept: &Swept) {
    for job in &swept.poisoned {
        tracing::error!(%job, "the job ended three workers; it is not tried again");
    }
    if swept.requeued > 0 {
        tracing::warn!(jobs = swept.requeued, "jobs lost their workers and are queued again");
    }
}

fn count(swept: &Swept, metrics: &Metrics) {
    swept.poisoned.iter().for_each(|_| metrics.job_ended(Ended::Failed));
    (0..swept.cancelled).for_each(|_| metrics.job_ended(Ended::Cancelled));
    (0..swept.expired).for_each(|_| metrics.job_ended(Ended::Expired));
}
