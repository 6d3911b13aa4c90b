//! Every question's way in.

use core::time::Duration;
use std::sync::Arc;
use std::time::Instant;

use async_trait::async_trait;
use sqlx::{AnyPool, Error};
use tokio::time::error::Elapsed;
use tokio::time::timeout;
use tokio_util::task::TaskTracker;

use super::call::{self, Decision};
use super::change::Change;
use super::dialect::Dialect;
use super::file;
use super::herald::Herald;
use super::submit::{Submitted, submit};
use super::{callbacks, owner, row, sweep, worker};
use crate::jobs::{
    Callback, Cancellation, Claim, Claimed, Counts, Delivery, End, Hints, Job, JobId, JobSettings, NewJob, Owner, Page,
    Removal, Renewal, Store, StoreError, SubmitError, Swept, Timestamp, WallClock,
};
use singulate_planner::budget::Incumbent;

use crate::metrics::{Metrics, StoreOutcome};

/// How long the database may take, and where half a lease is less, that: a worker must hear in time that its store is away.
/// But a database may well take some seconds now and then.
const PATIENCE: Duration = Duration::from_secs(8);
const LEAST_PATIENCE: Duration = Duration::from_secs(3);

/// How long it may take to end what is being written, and to bring a file in order.
const CLOSING: Duration = Duration::from_secs(3);

/// Jobs in a database.
pub(super) struct SqlStore {
    pub(super) dialect: Dialect,
    pub(super) settings: JobSettings,
    /// For what changes something.
    pub(super) writers: AnyPool,
    /// For what only looks.
    pub(super) readers: AnyPool,
    /// What is written just now.
    pub(super) tasks: TaskTracker,
    pub(super) herald: Herald,
    pub(super) metrics: Arc<Metrics>,
}

/// The store as everybody has it, the tasks that write among them.
pub(super) struct SharedStore(pub(super) Arc<SqlStore>);

/// One write: all that is asked of `$change` happens, or nothing does. `$undo` gets an answer that nobody has heard.
macro_rules! change {
    ($store:expr, $operation:literal, |$change:ident| $work:expr) => {
        change!($store, $operation, |$change| $work, |_| async {})
    };
    ($store:expr, $operation:literal, |$change:ident| $work:expr, $undo:expr) => {{
        let (store, decision) = (Arc::clone(&$store.0), Decision::default());
        let own = decision.clone();
        let task = async move {
            let mut change = Change::begin(&store, own).await?;
            let $change = &mut change;
            let answer = $work.await?;
            change.commit().await?;
            Ok(answer)
        };
        async move {
            let store = &$store.0;
            store.ask($operation, call::answer(&store.tasks, (store.patience(), &decision), task, $undo)).await
        }
    }};
}

impl SqlStore {
    /// What only looks.
    async fn look<T>(
        &self,
        operation: &'static str,
        work: impl Future<Output = Result<T, Error>>,
    ) -> Result<T, StoreError> {
        self.ask(operation, timeout(self.patience(), work)).await
    }

    /// Every question passes here, under its name.
    async fn ask<T>(
        &self,
        operation: &'static str,
        work: impl Future<Output = Result<Result<T, Error>, Elapsed>>,
    ) -> Result<T, StoreError> {
        let asked = Instant::now();
        let answer = match work.await {
            Ok(answer) => answer.map_err(|error| StoreError(format!("{operation}: {error}"))),
            Err(_) => Err(StoreError(format!("{operation}: no answer within {} ms", asked.elapsed().as_millis()))),
        };
        let outcome = if answer.is_ok() { StoreOutcome::Done } else { StoreOutcome::Failed };
        self.metrics.store(operation, outcome, asked.elapsed());
        answer
    }

    /// SQLite empties its log into the file when the last connection is closed, but does not say whether it could. So it is
    /// asked to before that, once nobody here reads or writes any more. False if it could not.
    async fn close(&self) -> Result<bool, Error> {
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

    fn patience(&self) -> Duration {
        (self.settings.lease / 2).clamp(LEAST_PATIENCE, PATIENCE)
    }
}

#[async_trait]
impl Store for SharedStore {
    async fn submit(&self, jobs: &[NewJob], now: Timestamp) -> Result<Vec<Job>, SubmitError> {
        let jobs = jobs.to_vec();
        match change!(self, "submit", |change| submit(change, &jobs, now)).await? {
            Submitted::Accepted(jobs) => Ok(jobs),
            Submitted::Full => Err(SubmitError::Full),
            Submitted::KeyReused => Err(SubmitError::KeyReused),
        }
    }

