//! TLS: from certificate files to encrypted connections.
//!
//! Version 1.3 alone: every client library since 2018 has it. So there is no downgrade to an older version, no
//! renegotiation, and no weak cipher suite.

mod certificates;
mod server;
mod unverified;

pub use certificates::{Accepted, Acceptor, Certificates, ClientCertificate, TlsSettings};
pub use server::TlsError;
pub use unverified::unverified_client;
