//! Where the servers of one test keep their jobs.

use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

use sqlx::{AssertSqlSafe, Connection, PgConnection};
use tokio::sync::{Mutex, MutexGuard};

static DATABASES: AtomicUsize = AtomicUsize::new(0);
/// Of the tests with PostgreSQL one at a time: one of them takes it away.
static POSTGRES: Mutex<()> = Mutex::const_new(());

/// Gone with its test.
pub(crate) struct Database {
    pub(crate) url: String,
    place: Place,
}

enum Place {
    Folder(PathBuf),
    Schema { base: String, name: String, _alone: MutexGuard<'static, ()> },
}

fn name() -> String {
    format!("singulate_fleet_{}_{}", std::process::id(), DATABASES.fetch_add(1, Ordering::Relaxed))
}

impl Database {
    pub(crate) fn in_a_file() -> Self {
        let folder = std::env::temp_dir().join(name());
        std::fs::create_dir(&folder).unwrap();
        let url = format!("sqlite:{}", folder.join("jobs.db").display());
        Self { url, place: Place::Folder(folder) }
    }

    /// Nothing where there is no PostgreSQL to test with. One that can't be reached is a failure.
    pub(crate) async fn in_postgres() -> Option<Self> {
        let base = variable("TEST_POSTGRES_URL")?;
        let (alone, name) = (POSTGRES.lock().await, name());
        execute(&base, &format!("DROP SCHEMA IF EXISTS {name} CASCADE; CREATE SCHEMA {name}")).await;
        let and = if base.contains('?') { '&' } else { '?' };
        let url = format!("{base}{and}options=-c%20search_path%3D{name}");
        Some(Self { url, place: Place::Schema { base, name, _alone: alone } })
    }

    /// After its last server has ended.
    pub(crate) async fn remove(self) {
        match &self.place {
            Place::Folder(_) => {}
            Place::Schema { base, name, .. } => execute(base, &format!("DROP SCHEMA {name} CASCADE")).await,
        }
    }
}

impl Drop for Database {
    fn drop(&mut self) {
        if let Place::Folder(folder) = &self.place {
            let _ = std::fs::remove_dir_all(folder);
        }
    }
}

/// What the environment says; a test that has to go without says so.
pub(crate) fn variable(name: &str) -> Option<String> {
    let value = std::env::var(name).ok();
    if value.is_none() {
        // Neither print! nor eprint!, which are shown only of tests that fail. Where nobody can read it, nobody needs it.
        let _ = writeln!(std::io::stderr(), "not run: {name} is not set");
    }
    value
}

async fn execute(url: &str, statements: &str) {
    let mut connection = PgConnection::connect(url).await.unwrap();
    sqlx::raw_sql(AssertSqlSafe(statements)).execute(&mut connection).await.unwrap();
    connection.close().await.unwrap();
}
