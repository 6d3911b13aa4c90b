//! Store calls of owners: submit all jobs of a request or none, cancel, forget.

use core::cmp::Reverse;
use std::collections::HashMap;

use sqlx::{AssertSqlSafe, Error, Row};

use super::change::{Change, Ending, Standing};
use super::herald::News;
use super::row;
use crate::jobs::{Cancellation, Event, EventKind, Job, JobId, JobState, NewJob, Owner, Removal, Timestamp};

/// The outcome of a submission.
#[derive(Debug)]
pub(super) enum Submitted {
    /// The jobs of this request, new or from the first submission.
    Accepted(Vec<Job>),
    /// The queue is full.
    Full,
    /// The key belongs to a different request.
    KeyReused,
}

pub(super) async fn submit(change: &mut Change<'_>, jobs: &[NewJob], now: Timestamp) -> Result<Submitted, Error> {
    let Some(first) = jobs.first() else { return Ok(Submitted::Accepted(Vec::new())) };
    // One at a time: two at once would both find the key unknown and the last place free.
    if let Some(lock) = change.dialect().lock_submits() {
        sqlx::query(lock).execute(change.connection()).await?;
    }
    if let Some(submitted) = known(change, first).await? {
        return Ok(submitted);
    }
    let queued = sqlx::query("SELECT COUNT(*) AS queued FROM jobs WHERE state = 'queued'");
    let queued: usize = row::whole(&queued.fetch_one(change.connection()).await?, "queued")?;
    if queued.saturating_add(jobs.len()) > change.settings().max_queued {
        return Ok(Submitted::Full);
    }
    accept(change, jobs, now).await.map(Submitted::Accepted)
}

/// Queues all jobs, each with its turn.
async fn accept(change: &mut Change<'_>, jobs: &[NewJob], now: Timestamp) -> Result<Vec<Job>, Error> {
    let (mut turns, mut queue) = (HashMap::new(), Vec::with_capacity(jobs.len()));
    for (at, job) in jobs.iter().enumerate() {
        let turn = match turns.get(&(&job.owner, job.priority)) {
            Some(last) => last + 1,
            None => next_turn(change, job).await?,
        };
        turns.insert((&job.owner, job.priority), turn);
        queue.push((at, job, turn));
    }
    // Each event holds the job's place in the queue, so jobs ahead of it are inserted first.
    queue.sort_by_key(|(_, job, turn)| (Reverse(job.priority), *turn, job.id));
    let mut accepted = Vec::with_capacity(jobs.len());
    for (at, job, turn) in queue {
        accepted.push((at, insert(change, job, turn, now).await?));
        change.announce(News { queued: true, ..News::of(job.id) });
    }
    accepted.sort_by_key(|(at, _)| *at);
    Ok(accepted.into_iter().map(|(_, job)| job).collect())
}

/// The earlier submission with this key, if any.
async fn known(change: &mut Change<'_>, first: &NewJob) -> Result<Option<Submitted>, Error> {
    let Some((key, _)) = &first.key else { return Ok(None) };
    let query = sqlx::query(
        "SELECT id, request_sha256 FROM jobs WHERE owner = $1 AND idempotency_key = $2 ORDER BY key_position",
    );
    let rows = query.bind(first.owner.as_str()).bind(key.as_str()).fetch_all(change.connection()).await?;
    let Some(earliest) = rows.first() else { return Ok(None) };
    if earliest.try_get::<&str, _>("request_sha256")? != first.request_sha256 {
        return Ok(Some(Submitted::KeyReused));
    }
    let ids = rows.iter().map(row::id).collect::<Result<Vec<JobId>, Error>>()?;
    Ok(Some(Submitted::Accepted(row::find_all(change.connection(), &ids).await?)))
}

/// Fair queuing: the next turn is the owner's last queued turn of this priority + 1, but no less than the least queued
/// turn. So idle time earns no credit, and a thousand jobs of one owner don't delay the first of another.
async fn next_turn(change: &mut Change<'_>, job: &NewJob) -> Result<i64, Error> {
    let query = sqlx::query(
        "SELECT (SELECT MAX(turn) FROM jobs WHERE state = 'queued' AND owner = $1 AND priority = $2) AS own_last, \
         (SELECT MIN(turn) FROM jobs WHERE state = 'queued' AND priority = $2) AS up",
    );
    let query = query.bind(job.owner.as_str()).bind(job.priority);
    let row = query.fetch_one(change.connection()).await?;
    let after_own: Option<i64> = row.try_get::<Option<i64>, _>("own_last")?.map(|last| last + 1);
    let up: Option<i64> = row.try_get("up")?;
    Ok(after_own.max(up).unwrap_or(0))
}

