//! A job that this server holds: its lease is kept, its best is told, its end is kept.

use core::time::Duration;
use std::sync::{Arc, Mutex, PoisonError};

use tokio::sync::watch;
use tokio::time::{Instant, MissedTickBehavior, interval_at, sleep_until};
use tokio_util::sync::CancellationToken;

use super::job::End;
use super::pause::Pause;
use super::store::{Claim, Renewal, Store, StoreError};
use super::timestamp::Timestamp;
use crate::budget::Incumbent;

/// The least time between two notes of the best so far: nobody reads faster, and each is a write.
const NOTE_EVERY: Duration = Duration::from_millis(100);

/// When to look at a new lease for the first time. Most jobs have ended by then, and cost no write more.
const FIRST_LOOK: Duration = Duration::from_millis(10);

/// A claimed job.
pub(super) struct Held {
    store: Arc<dyn Store>,
    claim: Claim,
    lease: Duration,
    /// The best that the store knows.
    noted: Mutex<Option<Incumbent>>,
}

impl Held {
    pub(super) fn new(store: Arc<dyn Store>, claim: Claim, lease: Duration) -> Self {
        Self { store, claim, lease, noted: Mutex::default() }
    }

    /// Keeps the lease and passes on what is known; calls `cancelled` once the caller wants no more. Done once the lease is
    /// lost.
    pub(super) async fn keep(&self, incumbent: &mut watch::Receiver<Option<Incumbent>>, cancelled: impl Fn()) {
        let watcher = self.store.hints().watch(self.claim.id);
        let mut changed = Box::pin(watcher.changed());
        // The lease is new; but a wish to cancel may have come between the claim and the watching.
        let mut renewal = interval_at(Instant::now() + FIRST_LOOK, self.lease / 3);
        renewal.set_missed_tick_behavior(MissedTickBehavior::Delay);
        let mut next_note = Instant::now();
        let mut told = true;
        loop {
            let noting = async {
                let news = incumbent.changed().await;
                sleep_until(next_note).await;
                news
            };
            let renewed = tokio::select! {
                _ = renewal.tick() => self.renew().await,
                // Perhaps it was cancelled.
                () = changed.as_mut() => {
                    changed = Box::pin(watcher.changed());
                    self.renew().await
                }
                news = noting, if told => {
                    told = news.is_ok();
                    next_note = Instant::now() + NOTE_EVERY;
                    let best = *incumbent.borrow_and_update();
                    self.note(best).await.map(|held| if held { Renewal::Held } else { Renewal::Lost })
                }
            };
            match renewed {
                Ok(Renewal::Held) => {}
                Ok(Renewal::Cancelled) => cancelled(),
                Ok(Renewal::Lost) => return self.warn("the lease is lost", None),
                // Planning goes on: the lease may hold until the store is back.
                Err(error) => self.warn("the lease could not be renewed", Some(&error)),
            }
        }
    }

    /// Keep the end, however long the store is away, until the server has no more time. True if it is kept.
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

    /// Queue the job again, as if nobody had begun.
    pub(super) async fn hand_back(&self) {
        match self.store.hand_back(self.claim, Timestamp::now()).await {
            Ok(true) => tracing::info!(job = %self.claim.id, "job handed back"),
            Ok(false) => {}
            Err(error) => self.warn("the job could not be handed back; its lease will end", Some(&error)),
        }
    }

    async fn renew(&self) -> Result<Renewal, StoreError> {
        self.store.renew(self.claim, Timestamp::now()).await
    }

    async fn note(&self, best: Option<Incumbent>) -> Result<bool, StoreError> {
        // No invariant of a copied value can be broken by a panic.
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
    use tokio::sync::Notify;
    use tokio::time::timeout;

    use super::*;
    use crate::jobs::{Cancellation, JobId, JobSettings, NewJob, Owner, open};

    #[tokio::test]
    async fn a_cancel_between_the_claim_and_the_watching_is_heard() {
        // Whoever heard of it only when the lease is renewed would hear of it after 20 s.
        let lease = Duration::from_secs(60);
        let settings = JobSettings { url: "sqlite::memory:".to_owned(), lease, ..JobSettings::default() };
        let store = open(&settings, Arc::default()).await.unwrap();
        let (id, owner, now) = (JobId::new(), Owner::anonymous(), Timestamp::now());
        let job = NewJob {
            id,
            owner: owner.clone(),
            key: None,
            request_sha256: String::new(),
            scene_id: None,
            scene_sha256: String::new(),
            body: b"{}".to_vec(),
            priority: 0,
            callback_url: None,
        };
        store.submit(&[job], now).await.unwrap();
        let claim = store.claim(now).await.unwrap().unwrap().claim;
        assert!(matches!(store.cancel(&owner, id, now).await, Ok(Cancellation::Accepted(_))));
        let held = Held::new(store, claim, lease);
        let (_planner, mut incumbent) = watch::channel(None);
        let heard = Notify::new();
        let hearing = async {
            tokio::select! {
                () = held.keep(&mut incumbent, || heard.notify_one()) => {}
                () = heard.notified() => {}
            }
        };
        timeout(Duration::from_secs(15), hearing).await.expect("it is heard of at once");
    }
}
