//! Store calls of callbacks: a callback is due from the end of its job until it is settled.

use core::time::Duration;

use sqlx::{AssertSqlSafe, Error, Row};

use super::call::Decision;
use super::change::Change;
use super::database::Database;
use super::herald::News;
use super::row;
use crate::jobs::{Callback, Delivery, JobId, Timestamp, WallClock};

/// The lease begins once the callback is locked by us, since the lock may take time.
pub(super) async fn take(
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
pub(super) async fn settle(change: &mut Change<'_>, id: JobId, attempt: u32, delivery: Delivery) -> Result<(), Error> {
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
pub(super) async fn give_back(database: &Database, id: JobId, attempt: u32, now: Timestamp) -> Result<(), Error> {
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
