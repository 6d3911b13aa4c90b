//! TLS: from certificate files to encrypted connections.
//!
//! Version 1.3 alone: every client library since 2018 has it. So there is no downgrade to an older version, no
//! renegotiation, and no weak cipher suite.

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
