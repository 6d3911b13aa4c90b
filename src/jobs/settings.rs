//! The operator's settings for jobs.

use core::time::Duration;
use std::thread::available_parallelism;

use super::callback::{CallbackAllow, CallbackSecret};

/// The settings of jobs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct JobSettings {
    /// The store of jobs: `sqlite:PATH`, `sqlite::memory:` or `postgres://…`.
    pub url: String,
    /// Threads that plan for jobs.
    pub threads: usize,
    /// The most queued jobs, over all servers of the store; more are refused.
    pub max_queued: usize,
    /// How long a silent worker keeps its job.
    pub lease: Duration,
    /// How long a job may be queued, and the retention of an ended one.
    pub ttl: Duration,
    /// The allowed receivers of callbacks.
    pub callback_allow: CallbackAllow,
    /// The secret that signs callbacks. Without it there are none.
    pub callback_secret: Option<CallbackSecret>,
}

impl Default for JobSettings {
    fn default() -> Self {
        Self {
            url: "sqlite:singulate.db".to_owned(),
            threads: available_parallelism().map_or(1, usize::from),
            // Half a minute's work of one server with quick jobs; a longer queue would only hide a fault.
            max_queued: 10_000,
            // A lost worker's job waits hardly longer; a live worker renews its lease three times within it.
            lease: Duration::from_secs(10),
            // A caller that waits longer for a table has another table by then.
            ttl: Duration::from_hours(1),
            callback_allow: CallbackAllow::default(),
            callback_secret: None,
        }
    }
}
