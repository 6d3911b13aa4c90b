//! The database below all store calls: its connections, its timeout and its closing.

use core::time::Duration;

use sqlx::pool::PoolConnection;
use sqlx::{Any, AnyPool, Error, Transaction};
use tokio_util::task::TaskTracker;

use super::dialect::Dialect;
use super::file;
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
            Dialect::Sqlite if !self.writers.is_closed() => file::empty_log(&self.writers).await,
            _ => Ok(true),
        };
        self.writers.close().await;
        emptied
    }
}
