//! What keeps jobs has to promise.
//!
//! States change as in this table and no other way; each change is one transaction, on disk before its call returns.
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
//! A fence is a number that grows with each claim of a job. A worker that lost its lease holds an old one, and nothing
//! that it says counts any more: no job ends twice.

use core::time::Duration;

use async_trait::async_trait;

use super::end::End;
use super::hints::Hints;
use super::job::{Job, JobId, JobState, NewJob, Owner};
use super::timestamp::{Timestamp, WallClock};
use singulate_planner::search::Incumbent;

/// The most events of incumbents of one job; what comes later still is the job's `incumbent`.
pub const MAX_INCUMBENT_EVENTS: usize = 100;

/// The store could not be asked, or not answer. What was to be changed has mostly not been: who waits too long gives up, and
/// it is rolled back. But it may have been, if the commit itself was under way.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the store of jobs: {0}")]
pub struct StoreError(pub String);

/// Why jobs were not accepted. None of them was.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SubmitError {
    /// As many jobs wait as may.
    #[error("the queue of jobs is full")]
    Full,
    /// The idempotency key came with another request before.
    #[error("the idempotency key belongs to another request")]
    KeyReused,
    /// The store failed.
    #[error(transparent)]
    Store(#[from] StoreError),
}

/// The right to run a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Claim {
    /// Which job.
    pub id: JobId,
    /// Grows with each claim of the job.
    pub fence: i64,
}

/// A job for a worker.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Claimed {
    /// The right to it.
    pub claim: Claim,
    /// Who handed it in.
    pub owner: Owner,
    /// The planning request as JSON.
    pub body: Vec<u8>,
    /// Which attempt this is, from 1.
    pub attempt: u32,
    /// When it was accepted.
    pub created_at: Timestamp,
}

/// What became of a lease.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Renewal {
    /// It is longer now.
    Held,
    /// It is longer now, and the caller wants no more than the best so far.
    Cancelled,
    /// Somebody else has the job, or nobody.
    Lost,
}

/// What became of a wish to cancel.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Cancellation {
    /// There is no such job.
    Unknown,
    /// It had ended before.
    Finished,
    /// It is cancelled, or will be once its worker has delivered the best so far.
    Accepted(Box<Job>),
}

/// What became of a wish to forget.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Removal {
    /// There is no such job.
    Unknown,
    /// It has not ended.
    Unfinished,
    /// It is forgotten, and so is its idempotency key.
    Forgotten,
}

/// Which jobs to list, the latest first, without their results.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Page {
    /// Only those in this state.
    pub state: Option<JobState>,
    /// Only those before this one.
    pub before: Option<JobId>,
    /// At most so many.
    pub limit: usize,
}

/// A callback that is due.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Callback {
    /// The ended job.
    pub job: Job,
    /// Who is told.
    pub url: String,
    /// Which try this is, from 1.
    pub attempt: u32,
}

/// What became of a try to deliver a callback.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Delivery {
    /// It arrived, or never will: no more tries.
    Over,
    /// Try again then.
    Again(Timestamp),
}

/// What a sweep has changed.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Swept {
    /// Lost by their workers and queued again.
    pub requeued: Vec<JobId>,
    /// Ended three workers.
    pub poisoned: Vec<JobId>,
    /// Lost by their workers after they were cancelled.
    pub cancelled: Vec<JobId>,
    /// Waited too long.
    pub expired: Vec<JobId>,
    /// Forgotten.
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

/// Keeps jobs. Every call is one transaction, but for `sweep`, which is one a batch; `now` is the caller's time.
#[async_trait]
pub trait Store: Send + Sync + 'static {
    /// Accept all jobs of one request, or none. Where the first one's key is known with the same digest, they are the jobs
    /// that were accepted then.
    ///
    /// # Errors
    /// [`SubmitError`].
    async fn submit(&self, jobs: &[NewJob], now: Timestamp) -> Result<Vec<Job>, SubmitError>;

    /// A job of the owner's.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn get(&self, owner: &Owner, id: JobId) -> Result<Option<Job>, StoreError>;

    /// The owner's jobs.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn list(&self, owner: &Owner, page: Page) -> Result<Vec<Job>, StoreError>;

    /// Cancel a job: a queued one at once, a running one once its worker knows.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn cancel(&self, owner: &Owner, id: JobId, now: Timestamp) -> Result<Cancellation, StoreError>;

    /// Forget a job that has ended.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn forget(&self, owner: &Owner, id: JobId) -> Result<Removal, StoreError>;

    /// Take the next job: the greatest priority first, then owners in turn, then the earliest.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn claim(&self, clock: &WallClock) -> Result<Option<Claimed>, StoreError>;

    /// Make the lease end a whole lease after now.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn renew(&self, claim: Claim, clock: &WallClock) -> Result<Renewal, StoreError>;

    /// Keep the best so far: the least cost and the greatest bound of all that was noted. False if the claim is lost.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn note(&self, claim: Claim, incumbent: Incumbent, now: Timestamp) -> Result<bool, StoreError>;

    /// End the job. False if the claim is lost; then nothing changes. True also where this same end was kept before, so
    /// that a call whose answer was lost can be repeated.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn finish(&self, claim: Claim, end: &End, now: Timestamp) -> Result<bool, StoreError>;

    /// Queue the job again, as if it had not been claimed, in the place that it had. False if the claim is lost.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn hand_back(&self, claim: Claim, now: Timestamp) -> Result<bool, StoreError>;

    /// See to what time has brought: leases, jobs and callbacks that are over.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn sweep(&self, now: Timestamp) -> Result<Swept, StoreError>;

    /// Take a callback that is due. Nobody else gets it before `lease` has passed.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn take_callback(&self, lease: Duration, clock: &WallClock) -> Result<Option<Callback>, StoreError>;

    /// What became of a callback's try.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn settle_callback(&self, id: JobId, attempt: u32, delivery: Delivery) -> Result<(), StoreError>;

    /// How many jobs there are.
    ///
    /// # Errors
    /// [`StoreError`].
    async fn counts(&self) -> Result<Counts, StoreError>;

    /// Does the store answer?
    ///
    /// # Errors
    /// [`StoreError`] if not.
    async fn ping(&self) -> Result<(), StoreError>;

    /// Be done with it: what is being written is ended, nothing more is accepted. Where the store is a file, all jobs are in
    /// that one file then, unless another process has it open.
    ///
    /// # Errors
    /// [`StoreError`] if something is left open, or beside the file.
    async fn close(&self) -> Result<(), StoreError>;

    /// Who is woken when something changes, here and, as far as the store can tell, elsewhere. Only hints: whoever waits
    /// for a change looks again now and then.
    fn hints(&self) -> &Hints;
}
