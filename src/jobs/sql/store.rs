//! The entry point of all store calls.

use core::time::Duration;
use std::sync::Arc;
use std::time::Instant;

use async_trait::async_trait;
use sqlx::Error;
use tokio::time::error::Elapsed;
use tokio::time::timeout;

use super::call::{self, Decision};
use super::change::Change;
use super::database::Database;
use super::owner::Submitted;
use super::{leases, owner, row, sweep};
use crate::jobs::{
    Callback, Cancellation, Claim, Claimed, Counts, Delivery, End, Hints, Job, JobId, NewJob, Owner, Page, Removal,
    Renewal, Store, StoreError, SubmitError, Swept, Timestamp, WallClock,
};
use crate::metrics::{Metrics, StoreOutcome};
use singulate_planner::search::Incumbent;

/// How long closing may wait for running writes and the checkpoint.
const CLOSING: Duration = Duration::from_secs(3);

/// Jobs in a database.
pub(super) struct SqlStore {
    /// Shared with the tasks that write.
    database: Arc<Database>,
    metrics: Arc<Metrics>,
}

/// One write transaction: all of `$change` happens, or nothing. `$undo` gets a result that nobody received.
macro_rules! change {
    ($store:expr, $operation:literal, |$change:ident| $work:expr) => {
        change!($store, $operation, |$change| $work, |_| async {})
    };
    ($store:expr, $operation:literal, |$change:ident| $work:expr, $undo:expr) => {{
        let (database, decision) = (Arc::clone(&$store.database), Decision::default());
        let own = decision.clone();
        let task = async move {
            let mut change = Change::begin(&database, own).await?;
            let $change = &mut change;
            let answer = $work.await?;
            change.commit().await?;
            Ok(answer)
        };
        async move {
            let (store, database) = ($store, &$store.database);
            let answer = call::answer(&database.tasks, (database.patience(), &decision), task, $undo);
            store.ask($operation, answer).await
        }
    }};
}

impl SqlStore {
    pub(super) fn new(database: Database, metrics: Arc<Metrics>) -> Self {
        Self { database: Arc::new(database), metrics }
    }

    /// Runs a read.
    async fn look<T>(
        &self,
        operation: &'static str,
        work: impl Future<Output = Result<T, Error>>,
    ) -> Result<T, StoreError> {
        self.ask(operation, timeout(self.database.patience(), work)).await
    }

    /// Runs and measures a call under its name.
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
}

#[async_trait]
impl Store for SqlStore {
    async fn submit(&self, jobs: &[NewJob], now: Timestamp) -> Result<Vec<Job>, SubmitError> {
        let jobs = jobs.to_vec();
        match change!(self, "submit", |change| owner::submit(change, &jobs, now)).await? {
            Submitted::Accepted(jobs) => Ok(jobs),
            Submitted::Full => Err(SubmitError::Full),
            Submitted::KeyReused => Err(SubmitError::KeyReused),
        }
    }

    async fn get(&self, owner: &Owner, id: JobId) -> Result<Option<Job>, StoreError> {
        self.look("get", async { row::find(&mut *self.database.reader().await?, Some(owner), id).await }).await
    }

    async fn list(&self, owner: &Owner, page: Page) -> Result<Vec<Job>, StoreError> {
        self.look("list", async { row::list(&mut *self.database.reader().await?, owner, page).await }).await
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
        let (own, database, time) = (clock.clone(), Arc::clone(&self.database), clock.clone());
        let undo = async move |unheard: Option<Claimed>| {
            let Some(Claimed { claim, .. }) = unheard else { return };
            call::insist(database.settings.lease, || leases::give_back(&database, claim, time.now())).await;
        };
        change!(self, "claim", |change| leases::claim(change, &own), undo).await
    }

    async fn renew(&self, claim: Claim, clock: &WallClock) -> Result<Renewal, StoreError> {
        let clock = clock.clone();
        change!(self, "renew", |change| leases::renew(change, claim, &clock)).await
    }

    async fn note(&self, claim: Claim, incumbent: Incumbent, now: Timestamp) -> Result<bool, StoreError> {
        change!(self, "note", |change| leases::note(change, claim, incumbent, now)).await
    }

    async fn finish(&self, claim: Claim, end: &End, now: Timestamp) -> Result<bool, StoreError> {
        let end = end.clone();
        change!(self, "finish", |change| leases::finish(change, claim, &end, now)).await
    }

    async fn hand_back(&self, claim: Claim, now: Timestamp) -> Result<bool, StoreError> {
        change!(self, "hand_back", |change| leases::hand_back(change, claim, now)).await
    }

    async fn sweep(&self, now: Timestamp) -> Result<Swept, StoreError> {
        let mut all = Swept::default();
        // In batches, so that other writers wait briefly.
        loop {
            let (swept, more) = change!(self, "sweep", |change| sweep::batch(change, now)).await?;
            sweep::add(&mut all, swept);
            if !more {
                return Ok(all);
            }
        }
    }

    async fn take_callback(&self, lease: Duration, clock: &WallClock) -> Result<Option<Callback>, StoreError> {
        let (own, database, time) = (clock.clone(), Arc::clone(&self.database), clock.clone());
        let undo = async move |unheard: Option<Callback>| {
            let Some(Callback { job, attempt, .. }) = unheard else { return };
            call::insist(lease, || leases::give_back_callback(&database, job.id, attempt, time.now())).await;
        };
        change!(self, "take_callback", |change| leases::take_callback(change, lease, &own), undo).await
    }

    async fn settle_callback(&self, id: JobId, attempt: u32, delivery: Delivery) -> Result<(), StoreError> {
        change!(self, "settle_callback", |change| leases::settle_callback(change, id, attempt, delivery)).await
    }

    async fn counts(&self) -> Result<Counts, StoreError> {
        self.look("counts", async { sweep::counts(&mut *self.database.reader().await?).await }).await
    }

    async fn ping(&self) -> Result<(), StoreError> {
        self.look("ping", async { sqlx::query("SELECT 1").execute(&self.database.readers).await.map(drop) }).await
    }

    async fn close(&self) -> Result<(), StoreError> {
        match timeout(CLOSING, self.database.close()).await {
            Ok(Ok(true)) => Ok(()),
            Ok(Ok(false)) => {
                Err(StoreError("another process reads its file, so part of it is in the -wal beside".to_owned()))
            }
            Ok(Err(error)) => Err(StoreError(format!("close: {error}"))),
            Err(_) => Err(StoreError(format!("not closed within {} ms", CLOSING.as_millis()))),
        }
    }

    fn hints(&self) -> &Hints {
        self.database.herald.hints()
    }
}
