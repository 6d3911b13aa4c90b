//! What is special about a SQLite file: its write-ahead log, and that other processes may have it open.

use core::time::Duration;

use sqlx::{AnyPool, Error, Row, raw_sql};
use tokio::time::{Instant, sleep};

/// How long other processes that open the same file at the same time may keep us from it.
const OPENING: Duration = Duration::from_secs(30);

/// The file remembers it, so it happens once. Whoever is refused because another process is at it tries again: SQLite
/// does not wait for this lock by itself.
pub(super) async fn use_write_ahead_log(writers: &AnyPool) -> Result<(), Error> {
    let begin = Instant::now();
    loop {
        match sqlx::query("PRAGMA journal_mode = WAL").fetch_one(writers).await {
            Err(error) if locked(&error) && begin.elapsed() < OPENING => sleep(Duration::from_millis(20)).await,
            answer => return answer.and_then(|row| row.try_get::<String, _>(0)).map(drop),
        }
    }
}

/// Whether another process has the file open. SQLite holds a shared lock of the system's on every file that it has open, and
/// whoever crashes holds none; so the exclusive lock can be had exactly if nobody else is there. It is given back at once.
/// Of two that ask at the same time, at least one is told of the other.
///
/// Our only connection must be the one that writes. Where the lock was refused, it is to be replaced: some versions of
/// SQLite leave a half-taken lock behind, which keeps newcomers out.
pub(super) async fn is_shared(writers: &AnyPool) -> Result<bool, Error> {
    let mut connection = writers.acquire().await?;
    // The log has to be in use before: a log that is first used under the exclusive lock is never shared again.
    let mut execute = async |statements: &'static str| raw_sql(statements).execute(&mut *connection).await;
    execute("PRAGMA busy_timeout = 0; SELECT COUNT(*) FROM sqlite_schema; PRAGMA locking_mode = EXCLUSIVE").await?;
    let begun = execute("BEGIN IMMEDIATE").await;
    execute("PRAGMA locking_mode = NORMAL").await?;
    match begun {
        Ok(_) => execute("COMMIT; PRAGMA busy_timeout = 5000").await.map(|_| false),
        Err(error) if locked(&error) => Ok(true),
        Err(error) => Err(error),
    }
}

/// All that is in the log goes into the file.
pub(super) async fn empty_log(writers: &AnyPool) -> Result<(), Error> {
    let mut connection = writers.acquire().await?;
    // Whoever reads for longer is not waited for.
    raw_sql("PRAGMA busy_timeout = 1000").execute(&mut *connection).await?;
    let row = sqlx::query("PRAGMA wal_checkpoint(TRUNCATE)").fetch_one(&mut *connection).await?;
    match row.try_get::<i64, _>("busy")? {
        0 => Ok(()),
        _ => Err(Error::Protocol(
            "another process reads the file: part of it is still in the one beside it, -wal".to_owned(),
        )),
    }
}

fn locked(error: &Error) -> bool {
    error.as_database_error().is_some_and(|error| error.message().contains("locked"))
}
