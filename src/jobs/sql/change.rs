//! One write transaction, and two transitions that a job can make in it: it ends, or is queued again.

use core::cmp::Reverse;

use sqlx::any::AnyRow;
use sqlx::{Any, AnyConnection, AssertSqlSafe, Error, Row, Transaction};

use super::call::Decision;
use super::database::{Database, Dialect};
use super::herald::News;
use super::row;
use crate::jobs::{Claim, End, Event, EventKind, JobId, JobSettings, JobState, Owner, Timestamp};
use singulate_planner::search::Incumbent;

/// The columns read before a job is changed.
pub(super) const STANDING: &str = "SELECT id, owner, state, attempts, fence, cancel_requested, ended_by, cost, lower_bound, \
    priority, turn, CASE WHEN callback_url IS NULL THEN 0 ELSE 1 END AS has_callback FROM jobs";

/// A job before a change.
#[derive(Debug)]
pub(super) struct Standing {
    pub(super) id: JobId,
    pub(super) owner: Owner,
    pub(super) state: JobState,
    pub(super) attempts: u32,
    pub(super) fence: i64,
    pub(super) cancel_requested: bool,
    /// The fence of the claim that ended it.
    pub(super) ended_by: Option<i64>,
    pub(super) incumbent: Option<Incumbent>,
    pub(super) priority: i64,
    pub(super) turn: i64,
    /// True if it has a callback.
    pub(super) has_callback: bool,
}

impl Standing {
    pub(super) fn read(row: &AnyRow) -> Result<Self, Error> {
        Ok(Self {
            id: row::id(row)?,
            owner: Owner::named(row.try_get::<String, _>("owner")?),
            state: row::state(row)?,
            attempts: row::whole(row, "attempts")?,
            fence: row.try_get("fence")?,
            cancel_requested: row.try_get::<i64, _>("cancel_requested")? != 0,
            ended_by: row.try_get("ended_by")?,
            incumbent: row::incumbent(row)?,
            priority: row.try_get("priority")?,
            turn: row.try_get("turn")?,
            has_callback: row.try_get::<i64, _>("has_callback")? != 0,
        })
    }

    /// True if this claim holds the job.
    pub(super) fn held_by(&self, claim: Claim) -> bool {
        self.state == JobState::Running && self.fence == claim.fence
    }

    /// Jobs are claimed in ascending order of this key.
    pub(super) fn order(&self) -> impl Ord + use<> {
        (Reverse(self.priority), self.turn, self.id)
    }

    /// The event line of a change that happens now.
    pub(super) fn line(&self, kind: EventKind, attempts: u32, now: Timestamp) -> String {
        row::line(&self.event(kind, attempts, now))
    }

    fn event(&self, kind: EventKind, attempts: u32, now: Timestamp) -> Event {
        Event { kind, at: now, attempts, incumbent: self.incumbent, queue_position: None }
    }
}

/// The end of a job: state and content.
#[derive(Debug)]
pub(super) struct Ending<'a> {
    pub(super) state: JobState,
    pub(super) result: Option<&'a str>,
    pub(super) problem: Option<&'a str>,
    /// The fence of the claim that ends it.
    pub(super) by: Option<i64>,
}

impl<'a> Ending<'a> {
    /// This state, with the answer or the problem of `end`.
    pub(super) fn new(state: JobState, end: &'a End, by: Option<i64>) -> Self {
        match end {
            End::Succeeded(result) => Self { state, result: Some(result), problem: None, by },
            End::Failed(problem) => Self { state, result: None, problem: Some(problem), by },
        }
    }

    /// This state, without an answer or a problem.
    pub(super) fn bare(state: JobState) -> Self {
        Self { state, result: None, problem: None, by: None }
    }
}

/// A write transaction. Dropped without [`Self::commit`], it is rolled back.
pub(super) struct Change<'a> {
    database: &'a Database,
    transaction: Transaction<'static, Any>,
    decision: Decision,
    news: Vec<News>,
}

impl<'a> Change<'a> {
    /// Begins a transaction. That may take seconds; the caller may have given up by then.
    pub(super) async fn begin(database: &'a Database, decision: Decision) -> Result<Self, Error> {
        let transaction = database.begin().await?;
        decision.open()?;
        Ok(Self { database, transaction, decision, news: Vec::new() })
    }

    /// Commits and wakes the waiting tasks; if the caller has given up, rolls back.
    pub(super) async fn commit(self) -> Result<(), Error> {
        self.decision.commit()?;
        self.transaction.commit().await?;
        self.database.herald.announce(&self.news);
        Ok(())
    }

    pub(super) fn connection(&mut self) -> &mut AnyConnection {
        &mut self.transaction
    }

    pub(super) fn dialect(&self) -> Dialect {
        self.database.dialect
    }

    pub(super) fn settings(&self) -> &'a JobSettings {
        &self.database.settings
    }

    /// Announces the change after the commit.
    pub(super) fn announce(&mut self, news: News) {
        self.news.push(news);
    }

    /// The job before a change, locked until the transaction ends.
    pub(super) async fn standing(&mut self, id: JobId) -> Result<Option<Standing>, Error> {
        let text = format!("{STANDING} WHERE id = $1{}", self.dialect().locked());
        let query = sqlx::query(AssertSqlSafe(text)).bind(id.to_string());
        query.fetch_optional(self.connection()).await?.as_ref().map(Standing::read).transpose()
    }

    /// Ends the job and deletes its request, which is not needed any more.
    pub(super) async fn end(&mut self, job: &Standing, ending: &Ending<'_>, now: Timestamp) -> Result<(), Error> {
        let query = sqlx::query(
            "UPDATE jobs SET state = $2, finished_at = $3, expires_at = $4, result = $5, problem = $6, ended_by = $7, \
             version = $8, events = events || $9, callback_due = CASE WHEN callback_url IS NULL THEN NULL ELSE $3 END, \
             lease_ends = NULL, body = NULL WHERE id = $1",
        );
        query
            .bind(job.id.to_string())
            .bind(ending.state.as_str())
            .bind(now.as_millis())
            .bind(now.after(self.settings().ttl).as_millis())
            .bind(ending.result)
            .bind(ending.problem)
            .bind(ending.by)
            .bind(env!("CARGO_PKG_VERSION"))
            .bind(job.line(EventKind::Finished, job.attempts, now))
            .execute(self.connection())
            .await?;
        // A worker that ends its own job needs no recall.
        let recall = ending.by.is_none();
        self.announce(News { callback: job.has_callback, recall, ..News::of(job.id) });
        Ok(())
    }

    /// Queues the job again, at its old place.
    pub(super) async fn requeue(&mut self, job: &Standing, attempts: u32, now: Timestamp) -> Result<(), Error> {
        let text = format!(
            "UPDATE jobs SET state = 'queued', attempts = $2, events = events || $3 || CAST({} AS TEXT) || '\n', lease_ends = NULL, \
             started_at = CASE WHEN $2 = 0 THEN NULL ELSE started_at END WHERE id = $1",
            row::place("jobs.priority", "jobs.turn", "jobs.id"),
        );
        sqlx::query(AssertSqlSafe(text))
            .bind(job.id.to_string())
            .bind(i64::from(attempts))
            .bind(row::up_to_the_place(&job.event(EventKind::Queued, attempts, now)))
            .execute(self.connection())
            .await?;
        self.announce(News { queued: true, recall: true, ..News::of(job.id) });
        Ok(())
    }
}
