//! The operator's settings for the service.

use core::time::Duration;
use std::path::PathBuf;
use std::thread::available_parallelism;

use super::browsers::CorsOrigins;
use crate::jobs::JobSettings;
use crate::tls::TlsSettings;
use crate::wire::RequestLimits;

/// The service's settings.
#[derive(Debug, Clone, PartialEq)]
pub struct ServerSettings {
    /// Limits on requests.
    pub limits: RequestLimits,
    /// The store of jobs and their limits.
    pub jobs: JobSettings,
    /// The file with the callers' keys; without one, access is open.
    pub api_keys_file: Option<PathBuf>,
    /// The origins whose pages may call from a browser.
    pub cors_origins: CorsOrigins,
    /// The files with certificates.
    pub tls: TlsSettings,
    /// Planning threads.
    pub threads: usize,
    /// The queue for planning threads; more requests are refused.
    pub queue: usize,
    /// The largest body, bytes.
    pub max_body_bytes: usize,
    /// Connections at a time; more are not accepted until one ends.
    pub connections: usize,
    /// Long polls at a time: each is a connection and some kB.
    pub max_waiting: usize,
    /// Event streams at a time: each is a connection, and may hold up to a job's size.
    pub max_streams: usize,
    /// How long a request's head may take, counted from its first byte; for the first request from the connection's start.
    pub header_timeout: Duration,
    /// How long a request's body may take.
    pub body_timeout: Duration,
    /// How long a client may read nothing while an answer is pending.
    pub write_timeout: Duration,
    /// How long running work may take after the shutdown signal.
    pub drain: Duration,
}

impl Default for ServerSettings {
    fn default() -> Self {
        Self {
            limits: RequestLimits::default(),
            jobs: JobSettings::default(),
            api_keys_file: None,
            cors_origins: CorsOrigins::default(),
            tls: TlsSettings::default(),
            threads: available_parallelism().map_or(1, usize::from),
            // One cell's robots at once. A longer queue is useless: requests that would wait past their deadline are
            // refused in any case.
            queue: 64,
            // 10,000 objects, the most of a scene, with ids of 100 characters each.
            max_body_bytes: 4_000_000,
            // 10,000 robots that are idle between two plans, and some that reconnect. Each costs some 13 kB, or 22 kB
            // with TLS, and a file descriptor.
            connections: 12_000,
            // Each costs a connection and some kB.
            max_waiting: 1000,
            max_streams: 1000,
            // Time for two packets to be lost and sent again; a slower client is broken or malicious.
            header_timeout: Duration::from_secs(5),
            // The largest body at 6.4 Mbit/s.
            body_timeout: Duration::from_secs(5),
            // A client on a bad line reads some bytes in this time; one that reads none is gone or malicious.
            write_timeout: Duration::from_secs(30),
            // Container managers wait at least this long between the termination signal and the kill.
            drain: Duration::from_secs(10),
        }
    }
}
