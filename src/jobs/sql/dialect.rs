//! The differences between SQLite and PostgreSQL.

use std::borrow::Cow;

use sqlx::SqlSafeStr;
use sqlx::migrate::{Migration, MigrationType, Migrator};

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
