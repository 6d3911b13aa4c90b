//! The contract of a job store.
//!
//! States change only as in this table. Each change is one transaction, on disk before its call returns.
//!
//! | from | to | by |
//! | --- | --- | --- |
//! | - | queued | `submit` |
//! | queued | running | `claim`: one more attempt, a new fence, a lease |
//! | queued | cancelled | `cancel` |
//! | queued | expired | `sweep`, once `expires_at` has passed |
//! | running | succeeded, failed, cancelled | `finish` with the fence; cancelled where `cancel` came before |
//! | running | queued | `hand_back` with the fence, which takes the attempt back; `sweep`, once the lease has passed |
//! | running | cancelled | `hand_back` of one that `cancel` came before: it would wait again only to be ended |
//! | running | failed, cancelled | `sweep`, once the lease of the third attempt has passed; of one that `cancel` came before |
//! | finished | - | `forget`; `sweep`, once `expires_at` has passed |
//!
//! A fence is a number that grows with each claim of a job. A worker that lost its lease holds an old one, and its
//! calls no longer have an effect: no job ends twice.

use core::time::Duration;

use async_trait::async_trait;

use super::end::End;
use super::hints::Hints;
use super::job::{Job, JobId, JobState, NewJob, Owner};
use super::timestamp::{Timestamp, WallClock};
use singulate_planner::search::Incumbent;

/// The most incumbent events of one job; later incumbents are only stored in `incumbent`.
pub const MAX_INCUMBENT_EVENTS: usize = 100;

/// The store failed or timed out. In most cases nothing has changed, since an abandoned transaction is rolled back. But
/// if the commit was under way, it may have taken effect.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the store of jobs: {0}")]
pub struct StoreError(pub String);

/// Why a submission failed. No job was accepted.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SubmitError {
    /// The queue is full.
    #[error("the queue of jobs is full")]
    Full,
    /// The idempotency key belongs to a different request.
    #[error("the idempotency key belongs to another request")]
    KeyReused,
    /// The store failed.
    #[error(transparent)]
    Store(#[from] StoreError),
}

/// The right to run a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Claim {
    /// The job.
    pub id: JobId,
    /// Grows with each claim of the job.
    pub fence: i64,
}

/// A job for a worker.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Claimed {
    /// The claim.
    pub claim: Claim,
    /// The owner.
    pub owner: Owner,
    /// The planning request as JSON.
    pub body: Vec<u8>,
    /// The number of the attempt, from 1.
    pub attempt: u32,
    /// When the job was accepted.
    pub created_at: Timestamp,
}

/// The outcome of a renewal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Renewal {
    /// The lease was renewed.
    Held,
    /// The lease was renewed, and the job is cancelled: finish with the best so far.
    Cancelled,
    /// The lease is lost.
    Lost,
}

/// The outcome of a cancellation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Cancellation {
    /// There is no such job.
    Unknown,
    /// The job had already ended.
    Finished,
    /// It is cancelled, or will be once its worker has delivered the best so far.
    Accepted(Box<Job>),
}

/// The outcome of a removal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Removal {
    /// There is no such job.
    Unknown,
    /// It has not ended.
    Unfinished,
    /// It is deleted, and so is its idempotency key.
    Forgotten,
}

/// A page of the list of jobs, the latest first, without their results.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Page {
    /// Only jobs in this state.
    pub state: Option<JobState>,
    /// Only jobs before this one.
    pub before: Option<JobId>,
    /// The most jobs.
    pub limit: usize,
}

/// A callback that is due.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Callback {
    /// The ended job.
    pub job: Job,
    /// The receiver.
    pub url: String,
    /// The number of the try, from 1.
    pub attempt: u32,
}

/// The outcome of a delivery.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Delivery {
    /// Delivered or given up: no more tries.
    Over,
    /// Try again at this time.
    Again(Timestamp),
}

/// The changes of a sweep.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Swept {
    /// Lost by their workers and queued again.
    pub requeued: Vec<JobId>,
    /// Ended after losing the last allowed worker.
    pub poisoned: Vec<JobId>,
    /// Lost by their workers after they were cancelled.
    pub cancelled: Vec<JobId>,
    /// Expired in the queue.
    pub expired: Vec<JobId>,
    /// The number of jobs deleted.
    pub forgotten: u64,
}

/// How many jobs of all owners are in unfinished states.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counts {
    /// Waiting.
    pub queued: u64,
    /// Running.
    pub running: u64,
}

/// Stores jobs. Every call is one transaction, except `sweep`: one per batch. `now` is the caller's time.
#[async_trait]
pub trait Store: Send + Sync + 'static {
    /// Accept all jobs of one request, or none. If the key of the first job is known with the same digest, returns the
    /// jobs accepted then.
    ///
    /// # Errors
    /// [`SubmitError`].
    async fn submit(&self, jobs: &[NewJob], now: Timestamp) -> Result<Vec<Job>, SubmitError>;

    /// A job of the owner.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn get(&self, owner: &Owner, id: JobId) -> Result<Option<Job>, StoreError>;

    /// The owner's jobs.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn list(&self, owner: &Owner, page: Page) -> Result<Vec<Job>, StoreError>;

    /// Cancel a job: a queued one at once, a running one once its worker has noticed.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn cancel(&self, owner: &Owner, id: JobId, now: Timestamp) -> Result<Cancellation, StoreError>;

    /// Delete an ended job.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn forget(&self, owner: &Owner, id: JobId) -> Result<Removal, StoreError>;

    /// Claim the next job: greatest priority first, then owners in turn, then the earliest.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn claim(&self, clock: &WallClock) -> Result<Option<Claimed>, StoreError>;

    /// Renew the lease: it ends a whole lease from now.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn renew(&self, claim: Claim, clock: &WallClock) -> Result<Renewal, StoreError>;

    /// Store the incumbent: the least cost and the greatest bound noted so far. False if the claim is lost.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn note(&self, claim: Claim, incumbent: Incumbent, now: Timestamp) -> Result<bool, StoreError>;

    /// End the job. False if the claim is lost; then nothing changes. Idempotent: true also if this same end was stored
    /// before, so that a call whose answer was lost can be repeated.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn finish(&self, claim: Claim, end: &End, now: Timestamp) -> Result<bool, StoreError>;

    /// Queue the job again at its old place, as if it had not been claimed. False if the claim is lost.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn hand_back(&self, claim: Claim, now: Timestamp) -> Result<bool, StoreError>;

    /// Handle expiry: leases and jobs.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn sweep(&self, now: Timestamp) -> Result<Swept, StoreError>;

    /// Take a due callback under a lease.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn take_callback(&self, lease: Duration, clock: &WallClock) -> Result<Option<Callback>, StoreError>;

    /// Settle a try of a callback.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn settle_callback(&self, id: JobId, attempt: u32, delivery: Delivery) -> Result<(), StoreError>;

    /// Count the jobs.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn counts(&self) -> Result<Counts, StoreError>;

    /// Check that the store answers.
    ///
    /// # Errors
    /// [`StoreError`] if not.
    async fn ping(&self) -> Result<(), StoreError>;

    /// Close the store: running writes end, new ones are refused. If the store is a file, all jobs are then in that one
    /// file, unless another process has it open.
    ///
    /// # Errors
    /// [`StoreError`] if something is left open, or the log remains beside the file.
    async fn close(&self) -> Result<(), StoreError>;

    /// Wakes tasks when something changes, here and, if the store supports it, on other servers. Only hints: waiting
    /// tasks must also poll.
    fn hints(&self) -> &Hints;
}
