//! Store calls under a lease: workers claim, renew, note, finish and hand back jobs; callbacks are taken and settled.

use core::time::Duration;

use sqlx::{AssertSqlSafe, Error, Row};

use super::call::Decision;
use super::change::{Change, Ending, STANDING, Standing};
use super::database::Database;
use super::herald::News;
use super::row;
use crate::jobs::{
    Callback, Claim, Claimed, Delivery, End, EventKind, JobId, JobState, MAX_INCUMBENT_EVENTS, Renewal, Timestamp,
    WallClock,
};
use singulate_planner::cost::Cost;
use singulate_planner::search::Incumbent;

/// The lease begins once the job is locked by us, since the lock may take time.
pub(super) async fn claim(change: &mut Change<'_>, clock: &WallClock) -> Result<Option<Claimed>, Error> {
    let text = format!(
        "{STANDING} WHERE state = 'queued' AND expires_at > $1 ORDER BY priority DESC, turn, id LIMIT 1{}",
        change.dialect().locked_if_free()
    );
    let query = sqlx::query(AssertSqlSafe(text)).bind(clock.now().as_millis());
    let Some(next) = query.fetch_optional(change.connection()).await? else { return Ok(None) };
    let (job, now) = (Standing::read(&next)?, clock.now());
    let attempt = job.attempts + 1;
    let query = sqlx::query(
        "UPDATE jobs SET state = 'running', attempts = $2, fence = $3, started_at = $4, lease_ends = $5, \
         events = events || $6 WHERE id = $1 RETURNING body, created_at",
    );
    let row = query
        .bind(job.id.to_string())
        .bind(i64::from(attempt))
        .bind(job.fence + 1)
        .bind(now.as_millis())
        .bind(now.after(change.settings().lease).as_millis())
        .bind(job.line(EventKind::Running, attempt, now))
        .fetch_one(change.connection())
        .await?;
    change.announce(News::of(job.id));
    Ok(Some(Claimed {
        claim: Claim { id: job.id, fence: job.fence + 1 },
        owner: job.owner,
        body: row.try_get("body")?,
        attempt,
        created_at: row::time(&row, "created_at")?,
    }))
}

/// The lease begins once the job is locked, as in [`claim`].
pub(super) async fn renew(change: &mut Change<'_>, claim: Claim, clock: &WallClock) -> Result<Renewal, Error> {
    let Some(job) = change.standing(claim.id).await?.filter(|job| job.held_by(claim)) else {
        return Ok(Renewal::Lost);
    };
    let query = sqlx::query("UPDATE jobs SET lease_ends = $2 WHERE id = $1").bind(claim.id.to_string());
    let query = query.bind(clock.now().after(change.settings().lease).as_millis());
    query.execute(change.connection()).await?;
    Ok(if job.cancel_requested { Renewal::Cancelled } else { Renewal::Held })
}

/// A second attempt searches anew, so its incumbent may be worse than the stored one.
pub(super) async fn note(
    change: &mut Change<'_>,
    claim: Claim,
    incumbent: Incumbent,
    now: Timestamp,
) -> Result<bool, Error> {
    let Some(job) = change.standing(claim.id).await?.filter(|job| job.held_by(claim)) else { return Ok(false) };
    let best = job.incumbent.map_or(incumbent, |known| Incumbent {
        cost: known.cost.min(incumbent.cost),
        lower_bound: known.lower_bound.max(incumbent.lower_bound),
    });
    if job.incumbent == Some(best) {
        return Ok(true);
    }
    let id = claim.id.to_string();
    let query = sqlx::query("SELECT events FROM jobs WHERE id = $1").bind(id.as_str());
    let lines: String = query.fetch_one(change.connection()).await?.try_get("events")?;
    let told = row::read_events(&lines).unwrap_or_default();
    let room = told.iter().filter(|event| event.kind == EventKind::Incumbent).count() < MAX_INCUMBENT_EVENTS;
    let job = Standing { incumbent: Some(best), ..job };
    let line = if room { job.line(EventKind::Incumbent, job.attempts, now) } else { String::new() };
    let query = sqlx::query("UPDATE jobs SET cost = $2, lower_bound = $3, events = events || $4 WHERE id = $1");
    let number = |cost: Cost| i64::try_from(cost.get()).unwrap_or(i64::MAX);
    let query = query.bind(id).bind(number(best.cost)).bind(number(best.lower_bound)).bind(line);
    query.execute(change.connection()).await?;
    change.announce(News::of(job.id));
    Ok(true)
}

