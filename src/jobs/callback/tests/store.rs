//! An in-memory store with the calls that callbacks need.

use core::time::Duration;
use std::sync::Mutex;

use async_trait::async_trait;

use crate::jobs::{
    Callback, Cancellation, Claim, Claimed, Counts, Delivery, End, Hints, Job, JobId, JobState, NewJob, Owner, Page,
    Removal, Renewal, Store, StoreError, SubmitError, Swept, Timestamp, WallClock,
};
use singulate_planner::search::Incumbent;

#[derive(Default)]
pub(super) struct Callbacks {
    due: Mutex<Vec<(Callback, Timestamp)>>,
    settled: Mutex<Vec<(JobId, u32, Delivery)>>,
    hints: Hints,
}

impl Callbacks {
    /// Adds an ended job with a callback to this URL.
    pub(super) fn add(&self, url: &str) -> JobId {
        let job = ended();
        let id = job.id;
        let callback = Callback { job, url: url.to_owned(), attempt: 0 };
        self.due.lock().unwrap().push((callback, Timestamp::from_millis(0)));
        self.hints.callbacks.notify_waiters();
        id
    }

    /// The outcomes of the job's tries so far.
    pub(super) fn settled(&self, id: JobId) -> Vec<(u32, Delivery)> {
        let settled = self.settled.lock().unwrap();
        settled.iter().filter(|(job, ..)| *job == id).map(|(_, attempt, delivery)| (*attempt, *delivery)).collect()
    }

    /// True if there will be no more tries.
    pub(super) fn over(&self, id: JobId) -> bool {
        self.due.lock().unwrap().iter().all(|(callback, _)| callback.job.id != id)
    }
}

fn ended() -> Job {
    let at = Timestamp::from_millis(1_700_000_000_000);
    Job {
        id: JobId::new(),
        state: JobState::Succeeded,
        scene_id: None,
        scene_sha256: String::new(),
        created_at: at,
        started_at: Some(at),
        finished_at: Some(at),
        expires_at: at,
        attempts: 1,
        queue_position: None,
        incumbent: None,
        result: Some("{}".parse().unwrap()),
        problem: None,
        version: None,
        events: Vec::new(),
    }
}

fn not_here<T>() -> Result<T, StoreError> {
    Err(StoreError("only callbacks are here".to_owned()))
}

#[async_trait]
impl Store for Callbacks {
    async fn take_callback(&self, lease: Duration, clock: &WallClock) -> Result<Option<Callback>, StoreError> {
        let now = clock.now();
        let mut due = self.due.lock().unwrap();
        Ok(due.iter_mut().find(|(_, at)| *at <= now).map(|(callback, at)| {
            callback.attempt += 1;
            *at = now.after(lease);
            callback.clone()
        }))
    }

    async fn settle_callback(&self, id: JobId, attempt: u32, delivery: Delivery) -> Result<(), StoreError> {
        self.settled.lock().unwrap().push((id, attempt, delivery));
        let mut due = self.due.lock().unwrap();
        match delivery {
            Delivery::Over => due.retain(|(callback, _)| callback.job.id != id),
            Delivery::Again(then) => {
                due.iter_mut().filter(|(callback, _)| callback.job.id == id).for_each(|(_, at)| *at = then);
            }
        }
        Ok(())
    }

    fn hints(&self) -> &Hints {
        &self.hints
    }

    async fn submit(&self, _: &[NewJob], _: Timestamp) -> Result<Vec<Job>, SubmitError> {
        Ok(not_here()?)
    }
    async fn get(&self, _: &Owner, _: JobId) -> Result<Option<Job>, StoreError> {
        not_here()
    }
    async fn list(&self, _: &Owner, _: Page) -> Result<Vec<Job>, StoreError> {
        not_here()
    }
    async fn cancel(&self, _: &Owner, _: JobId, _: Timestamp) -> Result<Cancellation, StoreError> {
        not_here()
    }
    async fn forget(&self, _: &Owner, _: JobId) -> Result<Removal, StoreError> {
        not_here()
    }
    async fn claim(&self, _: &WallClock) -> Result<Option<Claimed>, StoreError> {
        not_here()
    }
    async fn renew(&self, _: Claim, _: &WallClock) -> Result<Renewal, StoreError> {
        not_here()
    }
    async fn note(&self, _: Claim, _: Incumbent, _: Timestamp) -> Result<bool, StoreError> {
        not_here()
    }
    async fn finish(&self, _: Claim, _: &End, _: Timestamp) -> Result<bool, StoreError> {
        not_here()
    }
    async fn hand_back(&self, _: Claim, _: Timestamp) -> Result<bool, StoreError> {
        not_here()
    }
    async fn sweep(&self, _: Timestamp) -> Result<Swept, StoreError> {
        not_here()
    }
    async fn counts(&self) -> Result<Counts, StoreError> {
        not_here()
    }
    async fn close(&self) -> Result<(), StoreError> {
        not_here()
    }
    async fn ping(&self) -> Result<(), StoreError> {
        not_here()
    }
}
