//! What the operator may set.

use core::time::Duration;
use std::thread::available_parallelism;

use crate::jobs::JobSettings;
use crate::wire::RequestLimits;

/// The service's settings.
#[derive(Debug, Clone, PartialEq)]
pub struct ServerSettings {
    /// What a request may ask for.
    pub limits: RequestLimits,
    /// Where jobs are kept and how they run.
    pub jobs: JobSettings,
    /// Planning threads.
    pub threads: usize,
    /// Requests that may wait for a planning thread; more are refused.
    pub queue: usize,
    /// The largest body, bytes.
    pub max_body_bytes: usize,
    /// Connections at a time; more wait to be accepted.
    pub connections: usize,
    /// Clients that may wait for the ends of jobs at a time: each is a connection and some kB.
    pub max_waiting: usize,
    /// Clients that may listen to events at a time: each is a connection, and may hold up to a job's size.
    pub max_streams: usize,
    /// How long a request's head may take, counted from its first byte; for the first request from the connection's start.
    pub header_timeout: Duration,
    /// How long a request's body may take.
    pub body_timeout: Duration,
    /// How long a client may take nothing of an answer that waits for it.
    pub write_timeout: Duration,
}

impl Default for ServerSettings {
    fn default() -> Self {
        Self {
            limits: RequestLimits::default(),
            jobs: JobSettings::default(),
            threads: available_parallelism().map_or(1, usize::from),
            queue: 64,
            max_body_bytes: 4_000_000,
            connections: 1024,
            max_waiting: 1000,
            max_streams: 1000,
            header_timeout: Duration::from_secs(5),
            body_timeout: Duration::from_secs(10),
            write_timeout: Duration::from_secs(30),
        }
    }
}
