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

/// Whether another process has the file open. SQLite keeps a shared lock on each file that it has open, and the system frees
/// the locks of a process that crashes. So the exclusive lock is granted exactly if nobody else is there; it is released at
/// once. Of two processes that ask at the same time, at least one hears of the other.
///
/// The connection that writes must be the only one of this process. If the lock was refused, the connection has to be
/// replaced: some versions of SQLite keep a pending lock then, which shuts out newcomers.
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

/// All that is in the log goes into the file. False if it can't, since somebody reads what it was before.
pub(super) async fn empty_log(writers: &AnyPool) -> Result<bool, Error> {
    let mut connection = writers.acquire().await?;
    // Whoever reads for longer is not waited for.
    raw_sql("PRAGMA busy_timeout = 1000").execute(&mut *connection).await?;
    let row = sqlx::query("PRAGMA wal_checkpoint(TRUNCATE)").fetch_one(&mut *connection).await?;
    Ok(row.try_get::<i64, _>("busy")? == 0)
}

fn locked(error: &Error) -> bool {
    error.as_database_error().is_some_and(|error| error.message().contains("locked"))
}
