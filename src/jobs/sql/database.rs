//! The database below every question: its connections, how long it may take to answer, and how it is closed.

use core::time::Duration;

use sqlx::pool::PoolConnection;
use sqlx::{Any, AnyPool, Error, Transaction};
use tokio_util::task::TaskTracker;

use super::dialect::Dialect;
use super::file;
use super::herald::Herald;
use crate::jobs::JobSettings;

/// How long the database may take, and where half a lease is less, that: a worker must hear in time that its store is away.
/// But a database may well take some seconds now and then.
const PATIENCE: Duration = Duration::from_secs(8);
const LEAST_PATIENCE: Duration = Duration::from_secs(3);

/// An open database with its tables.
pub(super) struct Database {
    pub(super) dialect: Dialect,
    pub(super) settings: JobSettings,
    /// For what changes something.
    pub(super) writers: AnyPool,
    /// For what only looks.
    pub(super) readers: AnyPool,
    /// What is written just now.
    pub(super) tasks: TaskTracker,
    pub(super) herald: Herald,
}

impl Database {
    /// Begins a transaction that writes. That may take seconds.
    pub(super) async fn begin(&self) -> Result<Transaction<'static, Any>, Error> {
        self.writers.begin_with(self.dialect.begin()).await
    }

    /// A connection that only looks.
    pub(super) async fn reader(&self) -> Result<PoolConnection<Any>, Error> {
        self.readers.acquire().await
    }

    /// How long a caller waits for an answer.
    pub(super) fn patience(&self) -> Duration {
        (self.settings.lease / 2).clamp(LEAST_PATIENCE, PATIENCE)
    }

    /// SQLite empties its log into the file when the last connection is closed, but does not say whether it could. So it is
    /// asked to before that, once nobody here reads or writes any more. False if it could not.
    pub(super) async fn close(&self) -> Result<bool, Error> {
        self.tasks.close();
        self.tasks.wait().await;
        self.readers.close().await;
        // In memory, readers and writers are one pool.
        let emptied = match self.dialect {
            Dialect::Sqlite if !self.writers.is_closed() => file::empty_log(&self.writers).await,
            _ => Ok(true),
        };
        self.writers.close().await;
        emptied
    }
}
