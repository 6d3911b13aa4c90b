//! What the operator may set about jobs.

use core::time::Duration;
use std::thread::available_parallelism;

use super::callback::{CallbackAllow, CallbackSecret};

/// The settings of jobs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct JobSettings {
    /// Where jobs are kept: `sqlite:PATH`, `sqlite::memory:` or `postgres://…`.
    pub url: String,
    /// Threads that plan for jobs.
    pub threads: usize,
    /// Jobs that may wait, on all servers of the store together; more are refused.
    pub max_queued: usize,
    /// For how long a worker that says nothing keeps its job.
    pub lease: Duration,
    /// How long a job may wait, and for how long an ended one is kept.
    pub ttl: Duration,
    /// Who may be told of the end of a job.
    pub callback_allow: CallbackAllow,
    /// How they know that it is us. There are no callbacks without.
    pub callback_secret: Option<CallbackSecret>,
}

impl Default for JobSettings {
    fn default() -> Self {
        Self {
            url: "sqlite:singulate.db".to_owned(),
            threads: available_parallelism().map_or(1, usize::from),
            // Half a minute's work of one server where jobs are quick; a longer queue would only hide that something is wrong.
            max_queued: 10_000,
            // A lost worker's job waits hardly longer; a worker that lives renews it three times over.
            lease: Duration::from_secs(10),
            // Whoever waits longer for a table has another table by then.
            ttl: Duration::from_hours(1),
            callback_allow: CallbackAllow::default(),
            callback_secret: None,
        }
    }
}
