//! The service as its clients see it: a real server on a port of its own, in this process.

#![expect(clippy::unwrap_used, reason = "what fails here fails the test")]

mod bodies;
mod browsers;
mod calls;
mod carried_out;
mod connections;
mod described;
mod document;
mod draining;
mod frozen;
mod goals;
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
mod schema;
mod tls;
mod unread;
