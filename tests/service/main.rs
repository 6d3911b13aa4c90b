//! The service as its clients see it: a real server on a port of its own, in this process.

#![expect(clippy::unwrap_used, reason = "what fails here fails the test")]

mod bodies;
mod browsers;
mod connections;
mod document;
mod draining;
mod golden;
mod hard;
mod haste;
mod host;
mod hostile;
mod jobs;
mod keys;
mod knowledge;
mod metrics;
mod negotiation;
mod planning;
mod tls;
mod unread;
