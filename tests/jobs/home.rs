//! Where the stores of one test live, and what they are given.

use core::sync::atomic::{AtomicUsize, Ordering};
use core::time::Duration;
use std::path::PathBuf;
use std::sync::Arc;

use singulate::jobs::{Claimed, Job, JobId, JobSettings, NewJob, Owner, Store, Timestamp, open};
use sqlx::{Connection, PgConnection};

/// What a test may wait for another process or a busy machine.
pub(crate) const PATIENCE: Duration = Duration::from_secs(60);
pub(crate) const LEASE: Duration = Duration::from_millis(100);
pub(crate) const TTL: Duration = Duration::from_millis(1000);

/// Gone with its test.
struct Folder(PathBuf);

/// A database of one test's own.
pub(crate) struct Home {
    pub(crate) settings: JobSettings,
    /// Memory has one way in.
    only: Option<Arc<dyn Store>>,
    _folder: Option<Folder>,
    /// In PostgreSQL, where it is also the name of every connection.
    pub(crate) schema: Option<String>,
}

static HOMES: AtomicUsize = AtomicUsize::new(0);

/// A name that no other test and no other run has.
fn name() -> String {
    format!(
        "singulate_{}_{}_{}",
        std::process::id(),
        HOMES.fetch_add(1, Ordering::Relaxed),
        Timestamp::now().as_millis()
    )
}

pub(crate) fn postgres_url() -> Option<String> {
    std::env::var("TEST_POSTGRES_URL").ok()
}

impl Home {
    fn at(url: String) -> Self {
        let settings =
            JobSettings { url, threads: 1, max_queued: 1000, lease: LEASE, ttl: TTL, ..JobSettings::default() };
        Self { settings, only: None, _folder: None, schema: None }
    }

    pub(crate) fn in_a_file() -> Self {
        let folder = std::env::temp_dir().join(name());
        std::fs::create_dir(&folder).unwrap();
        let url = format!("sqlite:{}", folder.join("jobs.db").display());
        Self { _folder: Some(Folder(folder)), ..Self::at(url) }
    }

    pub(crate) async fn in_memory() -> Self {
        Self::at("sqlite::memory:".to_owned()).opened().await
    }

    async fn opened(self) -> Self {
        Self { only: Some(open(&self.settings, Arc::default()).await.unwrap()), ..self }
    }

    /// Nothing where there is no PostgreSQL to test with. One that can't be reached is a failure.
    pub(crate) async fn in_postgres() -> Option<Self> {
        let base = postgres_url()?;
        let schema = name();
        execute(&base, &format!("CREATE SCHEMA {schema}")).await;
        let and = if base.contains('?') { '&' } else { '?' };
        let url = format!("{base}{and}options=-c%20search_path%3D{schema}&application_name={schema}");
        Some(Self { schema: Some(schema), ..Self::at(url) })
    }

    /// A way in of its own, as another process would have it; in memory the only one.
    pub(crate) async fn store(&self) -> Arc<dyn Store> {
        match &self.only {
            Some(only) => Arc::clone(only),
            None => open(&self.settings, Arc::default()).await.unwrap(),
        }
    }

    /// PostgreSQL keeps what is not removed.
    pub(crate) async fn remove(self) {
        let schema = self.schema.as_ref().unwrap();
        execute(&postgres_url().unwrap(), &format!("DROP SCHEMA {schema} CASCADE")).await;
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        std::fs::remove_dir_all(&self.0).unwrap();
    }
}

/// On a connection of its own.
pub(crate) async fn execute(url: &str, statement: &str) {
    let mut connection = PgConnection::connect(url).await.unwrap();
    sqlx::raw_sql(sqlx::AssertSqlSafe(statement)).execute(&mut connection).await.unwrap();
    connection.close().await.unwrap();
}

/// So many milliseconds after the test began.
pub(crate) fn at(millis: i64) -> Timestamp {
    Timestamp::from_millis(1_700_000_000_000 + millis)
}

pub(crate) fn ann() -> Owner {
    Owner::named("ann")
}

pub(crate) fn bob() -> Owner {
    Owner::named("bob")
}

/// A job of Ann's.
pub(crate) fn job() -> NewJob {
    NewJob {
        id: JobId::new(),
        owner: ann(),
        key: None,
        request_sha256: "aa".to_owned(),
        scene_id: None,
        scene_sha256: "bb".to_owned(),
        body: b"{}".to_vec(),
        priority: 0,
        callback_url: None,
    }
}

pub(crate) fn jobs<const N: usize>() -> [NewJob; N] {
    core::array::from_fn(|_| job())
}

pub(crate) fn keyed(key: &str, position: u32) -> NewJob {
    NewJob { key: Some((key.to_owned(), position)), ..job() }
}

/// Accepted at the beginning.
pub(crate) async fn submitted(store: &Arc<dyn Store>, new: NewJob) -> Job {
    store.submit(&[new], at(0)).await.unwrap().remove(0)
}

pub(crate) async fn claimed(store: &Arc<dyn Store>, millis: i64) -> Claimed {
    store.claim(&at(millis).into()).await.unwrap().unwrap()
}

/// Ann's job as it stands.
pub(crate) async fn seen(store: &Arc<dyn Store>, id: JobId) -> Job {
    store.get(&ann(), id).await.unwrap().unwrap()
}
