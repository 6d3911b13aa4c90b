//! Opens the store at an address: connects, migrates, listens.

use core::time::Duration;
use std::sync::{Arc, Once};

use sqlx::any::{AnyConnectOptions, AnyPoolOptions, install_default_drivers};
use sqlx::migrate::MigrateError;
use sqlx::{AnyConnection, AnyPool, ConnectOptions, Connection, Error};
use tokio_util::task::TaskTracker;

use super::database::{Database, Dialect, is_shared, use_write_ahead_log};
use super::herald::Herald;
use super::store::SqlStore;
use crate::jobs::{JobSettings, Store};
use crate::metrics::Metrics;

/// Read connections of a file. They never wait for the writer; a few keep long lists from delaying short reads.
const SQLITE_READERS: u32 = 4;
/// Writers of a file queue here, and at the file's lock only for other processes. An fsync of a slow disk takes 50 ms,
/// and a hundred may wait.
const SQLITE_WAIT: Duration = Duration::from_secs(5);
/// Enough to keep a database busy whose commits wait for a disk; many servers share its hundred connections.
const POSTGRES_CONNECTIONS: u32 = 8;
/// How long a database may be away before a caller gets an error.
const POSTGRES_WAIT: Duration = Duration::from_secs(2);
/// Queries are answered in milliseconds. Slower ones fail, including those that wait for a lock. A server that vanishes
/// within a transaction no longer blocks others either.
const POSTGRES_LIMITS: &str = "SET statement_timeout = '5s'; SET idle_in_transaction_session_timeout = '5s'";

/// Why the store can't be opened.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("--jobs-url: {0}")]
pub struct OpenError(String);

/// The store at the settings' address. The first process creates or migrates its tables.
///
/// # Errors
/// [`OpenError`] if the address is invalid or the database unusable.
pub async fn open(settings: &JobSettings, metrics: Arc<Metrics>) -> Result<Arc<dyn Store>, OpenError> {
    static DRIVERS: Once = Once::new();
    DRIVERS.call_once(install_default_drivers);
    let url = settings.url.as_str();
    let database = if url.starts_with("sqlite:") {
        sqlite(settings).await.map_err(|error| {
            OpenError(format!(
                "no jobs can be kept in '{url}': {error}; its folder must exist, and file and folder must be writable"
            ))
        })?
    } else if url.starts_with("postgres://") || url.starts_with("postgresql://") {
        // The address may hold a password.
        postgres(settings).await.map_err(|error| OpenError(format!("no jobs can be kept in PostgreSQL: {error}")))?
    } else {
        return Err(OpenError(
            "not an address like sqlite:PATH, sqlite::memory: or postgres://HOST/DATABASE".to_owned(),
        ));
    };
    Ok(Arc::new(SqlStore::new(database, metrics)))
}

async fn sqlite(settings: &JobSettings) -> Result<Database, Error> {
    let memory = settings.url.starts_with("sqlite::memory:");
    let path =
        settings.url.trim_start_matches("sqlite:").trim_start_matches("//").split('?').next().unwrap_or_default();
    if path.is_empty() || (!memory && settings.url.contains("mode=memory")) {
        // SQLite would make one database per connection, which ends with it.
        return Err(Error::Configuration("it names no file".into()));
    }
    let created = if settings.url.contains('?') { "&mode=rwc" } else { "?mode=rwc" };
    let url =
        if memory || settings.url.contains("mode=") { settings.url.clone() } else { settings.url.clone() + created };
    let options = url.parse::<AnyConnectOptions>()?.disable_statement_logging();
    // These connections are never closed: the data in memory would be lost.
    let pool = AnyPoolOptions::new().acquire_timeout(SQLITE_WAIT).idle_timeout(None).max_lifetime(None);
    // A full disk ends a transaction behind the driver's back, and the driver's count stays one too high.
    let pool = pool.before_acquire(|connection, _| Box::pin(async move { Ok(!connection.is_in_transaction()) }));
    let writing = "PRAGMA busy_timeout = 5000; PRAGMA synchronous = FULL";
    let reading = "PRAGMA busy_timeout = 5000; PRAGMA query_only = ON";
    let one = on_connect(pool.clone().max_connections(1), writing);
    let writers = match memory {
        true => one.connect_with(options.clone()).await?,
        false => writers_of_file(one, options.clone(), path).await?,
    };
    // In one transaction: of two processes that start at once, one makes the tables and the other finds them.
    let mut transaction = writers.begin_with(Dialect::Sqlite.begin()).await?;
    migrate(&mut transaction, Dialect::Sqlite).await?;
    // SQLite opens read-only files too, and fails only at the first write.
    sqlx::query("DELETE FROM jobs WHERE id = ''").execute(&mut *transaction).await?;
    transaction.commit().await?;
    let readers = match memory {
        true => writers.clone(),
        false => on_connect(pool.max_connections(SQLITE_READERS), reading).connect_with(options).await?,
    };
    let (dialect, settings, herald) = (Dialect::Sqlite, settings.clone(), Herald::alone());
    Ok(Database { dialect, settings, writers, readers, tasks: TaskTracker::new(), herald })
}

/// The write connection of a file with a write-ahead log. It is replaced if another process has the file open.
async fn writers_of_file(pool: AnyPoolOptions, options: AnyConnectOptions, path: &str) -> Result<AnyPool, Error> {
    let writers = pool.clone().connect_with(options.clone()).await?;
    use_write_ahead_log(&writers).await?;
    if !is_shared(&writers).await? {
        return Ok(writers);
    }
    tracing::warn!(file = path, "another process has this file open; if it is a server, both serve the same jobs");
    writers.close().await;
    pool.connect_with(options).await
}

async fn postgres(settings: &JobSettings) -> Result<Database, Error> {
    let options = settings.url.parse::<AnyConnectOptions>()?.disable_statement_logging();
    let pool = AnyPoolOptions::new().acquire_timeout(POSTGRES_WAIT).max_connections(POSTGRES_CONNECTIONS);
    // Without timeouts: migrations may take time, and so may another server that runs them.
    let mut connection = options.connect().await?;
    migrate(&mut connection, Dialect::Postgres).await?;
    connection.close().await?;
    let pool = on_connect(pool, POSTGRES_LIMITS).connect_with(options).await?;
    let herald = Herald::among_others(&settings.url, &pool).await?;
    let (dialect, settings, readers) = (Dialect::Postgres, settings.clone(), pool.clone());
    Ok(Database { dialect, settings, writers: pool, readers, tasks: TaskTracker::new(), herald })
}

/// Runs these statements on each new connection.
fn on_connect(pool: AnyPoolOptions, statements: &'static str) -> AnyPoolOptions {
    pool.after_connect(move |connection, _| {
        Box::pin(async move { sqlx::raw_sql(statements).execute(connection).await.map(drop) })
    })
}

/// Runs the migrations, under PostgreSQL's migration lock; SQLite has none.
async fn migrate(connection: &mut AnyConnection, dialect: Dialect) -> Result<(), Error> {
    dialect.migrations().run_direct(None, connection, false).await.map_err(|error| match error {
        MigrateError::Execute(error) => error,
        other => Error::Configuration(other.into()),
    })
}
