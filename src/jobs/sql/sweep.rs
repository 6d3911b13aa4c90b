//! Expiry: ended leases, overdue jobs, retention. And the counts of jobs.

use sqlx::{AnyConnection, AssertSqlSafe, Error};

use super::change::{Change, Ending, STANDING, Standing};
use super::herald::News;
use super::row;
use crate::jobs::{Counts, End, JobState, MAX_ATTEMPTS, Swept, Timestamp};

/// Jobs of each kind per transaction. Each requeued job counts the queue, some 2 ms for 10,000.
const BATCH: usize = 200;

/// One batch, and whether there is more to do. A requeued job whose time is over may expire at once.
pub(super) async fn batch(change: &mut Change<'_>, now: Timestamp) -> Result<(Swept, bool), Error> {
    let mut swept = Swept::default();
    let mut lost = overdue(change, "state = 'running' AND lease_ends <= $1 ORDER BY lease_ends", now).await?;
    // Each event holds the job's place in the queue, so jobs ahead of it are requeued first.
    lost.sort_by_key(Standing::order);
    for job in &lost {
        lose(change, job, &mut swept, now).await?;
    }
    let late = overdue(change, "state = 'queued' AND expires_at <= $1 ORDER BY expires_at", now).await?;
    for job in &late {
        change.end(job, &Ending::bare(JobState::Expired), now).await?;
    }
    swept.expired = late.iter().map(|job| job.id).collect();
    let old = "state <> 'queued' AND state <> 'running' AND expires_at <= $1 ORDER BY expires_at";
    let old = overdue(change, old, now).await?;
    for job in &old {
        let query = sqlx::query("DELETE FROM jobs WHERE id = $1").bind(job.id.to_string());
        query.execute(change.connection()).await?;
        change.announce(News::of(job.id));
    }
    swept.forgotten = u64::try_from(old.len()).unwrap_or(u64::MAX);
    Ok((swept, [lost, late, old].iter().any(|jobs| jobs.len() == BATCH)))
}

/// The jobs that meet the condition. Jobs locked by others are left for the next sweep.
async fn overdue(change: &mut Change<'_>, condition: &str, now: Timestamp) -> Result<Vec<Standing>, Error> {
    let text = format!("{STANDING} WHERE {condition} LIMIT {BATCH}{}", change.dialect().locked_if_free());
    let query = sqlx::query(AssertSqlSafe(text)).bind(now.as_millis());
    query.fetch_all(change.connection()).await?.iter().map(Standing::read).collect()
}

/// Requeues or ends a job whose lease has ended.
async fn lose(change: &mut Change<'_>, job: &Standing, swept: &mut Swept, now: Timestamp) -> Result<(), Error> {
    if job.cancel_requested {
        swept.cancelled.push(job.id);
        change.end(job, &Ending::bare(JobState::Cancelled), now).await
    } else if job.attempts < MAX_ATTEMPTS {
        swept.requeued.push(job.id);
        change.requeue(job, job.attempts, now).await
    } else {
        swept.poisoned.push(job.id);
        change.end(job, &Ending::new(JobState::Failed, &End::poisoned(), None), now).await
    }
}

pub(super) fn add(all: &mut Swept, batch: Swept) {
    let Swept { requeued, poisoned, cancelled, expired, forgotten } = batch;
    all.requeued.extend(requeued);
    all.poisoned.extend(poisoned);
    all.cancelled.extend(cancelled);
    all.expired.extend(expired);
    all.forgotten += forgotten;
}

pub(super) async fn counts(connection: &mut AnyConnection) -> Result<Counts, Error> {
    let query = sqlx::query(
        "SELECT (SELECT COUNT(*) FROM jobs WHERE state = 'queued') AS queued, \
         (SELECT COUNT(*) FROM jobs WHERE state = 'running') AS running",
    );
    let row = query.fetch_one(connection).await?;
    Ok(Counts { queued: row::whole(&row, "queued")?, running: row::whole(&row, "running")? })
}
