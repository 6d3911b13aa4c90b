//! Servers as processes, several of them, that are killed, drained and left without their database: nothing that was
//! accepted is lost, and nothing ends twice.
//!
//! What needs PostgreSQL runs where `TEST_POSTGRES_URL` names a database in which schemas may be made. What takes it
//! away needs `TEST_POSTGRES_RESTART` too: a command for bash that stops it, waits for the end of its input, starts it.

#![expect(clippy::unwrap_used, reason = "what fails here fails the test")]

mod client;
mod crashes;
mod database;
mod drain;
mod ends;
mod events;
mod file;
mod keys;
mod load;
mod outage;
mod replicas;
mod scenes;
mod server;

use core::time::Duration;

/// Long enough for any machine; a test that waits so long has failed.
const PATIENCE: Duration = Duration::from_secs(60);
/// How long to wait before looking again.
const LOOK_AGAIN: Duration = Duration::from_millis(20);
/// Short, so that a killed server's jobs are soon begun again; but no live one says nothing for so long.
const LEASE: [&str; 2] = ["--job-lease-ms", "3000"];
