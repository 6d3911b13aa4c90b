//! A job held by this server: renews its lease, stores its incumbents and its end.

use core::time::Duration;
use std::sync::{Arc, Mutex, PoisonError};

use tokio::sync::watch;
use tokio::time::{Instant, MissedTickBehavior, interval_at, sleep_until};
use tokio_util::sync::CancellationToken;

use super::end::End;
use super::store::{Claim, Renewal, Store, StoreError};
use super::timestamp::{Timestamp, WallClock};
use super::upkeep::Pause;
use singulate_planner::search::Incumbent;

/// The least time between two writes of the incumbent: no reader is faster.
const NOTE_EVERY: Duration = Duration::from_millis(100);

/// The pause after a failed write of the incumbent.
const NOTE_AGAIN: Duration = Duration::from_secs(1);

/// The first renewal of a new lease. Most jobs have ended by then and need no extra write.
const FIRST_LOOK: Duration = Duration::from_millis(10);

/// A claimed job.
pub(super) struct HeldJob {
    store: Arc<dyn Store>,
    claim: Claim,
    lease: Duration,
    /// The incumbent in the store.
    noted: Mutex<Option<Incumbent>>,
}

impl HeldJob {
    pub(super) fn new(store: Arc<dyn Store>, claim: Claim, lease: Duration) -> Self {
        Self { store, claim, lease, noted: Mutex::default() }
    }

    /// Renews the lease and stores incumbents; calls `cancelled` once the job was cancelled. Done once the lease is
    /// lost.
    pub(super) async fn keep(&self, incumbent: &mut watch::Receiver<Option<Incumbent>>, cancelled: impl Fn()) {
        let holder = self.store.hints().hold(self.claim.id);
        let mut recalled = Box::pin(holder.changed());
        // The lease is new, but the job may have been cancelled between the claim and `hold`.
        let mut renewal = interval_at(Instant::now() + FIRST_LOOK, self.lease / 3);
        renewal.set_missed_tick_behavior(MissedTickBehavior::Delay);
        let mut next_note = Instant::now();
        let mut told = true;
        loop {
            // The wait for news comes last: if another branch went first, the news it has seen would be lost.
            let noting = async {
                sleep_until(next_note).await;
                incumbent.changed().await
            };
            let renewed = tokio::select! {
                _ = renewal.tick() => self.renew().await,
                // The job was cancelled, or another worker has it.
                () = recalled.as_mut() => {
                    recalled = Box::pin(holder.changed());
                    self.renew().await
                }
                news = noting, if told => {
                    told = news.is_ok();
                    let best = *incumbent.borrow_and_update();
                    let noted = self.note(best).await;
                    // News that could not be stored stays news.
                    if noted.is_err() {
                        incumbent.mark_changed();
                    }
                    next_note = Instant::now() + if noted.is_ok() { NOTE_EVERY } else { NOTE_AGAIN };
                    noted.map(|held| if held { Renewal::Held } else { Renewal::Lost })
                }
            };
            match renewed {
                Ok(Renewal::Held) => {}
                Ok(Renewal::Cancelled) => cancelled(),
                Ok(Renewal::Lost) => return self.warn("the lease is lost", None),
                // Planning goes on: the store may be back before the lease ends.
                Err(error) => self.warn("the store could not be told of a running job", Some(&error)),
            }
        }
    }

    /// Stores the end, retrying while the store is away until the server's time is over. True if it is stored.
    pub(super) async fn finish(&self, best: Option<Incumbent>, end: &End, over: &CancellationToken) -> bool {
        let mut pause = Pause::default();
        loop {
            match self.try_finish(best, end).await {
                Ok(true) => return true,
                Ok(false) => {
                    self.warn("the lease was lost before the end was kept", None);
                    return false;
                }
                Err(error) => self.warn("the end could not be kept yet", Some(&error)),
            }
            if over.run_until_cancelled(pause.pass()).await.is_none() {
                self.warn("the end is lost, the job will run again", None);
                return false;
            }
        }
    }

    /// Puts the job back into the queue, as if it had not been claimed.
    pub(super) async fn hand_back(&self) {
        match self.store.hand_back(self.claim, Timestamp::now()).await {
            Ok(true) => tracing::info!(job = %self.claim.id, "job handed back"),
            Ok(false) => {}
            Err(error) => self.warn("the job could not be handed back; its lease will end", Some(&error)),
        }
    }

    async fn renew(&self) -> Result<Renewal, StoreError> {
        self.store.renew(self.claim, &WallClock::system()).await
    }

    async fn note(&self, best: Option<Incumbent>) -> Result<bool, StoreError> {
        // No invariant of a `Copy` value can be broken by a panic.
        let noted = || self.noted.lock().unwrap_or_else(PoisonError::into_inner);
        let Some(news) = best.filter(|best| *noted() != Some(*best)) else { return Ok(true) };
        let held = self.store.note(self.claim, news, Timestamp::now()).await?;
        *noted() = best;
        Ok(held)
    }

    async fn try_finish(&self, best: Option<Incumbent>, end: &End) -> Result<bool, StoreError> {
        self.note(best).await?;
        self.store.finish(self.claim, end, Timestamp::now()).await
    }

    fn warn(&self, what: &str, error: Option<&StoreError>) {
        let error = error.map(tracing::field::display);
        tracing::warn!(job = %self.claim.id, error, "{what}");
    }
}

#[cfg(test)]
mod tests {
    use sqlx::{AssertSqlSafe, Connection, SqliteConnection};
    use tokio::sync::Notify;
    use tokio::time::{sleep, timeout};

    use super::*;
    use crate::jobs::{Cancellation, JobId, JobSettings, NewJob, Owner, open};
    use crate::metrics::Metrics;
    use singulate_planner::cost::Cost;

