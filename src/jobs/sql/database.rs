//! The database below all store calls: its connections, its timeout and its closing, and all that differs between SQLite
//! and PostgreSQL.

use core::time::Duration;
use std::borrow::Cow;

use sqlx::migrate::{Migration, MigrationType, Migrator};
use sqlx::pool::PoolConnection;
use sqlx::{Any, AnyPool, Error, Row, SqlSafeStr, Transaction, raw_sql};
use tokio::time::{Instant, sleep};
use tokio_util::task::TaskTracker;

use super::herald::Herald;
use crate::jobs::JobSettings;

/// The timeout of one store call is half a lease, so that a worker notices in time that its store is away, but no more than
/// this ...
const PATIENCE: Duration = Duration::from_secs(8);
/// ... and no less than this, even if a lease is shorter: some seconds are normal for a busy database.
const LEAST_PATIENCE: Duration = Duration::from_secs(3);

/// An open database with its tables.
pub(super) struct Database {
    pub(super) dialect: Dialect,
    pub(super) settings: JobSettings,
    /// For write transactions.
    pub(super) writers: AnyPool,
    /// For reads.
    pub(super) readers: AnyPool,
    /// Write transactions under way.
    pub(super) tasks: TaskTracker,
    pub(super) herald: Herald,
}

impl Database {
    /// Begins a write transaction. That may take seconds.
    pub(super) async fn begin(&self) -> Result<Transaction<'static, Any>, Error> {
        self.writers.begin_with(self.dialect.begin()).await
    }

    /// A connection for reads.
    pub(super) async fn reader(&self) -> Result<PoolConnection<Any>, Error> {
        self.readers.acquire().await
    }

    /// Timeout of one call.
    pub(super) fn patience(&self) -> Duration {
        (self.settings.lease / 2).clamp(LEAST_PATIENCE, PATIENCE)
    }

    /// Closes the database. SQLite checkpoints its log when the last connection is closed, but does not report failure.
    /// So a checkpoint is requested before that, once all reads and writes here are done. False if it failed.
    pub(super) async fn close(&self) -> Result<bool, Error> {
        self.tasks.close();
        self.tasks.wait().await;
        self.readers.close().await;
        // In memory, readers and writers share one pool.
        let emptied = match self.dialect {
            Dialect::Sqlite if !self.writers.is_closed() => empty_log(&self.writers).await,
            _ => Ok(true),
        };
        self.writers.close().await;
        emptied
    }
}

/// The kind of database.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Dialect {
    /// One file, or memory.
    Sqlite,
    /// A server shared by many.
    Postgres,
}

impl Dialect {
    /// Begins a write transaction. SQLite has one writer at a time, so it takes the write lock at once: a reader that
    /// turns writer could be refused.
    pub(super) fn begin(self) -> &'static str {
        match self {
            Self::Sqlite => "BEGIN IMMEDIATE",
            Self::Postgres => "BEGIN",
        }
    }

    /// Suffix of a query: locks these rows until the transaction ends. SQLite's writer is alone.
    pub(super) fn locked(self) -> &'static str {
        match self {
            Self::Sqlite => "",
            Self::Postgres => " FOR UPDATE",
        }
    }

    /// The same, but skips rows that are locked by others.
    pub(super) fn locked_if_free(self) -> &'static str {
        match self {
            Self::Sqlite => "",
            Self::Postgres => " FOR UPDATE SKIP LOCKED",
        }
    }

    /// Serialises submissions until the transaction ends. The lock's id is the table's number.
    pub(super) fn lock_submits(self) -> Option<&'static str> {
        match self {
            Self::Sqlite => None,
            Self::Postgres => Some("SELECT pg_advisory_xact_lock('jobs'::regclass::oid::bigint)"),
        }
    }

    /// The schema migrations. A published one never changes.
    pub(super) fn migrations(self) -> Migrator {
        let first = match self {
            Self::Sqlite => include_str!("migrations/sqlite_1_jobs.sql"),
            Self::Postgres => include_str!("migrations/postgres_1_jobs.sql"),
        };
        let first = Migration::new(1, Cow::Borrowed("jobs"), MigrationType::Simple, first.into_sql_str(), false);
        Migrator::with_migrations(vec![first])
    }
}

/// How long processes that open a SQLite file at the same time may block us.
const OPENING: Duration = Duration::from_secs(30);

/// Switches a SQLite file to the write-ahead log. The file remembers it, so it happens once. Retries if another process blocks it:
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

/// True if another process has the SQLite file open. SQLite keeps a shared lock on each open file, and the system frees the
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

/// Checkpoints the log into the SQLite file. False if a reader still needs the old state.
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
