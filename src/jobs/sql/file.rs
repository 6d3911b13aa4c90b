//! SQLite files: the write-ahead log, and other processes that have the file open.

use core::time::Duration;

use sqlx::{AnyPool, Error, Row, raw_sql};
use tokio::time::{Instant, sleep};

/// How long processes that open the file at the same time may block us.
const OPENING: Duration = Duration::from_secs(30);

/// Switches to the write-ahead log. The file remembers it, so it happens once. Retries if another process blocks it:
/// SQLite does not wait for this lock by itself.
pub(super) async fn use_write_ahead_log(writers: &AnyPool) -> Result<(), Error> {
    let begin = Instant::now();
    loop {
        match sqlx::query("PRAGMA journal_mode = WAL").fetch_one(writers).await {
            Err(error) if locked(&error) && begin.elapsed() < OPENING => sleep(Duration::from_millis(20)).await,
            answer => return answer.and_then(|row| row.try_get::<String, _>(0)).map(drop),
        }
    }
}

/// True if another process has the file open. SQLite keeps a shared lock on each open file, and the system frees the
/// locks of a crashed process. So the exclusive lock is granted exactly if no other process is there; it is released at
/// once. Of two processes that ask at the same time, at least one sees the other.
///
/// The writing connection must be the only one of this process. If the lock was refused, replace the connection: some
/// versions of SQLite then keep a pending lock, which shuts out newcomers.
pub(super) async fn is_shared(writers: &AnyPool) -> Result<bool, Error> {
    let mut connection = writers.acquire().await?;
    // The SELECT opens the log. A log that is first opened in exclusive mode can't leave that mode.
    let mut execute = async |statements: &'static str| raw_sql(statements).execute(&mut *connection).await;
    execute("SELECT COUNT(*) FROM sqlite_schema; PRAGMA busy_timeout = 0; PRAGMA locking_mode = EXCLUSIVE").await?;
    let begun = execute("BEGIN IMMEDIATE").await;
    execute("PRAGMA locking_mode = NORMAL").await?;
    match begun {
        Ok(_) => execute("COMMIT; PRAGMA busy_timeout = 5000").await.map(|_| false),
        Err(error) if locked(&error) => Ok(true),
        Err(error) => Err(error),
    }
}

/// Checkpoints the log into the file. False if a reader still needs the old state.
pub(super) async fn empty_log(writers: &AnyPool) -> Result<bool, Error> {
    let mut connection = writers.acquire().await?;
    // Longer readers are not waited for.
    raw_sql("PRAGMA busy_timeout = 1000").execute(&mut *connection).await?;
    let row = sqlx::query("PRAGMA wal_checkpoint(TRUNCATE)").fetch_one(&mut *connection).await?;
    Ok(row.try_get::<i64, _>("busy")? == 0)
}

fn locked(error: &Error) -> bool {
    error.as_database_error().is_some_and(|error| error.message().contains("locked"))
}
