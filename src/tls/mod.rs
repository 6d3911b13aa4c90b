//! TLS: from files with certificates to connections that nobody else can read.
//!
//! Version 1.3 alone: every client library since 2018 has it, and what it lacks can't go wrong. There is no older version
//! to be talked down to, no renegotiation, no suite that must not be chosen.

mod acceptor;
mod certificates;
mod server;
mod settings;
mod unverified;

pub use acceptor::{Accepted, Acceptor, ClientCertificate};
pub use certificates::Certificates;
pub use server::TlsError;
pub use settings::TlsSettings;
pub use unverified::unverified_client;