pub(super) async fn finish(change: &mut Change<'_>, claim: Claim, end: &End, now: Timestamp) -> Result<bool, Error> {
    let Some(job) = change.standing(claim.id).await? else { return Ok(false) };
    if !job.held_by(claim) {
        return Ok(job.ended_by == Some(claim.fence));
    }
    let by = Some(claim.fence);
    let ending = match end {
        // A cancelled job has no problem, even if its plan failed.
        End::Failed(_) if job.cancel_requested => Ending { by, ..Ending::bare(JobState::Cancelled) },
        _ if job.cancel_requested => Ending::new(JobState::Cancelled, end, by),
        End::Succeeded(_) => Ending::new(JobState::Succeeded, end, by),
        End::Failed(_) => Ending::new(JobState::Failed, end, by),
    };
    change.end(&job, &ending, now).await?;
    Ok(true)
}

/// A cancelled job ends instead of being queued again.
pub(super) async fn hand_back(change: &mut Change<'_>, claim: Claim, now: Timestamp) -> Result<bool, Error> {
    let Some(job) = change.standing(claim.id).await?.filter(|job| job.held_by(claim)) else { return Ok(false) };
    if job.cancel_requested {
        change.end(&job, &Ending::bare(JobState::Cancelled), now).await?;
    } else {
        change.requeue(&job, job.attempts.saturating_sub(1), now).await?;
    }
    Ok(true)
}

/// Hands back a claim that nobody received.
pub(super) async fn give_back(database: &Database, claim: Claim, now: Timestamp) -> Result<(), Error> {
    let mut change = Change::begin(database, Decision::default()).await?;
    hand_back(&mut change, claim, now).await?;
    change.commit().await
}

/// A callback is due from the end of its job until it is settled. The lease begins once it is locked, as in [`claim`].
pub(super) async fn take_callback(
    change: &mut Change<'_>,
    lease: Duration,
    clock: &WallClock,
) -> Result<Option<Callback>, Error> {
    let text = format!(
        "SELECT id, callback_url, callback_attempt FROM jobs WHERE callback_due <= $1 ORDER BY callback_due LIMIT 1{}",
        change.dialect().locked_if_free()
    );
    let query = sqlx::query(AssertSqlSafe(text)).bind(clock.now().as_millis());
    let Some(due) = query.fetch_optional(change.connection()).await? else { return Ok(None) };
    let id = row::id(&due)?;
    let attempt = row::whole::<u32>(&due, "callback_attempt")? + 1;
    let query = sqlx::query("UPDATE jobs SET callback_due = $2, callback_attempt = $3 WHERE id = $1");
    let query = query.bind(id.to_string()).bind(clock.now().after(lease).as_millis()).bind(i64::from(attempt));
    query.execute(change.connection()).await?;
    let url = String::from_utf8(due.try_get("callback_url")?).map_err(|error| Error::Decode(error.into()))?;
    let job = row::find(change.connection(), None, id).await?.ok_or(Error::RowNotFound)?;
    Ok(Some(Callback { job, url, attempt }))
}

/// Only the latest try is settled: the lease of an older one is over.
pub(super) async fn settle_callback(
    change: &mut Change<'_>,
    id: JobId,
    attempt: u32,
    delivery: Delivery,
) -> Result<(), Error> {
    let due = match delivery {
        Delivery::Over => None,
        Delivery::Again(at) => Some(at.as_millis()),
    };
    let query = sqlx::query(
        "UPDATE jobs SET callback_due = $3 WHERE id = $1 AND callback_attempt = $2 AND callback_due IS NOT NULL",
    );
    let query = query.bind(id.to_string()).bind(i64::from(attempt)).bind(due);
    query.execute(change.connection()).await.map(drop)
}

/// Undoes a claim that nobody received: the callback is due at once, and the try does not count.
pub(super) async fn give_back_callback(
    database: &Database,
    id: JobId,
    attempt: u32,
    now: Timestamp,
) -> Result<(), Error> {
    let mut change = Change::begin(database, Decision::default()).await?;
    let query = sqlx::query(
        "UPDATE jobs SET callback_due = $3, callback_attempt = callback_attempt - 1 \
         WHERE id = $1 AND callback_attempt = $2 AND callback_due IS NOT NULL",
    );
    let query = query.bind(id.to_string()).bind(i64::from(attempt)).bind(now.as_millis());
    query.execute(change.connection()).await?;
    change.announce(News { callback: true, ..News::of(id) });
    change.commit().await
}