/// Inserts the job.
async fn insert(change: &mut Change<'_>, job: &NewJob, turn: i64, now: Timestamp) -> Result<Job, Error> {
    let event = Event { kind: EventKind::Queued, at: now, attempts: 0, incumbent: None, queue_position: None };
    let expires_at = now.after(change.settings().ttl);
    let (key, position) = match &job.key {
        Some((key, position)) => (Some(key.as_str()), i64::from(*position)),
        None => (None, 0),
    };
    let text = format!(
        "INSERT INTO jobs (id, owner, idempotency_key, key_position, request_sha256, state, priority, turn, attempts, \
         fence, cancel_requested, created_at, expires_at, callback_url, callback_attempt, scene_sha256, scene_id, \
         events, body) VALUES ($1, $2, $3, $4, $5, 'queued', $6, $7, 0, 0, 0, $8, $9, $10, 0, $11, $12, \
         $13 || CAST({} AS TEXT) || '\n', $14) RETURNING events",
        row::place("$6", "$7", "$1"),
    );
    let row = sqlx::query(AssertSqlSafe(text))
        .bind(job.id.to_string())
        .bind(job.owner.as_str())
        .bind(key)
        .bind(position)
        .bind(job.request_sha256.as_str())
        .bind(job.priority)
        .bind(turn)
        .bind(now.as_millis())
        .bind(expires_at.as_millis())
        .bind(job.callback_url.as_deref().map(str::as_bytes))
        .bind(job.scene_sha256.as_str())
        .bind(job.scene_id.as_deref().map(str::as_bytes))
        .bind(row::up_to_the_place(&event))
        .bind(job.body.as_slice())
        .fetch_one(change.connection())
        .await?;
    let events = row::events(&row)?;
    Ok(Job {
        id: job.id,
        state: JobState::Queued,
        scene_id: job.scene_id.clone(),
        scene_sha256: job.scene_sha256.clone(),
        created_at: now,
        started_at: None,
        finished_at: None,
        expires_at,
        attempts: 0,
        queue_position: events.last().and_then(|event| event.queue_position),
        incumbent: None,
        result: None,
        problem: None,
        version: None,
        events,
    })
}

/// The owner's job; `None` for another owner's.
async fn own(change: &mut Change<'_>, owner: &Owner, id: JobId) -> Result<Option<Standing>, Error> {
    Ok(change.standing(id).await?.filter(|job| job.owner == *owner))
}

pub(super) async fn cancel(
    change: &mut Change<'_>,
    owner: &Owner,
    id: JobId,
    now: Timestamp,
) -> Result<Cancellation, Error> {
    let Some(job) = own(change, owner, id).await? else { return Ok(Cancellation::Unknown) };
    match job.state {
        JobState::Queued => change.end(&job, &Ending::bare(JobState::Cancelled), now).await?,
        JobState::Running => {
            let query = sqlx::query("UPDATE jobs SET cancel_requested = 1 WHERE id = $1").bind(id.to_string());
            query.execute(change.connection()).await?;
            change.announce(News { recall: true, ..News::of(id) });
        }
        _ => return Ok(Cancellation::Finished),
    }
    let job = row::find(change.connection(), Some(owner), id).await?.ok_or(Error::RowNotFound)?;
    Ok(Cancellation::Accepted(Box::new(job)))
}

pub(super) async fn forget(change: &mut Change<'_>, owner: &Owner, id: JobId) -> Result<Removal, Error> {
    let Some(job) = own(change, owner, id).await? else { return Ok(Removal::Unknown) };
    if !job.state.finished() {
        return Ok(Removal::Unfinished);
    }
    sqlx::query("DELETE FROM jobs WHERE id = $1").bind(id.to_string()).execute(change.connection()).await?;
    change.announce(News::of(id));
    Ok(Removal::Forgotten)
}