    async fn get(&self, owner: &Owner, id: JobId) -> Result<Option<Job>, StoreError> {
        self.0.look("get", async { row::find(&mut *self.0.readers.acquire().await?, Some(owner), id).await }).await
    }

    async fn list(&self, owner: &Owner, page: Page) -> Result<Vec<Job>, StoreError> {
        self.0.look("list", async { row::list(&mut *self.0.readers.acquire().await?, owner, page).await }).await
    }

    async fn cancel(&self, owner: &Owner, id: JobId, now: Timestamp) -> Result<Cancellation, StoreError> {
        let owner = owner.clone();
        change!(self, "cancel", |change| owner::cancel(change, &owner, id, now)).await
    }

    async fn forget(&self, owner: &Owner, id: JobId) -> Result<Removal, StoreError> {
        let owner = owner.clone();
        change!(self, "forget", |change| owner::forget(change, &owner, id)).await
    }

    async fn claim(&self, clock: &WallClock) -> Result<Option<Claimed>, StoreError> {
        let (own, store, time) = (clock.clone(), Arc::clone(&self.0), clock.clone());
        let undo = async move |unheard: Option<Claimed>| {
            let Some(Claimed { claim, .. }) = unheard else { return };
            call::insist(store.settings.lease, || worker::give_back(&store, claim, time.now())).await;
        };
        change!(self, "claim", |change| worker::claim(change, &own), undo).await
    }

    async fn renew(&self, claim: Claim, clock: &WallClock) -> Result<Renewal, StoreError> {
        let clock = clock.clone();
        change!(self, "renew", |change| worker::renew(change, claim, &clock)).await
    }

    async fn note(&self, claim: Claim, incumbent: Incumbent, now: Timestamp) -> Result<bool, StoreError> {
        change!(self, "note", |change| worker::note(change, claim, incumbent, now)).await
    }

    async fn finish(&self, claim: Claim, end: &End, now: Timestamp) -> Result<bool, StoreError> {
        let end = end.clone();
        change!(self, "finish", |change| worker::finish(change, claim, &end, now)).await
    }

    async fn hand_back(&self, claim: Claim, now: Timestamp) -> Result<bool, StoreError> {
        change!(self, "hand_back", |change| worker::hand_back(change, claim, now)).await
    }

    async fn sweep(&self, now: Timestamp) -> Result<Swept, StoreError> {
        let mut all = Swept::default();
        // A batch at a time, so that nobody waits long for the one who sweeps.
        loop {
            let (swept, more) = change!(self, "sweep", |change| sweep::batch(change, now)).await?;
            sweep::add(&mut all, swept);
            if !more {
                return Ok(all);
            }
        }
    }

    async fn take_callback(&self, lease: Duration, clock: &WallClock) -> Result<Option<Callback>, StoreError> {
        let (own, store, time) = (clock.clone(), Arc::clone(&self.0), clock.clone());
        let undo = async move |unheard: Option<Callback>| {
            let Some(Callback { job, attempt, .. }) = unheard else { return };
            call::insist(lease, || callbacks::give_back(&store, job.id, attempt, time.now())).await;
        };
        change!(self, "take_callback", |change| callbacks::take(change, lease, &own), undo).await
    }

    async fn settle_callback(&self, id: JobId, attempt: u32, delivery: Delivery) -> Result<(), StoreError> {
        change!(self, "settle_callback", |change| callbacks::settle(change, id, attempt, delivery)).await
    }

    async fn counts(&self) -> Result<Counts, StoreError> {
        self.0.look("counts", async { sweep::counts(&mut *self.0.readers.acquire().await?).await }).await
    }

    async fn ping(&self) -> Result<(), StoreError> {
        self.0.look("ping", async { sqlx::query("SELECT 1").execute(&self.0.readers).await.map(drop) }).await
    }

    async fn close(&self) -> Result<(), StoreError> {
        self.0.tasks.close();
        match timeout(CLOSING, self.0.close()).await {
            Ok(Ok(true)) => Ok(()),
            Ok(Ok(false)) => {
                Err(StoreError("another process reads its file, so part of it is in the -wal beside".to_owned()))
            }
            Ok(Err(error)) => Err(StoreError(format!("close: {error}"))),
            Err(_) => Err(StoreError(format!("not closed within {} ms", CLOSING.as_millis()))),
        }
    }

    fn hints(&self) -> &Hints {
        self.0.herald.hints()
    }
}
