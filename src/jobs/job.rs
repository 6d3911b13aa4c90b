//! What a job is.

use core::fmt;
use core::str::FromStr;

use uuid::Uuid;

use super::timestamp::Timestamp;
use crate::wire::RawJson;
use singulate_planner::search::Incumbent;

/// How often a job may be begun. Whatever ended three workers would end a fourth.
pub const MAX_ATTEMPTS: u32 = 3;

/// A job's name. Later jobs have greater ids, to the millisecond.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct JobId(Uuid);

impl JobId {
    /// A new one.
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

/// Who handed a job in. Nobody sees another's jobs.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Owner(String);

impl Owner {
    /// Everybody, as long as there are no keys.
    pub fn anonymous() -> Self {
        Self("anonymous".to_owned())
    }

    /// By name.
    pub fn named(name: impl Into<String>) -> Self {
        Self(name.into())
    }

    /// The name.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

/// Where a job stands. The verdict is in the result, never here.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum JobState {
    /// Waits for a worker.
    Queued,
    /// A worker has it.
    Running,
    /// There is an answer, whatever its verdict.
    Succeeded,
    /// There is none, and a problem says why.
    Failed,
    /// Its caller wanted no more of it; the best so far is kept.
    Cancelled,
    /// No worker had it before its time was over.
    Expired,
}

impl JobState {
    /// Every state.
    pub const ALL: [Self; 6] =
        [Self::Queued, Self::Running, Self::Succeeded, Self::Failed, Self::Cancelled, Self::Expired];

    /// As it is written everywhere.
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

    /// True if nothing more will happen to the job.
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

/// What somebody hands in, checked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NewJob {
    /// Its name.
    pub id: JobId,
    /// Who hands it in.
    pub owner: Owner,
    /// The caller's `Idempotency-Key` and which job of its request this is, from 0.
    pub key: Option<(String, u32)>,
    /// The digest of the whole request, which a repeated key must repeat; hexadecimal.
    pub request_sha256: String,
    /// The caller's name for the scene.
    pub scene_id: Option<String>,
    /// The digest of the scene; hexadecimal.
    pub scene_sha256: String,
    /// The planning request as JSON.
    pub body: Vec<u8>,
    /// Greater goes first.
    pub priority: i64,
    /// Who is told of its end.
    pub callback_url: Option<String>,
}

/// A job as it stands.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Job {
    /// Its name.
    pub id: JobId,
    /// Where it stands.
    pub state: JobState,
    /// The caller's name for the scene.
    pub scene_id: Option<String>,
    /// The digest of the scene; hexadecimal.
    pub scene_sha256: String,
    /// When it was accepted.
    pub created_at: Timestamp,
    /// When its last attempt began.
    pub started_at: Option<Timestamp>,
    /// When it ended.
    pub finished_at: Option<Timestamp>,
    /// When it ends unless it has begun by then; once it has ended, when it is forgotten.
    pub expires_at: Timestamp,
    /// How often a worker began.
    pub attempts: u32,
    /// How many jobs are to be taken before it and itself; only while it is queued.
    pub queue_position: Option<u64>,
    /// The best so far.
    pub incumbent: Option<Incumbent>,
    /// The answer as JSON.
    pub result: Option<RawJson>,
    /// The problem as JSON.
    pub problem: Option<RawJson>,
    /// The version of the service that ended it.
    pub version: Option<String>,
    /// All that has happened, first things first. The event's number is its place in the list, from 1.
    pub events: Vec<Event>,
}

/// What happened to a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Event {
    /// What.
    pub kind: EventKind,
    /// When.
    pub at: Timestamp,
    /// The attempts at that time.
    pub attempts: u32,
    /// The best by that time.
    pub incumbent: Option<Incumbent>,
    /// How many jobs were to be taken before it and itself; only where it was queued.
    pub queue_position: Option<u64>,
}

/// The kinds of event.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EventKind {
    /// It waits for a worker: new, or after a worker was lost.
    Queued,
    /// A worker began.
    Running,
    /// A better set or a better bound is known.
    Incumbent,
    /// It ended, whatever way.
    Finished,
}

impl EventKind {
    /// As it is written everywhere.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Queued => "queued",
            Self::Running => "running",
            Self::Incumbent => "incumbent",
            Self::Finished => "finished",
        }
    }
}