    /// A renewal is due after 20 s, so news within the test's patience did not come from one.
    const LEASE: Duration = Duration::from_secs(60);
    const PATIENCE: Duration = Duration::from_secs(15);

    /// A store with one claimed job.
    struct Trial {
        store: Arc<dyn Store>,
        metrics: Arc<Metrics>,
        claim: Claim,
        heard: Notify,
    }

    impl Trial {
        async fn at(url: String) -> Self {
            let (settings, metrics) = (JobSettings { url, lease: LEASE, ..JobSettings::default() }, Arc::default());
            let store = open(&settings, Arc::clone(&metrics)).await.unwrap();
            let job = NewJob {
                id: JobId::new(),
                owner: Owner::anonymous(),
                key: None,
                request_sha256: String::new(),
                scene_id: None,
                scene_sha256: String::new(),
                body: b"{}".to_vec(),
                priority: 0,
                callback_url: None,
            };
            store.submit(&[job], Timestamp::now()).await.unwrap();
            let claim = store.claim(&WallClock::system()).await.unwrap().unwrap().claim;
            Self { store, metrics, claim, heard: Notify::new() }
        }

        async fn in_memory() -> Self {
            Self::at("sqlite::memory:".to_owned()).await
        }

        /// Holds the job while this runs.
        async fn held_during(
            &self,
            incumbent: &mut watch::Receiver<Option<Incumbent>>,
            work: impl Future<Output = ()>,
        ) {
            let held = HeldJob::new(Arc::clone(&self.store), self.claim, LEASE);
            let keeping = held.keep(incumbent, || self.heard.notify_one());
            tokio::select! {
                () = keeping => panic!("the lease is lost"),
                done = timeout(PATIENCE, work) => done.expect("it is heard of at once"),
            }
        }

        async fn cancel(&self) {
            let cancelled = self.store.cancel(&Owner::anonymous(), self.claim.id, Timestamp::now()).await;
            assert!(matches!(cancelled, Ok(Cancellation::Accepted(_))));
        }

        /// Done once the store has this incumbent.
        async fn keeps(&self, best: Incumbent) {
            while self.store.get(&Owner::anonymous(), self.claim.id).await.unwrap().unwrap().incumbent != Some(best) {
                sleep(Duration::from_millis(1)).await;
            }
        }

        /// The number of calls of the store.
        fn calls(&self, operation: &str, outcome: &str) -> usize {
            let labels = format!("singulate_store_seconds_count{{operation=\"{operation}\",outcome=\"{outcome}\"}} ");
            self.metrics.text().lines().find_map(|line| line.strip_prefix(&labels)?.parse().ok()).unwrap_or_default()
        }
    }

    fn cost(cost: u64) -> Incumbent {
        Incumbent { cost: Cost::new(cost), lower_bound: Cost::new(1) }
    }

    #[tokio::test]
    async fn a_cancel_between_the_claim_and_the_holding_is_heard() {
        let trial = Trial::in_memory().await;
        trial.cancel().await;
        let (_planner, mut incumbent) = watch::channel(None);
        trial.held_during(&mut incumbent, trial.heard.notified()).await;
    }

    #[tokio::test]
    async fn a_note_is_one_write_and_no_reason_to_renew_the_lease() {
        let trial = Trial::in_memory().await;
        let (planner, mut incumbent) = watch::channel(None);
        let notes = async {
            for best in [9, 8, 7, 6].map(cost) {
                planner.send(Some(best)).unwrap();
                trial.keeps(best).await;
            }
            // Once this is heard, everything before has taken effect.
            trial.cancel().await;
            trial.heard.notified().await;
        };
        trial.held_during(&mut incumbent, notes).await;
        assert_eq!(trial.calls("note", "done"), 4);
        // The first renewal, and the one after the cancel.
        assert!((1..=2).contains(&trial.calls("renew", "done")), "{}", trial.metrics.text());
    }

    #[tokio::test]
    async fn the_best_is_kept_whatever_happens_between_two_notes() {
        let trial = Trial::in_memory().await;
        let (planner, mut incumbent) = watch::channel(None);
        let notes = async {
            planner.send(Some(cost(9))).unwrap();
            trial.keeps(cost(9)).await;
            planner.send(Some(cost(8))).unwrap();
            // By now it was seen but is not due to be stored; then other branches become ready.
            for _ in 0..10 {
                tokio::task::yield_now().await;
            }
            trial.store.hints().recalled(trial.claim.id);
            trial.keeps(cost(8)).await;
        };
        trial.held_during(&mut incumbent, notes).await;
    }

    #[tokio::test]
    async fn the_best_is_kept_once_the_store_is_back() {
        let folder = std::env::temp_dir().join(JobId::new().to_string());
        std::fs::create_dir(&folder).unwrap();
        let url = format!("sqlite:{}", folder.join("jobs.db").display());
        let trial = Trial::at(url.clone()).await;
        let mut other = SqliteConnection::connect(&url).await.unwrap();
        let mut execute = async |statement: &'static str| {
            sqlx::raw_sql(AssertSqlSafe(statement)).execute(&mut other).await.unwrap();
        };
        execute("CREATE TRIGGER away BEFORE UPDATE OF cost ON jobs BEGIN SELECT RAISE(ABORT, 'away'); END").await;
        let (planner, mut incumbent) = watch::channel(None);
        let notes = async {
            planner.send(Some(cost(9))).unwrap();
            while trial.calls("note", "failed") == 0 {
                sleep(Duration::from_millis(1)).await;
            }
            execute("DROP TRIGGER away").await;
            trial.keeps(cost(9)).await;
        };
        trial.held_during(&mut incumbent, notes).await;
        std::fs::remove_dir_all(folder).unwrap();
    }
}
