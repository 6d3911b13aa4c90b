//! Claims jobs while there is room, and runs each to its end.

use core::mem;
use core::time::Duration;
use std::collections::HashMap;
use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tokio::sync::{OwnedSemaphorePermit, Semaphore, watch};
use tokio::time::sleep;
use tokio_util::sync::CancellationToken;
use tokio_util::task::TaskTracker;

use super::end::End;
use super::held::HeldJob;
use super::job::JobId;
use super::settings::JobSettings;
use super::store::{Claimed, Store};
use super::timestamp::{Timestamp, WallClock};
use super::upkeep::{Pause, sweep};
use super::work::{Lines, Work};
use crate::computation::Engine;
use crate::computation::Tools;
use crate::metrics::{Ended, Metrics, Queue};
use crate::wire::RequestLimits;
use crate::workers::{Draining, Pool, Recall};

/// The poll interval for queued jobs: hints of other servers may be lost.
const LOOK_AGAIN: Duration = Duration::from_millis(500);

/// The workers for jobs of one server.
pub struct Runner {
    store: Arc<dyn Store>,
    pool: Pool,
    tools: Tools,
    limits: RequestLimits,
    lease: Duration,
    slots: Arc<Semaphore>,
    running: Mutex<HashMap<JobId, Running>>,
}

/// A job that runs here.
struct Running {
    recall: Recall,
    /// True once its caller has cancelled it.
    cancelled: Arc<AtomicBool>,
}

impl Running {
    fn cancel(&self) {
        self.cancelled.store(true, Ordering::Relaxed);
        self.recall.finish_soon();
    }
}

impl Runner {
    /// Starts the threads; they idle until [`run`](Self::run).
    ///
    /// # Errors
    /// If a thread can't be started.
    pub fn new(
        store: Arc<dyn Store>,
        metrics: Arc<Metrics>,
        settings: &JobSettings,
        engine: Engine,
        limits: RequestLimits,
    ) -> io::Result<Self> {
        let threads = settings.threads.max(1);
        Ok(Self {
            store,
            // A thread may need a moment to become idle after its job.
            pool: Pool::new(threads, threads)?,
            tools: Tools { engine, metrics },
            limits,
            lease: settings.lease,
            slots: Arc::new(Semaphore::new(threads)),
            running: Mutex::default(),
        })
    }

    /// Claims jobs until `draining`; lets those that run end, and hands back those that still run at `over`.
    pub async fn run(self: Arc<Self>, draining: Draining, over: CancellationToken) {
        let tasks = TaskTracker::new();
        tasks.spawn(sweep(Arc::clone(&self.store), Arc::clone(&self.tools.metrics), self.lease, draining.clone()));
        let mut pause = Pause::default();
        while let Some(slot) = draining.unless_begun(self.slot()).await {
            let hint = self.store.hints().work.notified();
            match self.store.claim(&WallClock::system()).await {
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

    /// True if every thread is alive.
    pub fn ready(&self) -> bool {
        self.pool.ready()
    }

    /// The number of busy job threads.
    pub fn busy(&self) -> usize {
        self.pool.busy()
    }

    /// Ends a cancelled job now, with the best so far, if it runs here.
    pub fn cancel(&self, id: JobId) {
        if let Some(running) = self.running().get(&id) {
            running.cancel();
        }
    }

    async fn slot(&self) -> OwnedSemaphorePermit {
        loop {
            // The semaphore is never closed.
            if let Ok(slot) = Arc::clone(&self.slots).acquire_owned().await {
                return slot;
            }
        }
    }

    async fn attempt(self: Arc<Self>, mut claimed: Claimed, slot: OwnedSemaphorePermit, over: CancellationToken) {
        let claim = claimed.claim;
        self.tools.metrics.attempt(claimed.attempt);
        self.tools.metrics.waited(Queue::Job, Timestamp::now().since(claimed.created_at));
        let (watcher, mut incumbent) = watch::channel(None);
        let held = HeldJob::new(Arc::clone(&self.store), claim, self.lease);
        let Ok(work) = Work::begin(mem::take(&mut claimed.body), &self.pool, &self.tools, self.limits, watcher) else {
            return held.hand_back().await;
        };
        let lines = Lines::begin(&claimed, work.scene_id());
        let cancelled = Arc::<AtomicBool>::default();
        self.running().insert(claim.id, Running { recall: work.recall(), cancelled: Arc::clone(&cancelled) });
        let ended = tokio::select! {
            end = work.end() => Some(end),
            // The lease is lost.
            () = held.keep(&mut incumbent, || self.cancel(claim.id)) => None,
            () = over.cancelled() => {
                held.hand_back().await;
                None
            }
        };
        self.running().remove(&claim.id);
        if let Some(concluded) = ended {
            let best = *incumbent.borrow();
            if held.finish(best, &concluded.end, &over).await {
                let state = match concluded.end {
                    _ if cancelled.load(Ordering::Relaxed) => Ended::Cancelled,
                    End::Succeeded(_) => Ended::Succeeded,
                    End::Failed(_) => Ended::Failed,
                };
                lines.end(state, &concluded);
                self.tools.metrics.job_ended(state);
            }
        }
        drop(slot);
    }

    fn running(&self) -> MutexGuard<'_, HashMap<JobId, Running>> {
        // A panic can't break an invariant of the map.
        self.running.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
