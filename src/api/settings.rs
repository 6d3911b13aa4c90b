//! What the operator may set.

use core::time::Duration;
use std::path::PathBuf;
use std::thread::available_parallelism;

use super::cors::CorsOrigins;
use crate::jobs::JobSettings;
use crate::tls::TlsSettings;
use crate::wire::RequestLimits;

/// The service's settings.
#[derive(Debug, Clone, PartialEq)]
pub struct ServerSettings {
    /// What a request may ask for.
    pub limits: RequestLimits,
    /// Where jobs are kept and how they run.
    pub jobs: JobSettings,
    /// The file with the keys of those who may call; without one everybody may.
    pub api_keys_file: Option<PathBuf>,
    /// Which pages may call from a browser.
    pub cors_origins: CorsOrigins,
    /// The files with certificates.
    pub tls: TlsSettings,
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
    /// How long what runs has to end once the service is to shut down.
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
            // What a cell of robots asks at once. A longer queue helps nobody: who would wait past its deadline is refused
            // whatever the room.
            queue: 64,
            // 10,000 objects, the most of a scene, with ids of 100 characters each.
            max_body_bytes: 4_000_000,
            // 10,000 robots that rest between two plans, and some that reconnect meanwhile. Each costs some 13 kB, or 22 kB
            // with TLS, and a file descriptor.
            connections: 12_000,
            // Whoever waits is a connection and some kB.
            max_waiting: 1000,
            max_streams: 1000,
            // Time for two packets to be lost and sent again; a client that takes longer is broken, or means harm.
            header_timeout: Duration::from_secs(5),
            // The largest body at 6.4 Mbit/s.
            body_timeout: Duration::from_secs(5),
            // A client on a bad line takes some bytes in this time; one that takes none has gone, or means harm.
            write_timeout: Duration::from_secs(30),
            // What container managers wait between asking a process to end and killing it is this or longer.
            drain: Duration::from_secs(10),
        }
    }
}
