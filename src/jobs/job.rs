//! The data of a job.

use core::fmt;
use core::str::FromStr;

use uuid::Uuid;

use super::timestamp::Timestamp;
use crate::keys::ANONYMOUS;
use crate::wire::RawJson;
use singulate_planner::search::Incumbent;

/// The most attempts of a job. A job that has killed three workers would kill a fourth.
pub const MAX_ATTEMPTS: u32 = 3;

/// A job's id. Ids are ordered by time, to the millisecond.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct JobId(Uuid);

impl JobId {
    /// A new id.
    pub fn new() -> Self {
        Self(Uuid::now_v7())
    }
}

impl Default for JobId {
    fn default() -> Self {
        Self::new()
    }
}

impl fmt::Display for JobId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.as_hyphenated().fmt(f)
    }
}

impl FromStr for JobId {
    type Err = uuid::Error;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        text.parse().map(Self)
    }
}

/// The owner of a job. Owners don't see each other's jobs.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Owner(String);

impl Owner {
    /// The only owner if there are no keys.
    pub fn anonymous() -> Self {
        Self(ANONYMOUS.to_owned())
    }

    /// By name.
    pub fn named(name: impl Into<String>) -> Self {
        Self(name.into())
    }

    /// The owner's name.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

/// The state of a job. The verdict is in the result, not here.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum JobState {
    /// Waits for a worker.
    Queued,
    /// A worker has it.
    Running,
    /// There is an answer, whatever its verdict.
    Succeeded,
    /// There is no answer; the problem says why.
    Failed,
    /// Cancelled by its caller; the best so far is kept.
    Cancelled,
    /// No worker claimed it before it expired.
    Expired,
}

impl JobState {
    /// Every state.
    pub const ALL: [Self; 6] =
        [Self::Queued, Self::Running, Self::Succeeded, Self::Failed, Self::Cancelled, Self::Expired];

    /// Its name on the wire and in the store.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Queued => "queued",
            Self::Running => "running",
            Self::Succeeded => "succeeded",
            Self::Failed => "failed",
            Self::Cancelled => "cancelled",
            Self::Expired => "expired",
        }
    }

    /// True if the state is final.
    pub fn finished(self) -> bool {
        !matches!(self, Self::Queued | Self::Running)
    }
}

impl FromStr for JobState {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        Self::ALL.into_iter().find(|state| state.as_str() == text).ok_or(())
    }
}

/// A validated submission.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NewJob {
    /// Its id.
    pub id: JobId,
    /// Its owner.
    pub owner: Owner,
    /// The caller's `Idempotency-Key` and the job's position in the request, from 0.
    pub key: Option<(String, u32)>,
    /// The digest of the whole request, hexadecimal. A request with the same key must have the same one.
    pub request_sha256: String,
    /// The caller's name for the scene.
    pub scene_id: Option<String>,
    /// The digest of the scene; hexadecimal.
    pub scene_sha256: String,
    /// The planning request as JSON.
    pub body: Vec<u8>,
    /// Jobs of greater priority go first.
    pub priority: i64,
    /// The receiver of the callback.
    pub callback_url: Option<String>,
}

/// A job.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Job {
    /// Its id.
    pub id: JobId,
    /// Its state.
    pub state: JobState,
    /// The caller's name for the scene.
    pub scene_id: Option<String>,
    /// The digest of the scene; hexadecimal.
    pub scene_sha256: String,
    /// When the job was accepted.
    pub created_at: Timestamp,
    /// When the last attempt began.
    pub started_at: Option<Timestamp>,
    /// When the job ended.
    pub finished_at: Option<Timestamp>,
    /// When it expires if it has not begun; once it has ended, when it is deleted.
    pub expires_at: Timestamp,
    /// The number of attempts.
    pub attempts: u32,
    /// Its place in the queue, from 1; only while it is queued.
    pub queue_position: Option<u64>,
    /// The incumbent.
    pub incumbent: Option<Incumbent>,
    /// The answer as JSON.
    pub result: Option<RawJson>,
    /// The problem as JSON.
    pub problem: Option<RawJson>,
    /// The version of the service that ended it.
    pub version: Option<String>,
    /// All events, oldest first. An event's number is its position, from 1.
    pub events: Vec<Event>,
}

/// An event of a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Event {
    /// Its kind.
    pub kind: EventKind,
    /// Its time.
    pub at: Timestamp,
    /// The number of attempts at that time.
    pub attempts: u32,
    /// The incumbent at that time.
    pub incumbent: Option<Incumbent>,
    /// Its place in the queue, from 1; only where it was queued.
    pub queue_position: Option<u64>,
}

/// The kinds of event.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EventKind {
    /// It waits for a worker: new, or after a worker was lost.
    Queued,
    /// A worker began.
    Running,
    /// A better incumbent is known.
    Incumbent,
    /// It ended, in any final state.
    Finished,
}

impl EventKind {
    /// Its name on the wire.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Queued => "queued",
            Self::Running => "running",
            Self::Incumbent => "incumbent",
            Self::Finished => "finished",
        }
    }
}
