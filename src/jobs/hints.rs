//! Wakes tasks that wait for a job to change, or for work.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tokio::sync::Notify;

use super::job::JobId;

/// The waiting tasks.
#[derive(Debug, Default)]
pub struct Hints {
    watched: Arc<Watched>,
    held: Arc<Watched>,
    /// Woken when a job may be there to be claimed.
    pub work: Notify,
    /// Woken when a callback may be due.
    pub callbacks: Notify,
}

/// Per job its notifier and the number of its watchers.
type Watched = Mutex<HashMap<JobId, (Arc<Notify>, usize)>>;

/// Waits for one job.
#[derive(Debug)]
pub struct Watcher {
    watched: Arc<Watched>,
    id: JobId,
    notify: Arc<Notify>,
}

impl Hints {
    /// Wakes the clients that watch the job.
    pub fn changed(&self, id: JobId) {
        wake(&self.watched, id);
    }

    /// Wakes the worker of the job: it was cancelled, or its lease has ended.
    pub fn recalled(&self, id: JobId) {
        wake(&self.held, id);
    }

    /// Wakes everybody: changes may have been missed.
    pub fn all_changed(&self) {
        for list in [&self.watched, &self.held] {
            lock(list).values().for_each(|(notify, _)| notify.notify_waiters());
        }
        self.work.notify_waiters();
        self.callbacks.notify_waiters();
    }

    /// Watch a job.
    pub fn watch(&self, id: JobId) -> Watcher {
        Watcher::new(&self.watched, id)
    }

    /// Watch for recalls of a job that runs here. Its own worker's writes don't wake it.
    pub fn hold(&self, id: JobId) -> Watcher {
        Watcher::new(&self.held, id)
    }
}

fn wake(list: &Watched, id: JobId) {
    if let Some((notify, _)) = lock(list).get(&id) {
        notify.notify_waiters();
    }
}

impl Watcher {
    fn new(list: &Arc<Watched>, id: JobId) -> Self {
        let mut watched = lock(list);
        let (notify, count) = watched.entry(id).or_default();
        *count += 1;
        Self { watched: Arc::clone(list), id, notify: Arc::clone(notify) }
    }

    /// Done once the job has changed since this call. Call it, read the job, then await it, so that no change is
    /// missed.
    pub fn changed(&self) -> impl Future<Output = ()> + use<> {
        let mut notified = Box::pin(Arc::clone(&self.notify).notified_owned());
        notified.as_mut().enable();
        notified
    }
}

impl Drop for Watcher {
    fn drop(&mut self) {
        let mut watched = lock(&self.watched);
        if let Some((_, count)) = watched.get_mut(&self.id) {
            *count -= 1;
            if *count == 0 {
                watched.remove(&self.id);
            }
        }
    }
}

/// A panic can't break an invariant of the locked data.
fn lock(watched: &Watched) -> MutexGuard<'_, HashMap<JobId, (Arc<Notify>, usize)>> {
    watched.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn a_watcher_hears_of_its_own_job_and_leaves_nothing_behind() {
        let hints = Hints::default();
        let (id, other) = (JobId::new(), JobId::new());
        let (watcher, second, holder) = (hints.watch(id), hints.watch(id), hints.hold(id));
        let recall = holder.changed();
        let change = watcher.changed();
        hints.changed(other);
        hints.changed(id);
        change.await;
        drop(watcher);
        let change = second.changed();
        hints.all_changed();
        change.await;
        recall.await;
        drop((second, holder));
        assert!(lock(&hints.watched).is_empty() && lock(&hints.held).is_empty());
    }

    #[tokio::test]
    async fn a_worker_hears_of_recalls_alone() {
        let hints = Hints::default();
        let id = JobId::new();
        let (watcher, holder) = (hints.watch(id), hints.hold(id));
        let (change, mut recall) = (watcher.changed(), holder.changed());
        hints.changed(id);
        change.await;
        assert!(futures_util::poll!(&mut recall).is_pending());
        hints.recalled(id);
        recall.await;
    }
}
