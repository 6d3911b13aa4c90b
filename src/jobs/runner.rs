//! Claims jobs as long as there is room for them, and sees each to its end.

use core::time::Duration;
use std::collections::HashMap;
use std::io;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tokio::sync::{OwnedSemaphorePermit, Semaphore, watch};
use tokio::time::sleep;
use tokio_util::sync::CancellationToken;
use tokio_util::task::TaskTracker;

use super::held::Held;
use super::job::JobId;
use super::pause::Pause;
use super::settings::JobSettings;
use super::store::{Claimed, Store};
use super::sweeper::sweep;
use super::timestamp::Timestamp;
use super::work::{Tools, Work};
use crate::wire::RequestLimits;
use crate::workers::{Draining, Engine, Pool, Recall};

/// How long to wait for a hint before looking for work all the same: another server's hint may be lost.
const LOOK_AGAIN: Duration = Duration::from_millis(500);
/// The workers for jobs of one server.
pub struct Runner {
    store: Arc<dyn Store>,
    pool: Pool,
    tools: Tools,
    lease: Duration,
    slots: Arc<Semaphore>,
    /// What runs here, each with the means to end it.
    running: Mutex<HashMap<JobId, Recall>>,
}

impl Runner {
    /// Starts the threads; they idle until [`run`](Self::run).
    ///
    /// # Errors
    /// If the system gives no thread.
    pub fn new(
        store: Arc<dyn Store>,
        settings: &JobSettings,
        engine: Engine,
        limits: RequestLimits,
    ) -> io::Result<Self> {
        let threads = settings.threads.max(1);
        Ok(Self {
            store,
            // A thread may need a moment to become idle after its job has ended.
            pool: Pool::new(threads, threads)?,
            tools: Tools { engine, limits },
            lease: settings.lease,
            slots: Arc::new(Semaphore::new(threads)),
            running: Mutex::default(),
        })
    }

    /// Take jobs until `draining`; see those that run to their end, but hand back what still runs at `over`.
    pub async fn run(self: Arc<Self>, draining: Draining, over: CancellationToken) {
        let tasks = TaskTracker::new();
        tasks.spawn(sweep(Arc::clone(&self.store), self.lease, draining.clone()));
        let mut pause = Pause::default();
        while let Some(slot) = draining.unless_begun(self.slot()).await {
            let hint = self.store.hints().work.notified();
            match self.store.claim(Timestamp::now()).await {
                Ok(Some(claimed)) => {
                    pause = Pause::default();
                    tasks.spawn(Arc::clone(&self).attempt(claimed, slot, over.clone()));
                }
                Ok(None) => {
                    pause = Pause::default();
                    tokio::select! {
                        () = hint => {}
                        () = sleep(LOOK_AGAIN) => {}
                        () = draining.wait() => {}
                    }
                }
                Err(error) => {
                    tracing::warn!(%error, "no job could be claimed");
                    draining.unless_begun(pause.pass()).await;
                }
            }
        }
        tasks.close();
        tasks.wait().await;
    }

    /// True if every thread lives.
    pub fn ready(&self) -> bool {
        self.pool.ready()
    }

    /// A job that runs here ends now, with the best so far.
    pub fn end_soon(&self, id: JobId) {
        if let Some(recall) = self.running().get(&id) {
            recall.finish_soon();
        }
    }

    async fn slot(&self) -> OwnedSemaphorePermit {
        loop {
            // Nobody closes the semaphore.
            if let Ok(slot) = Arc::clone(&self.slots).acquire_owned().await {
                return slot;
            }
        }
    }

    async fn attempt(self: Arc<Self>, claimed: Claimed, slot: OwnedSemaphorePermit, over: CancellationToken) {
        let Claimed { claim, body, .. } = claimed;
        let (watcher, mut incumbent) = watch::channel(None);
        let held = Held::new(Arc::clone(&self.store), claim, self.lease);
        let Ok(work) = Work::begin(body, &self.pool, self.tools, watcher) else {
            return held.hand_back().await;
        };
        let recall = work.recall();
        self.running().insert(claim.id, recall.clone());
        let ended = tokio::select! {
            end = work.end() => Some(end),
            // Somebody else has the job now.
            () = held.keep(&mut incumbent, || recall.finish_soon()) => None,
            () = over.cancelled() => {
                held.hand_back().await;
                None
            }
        };
        self.running().remove(&claim.id);
        if let Some(end) = ended {
            let best = *incumbent.borrow();
            held.finish(best, &end, &over).await;
        }
        drop(slot);
    }

    fn running(&self) -> MutexGuard<'_, HashMap<JobId, Recall>> {
        // No invariant of the map can be broken by a panic.
        self.running.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
