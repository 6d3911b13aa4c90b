//! The client that callbacks and the health check ask with.

use core::error::Error;
use std::sync::Arc;

use reqwest::ClientBuilder;
use rustls::crypto::ring;
use rustls::{ClientConfig, RootCertStore};

/// A client that trusts these authorities, and asks no proxy: one of the environment would be asked about the wrong
/// machine, or on behalf of somebody who may not be told. reqwest's own default wants certificates of authorities even
/// where nobody speaks TLS, so every client of ours is built here.
///
/// # Panics
/// Never: ring speaks every version of TLS that rustls asks for.
pub fn client_builder(roots: RootCertStore) -> ClientBuilder {
    let config = ClientConfig::builder_with_provider(Arc::new(ring::default_provider()));
    let config = config.with_safe_default_protocol_versions().expect("ring speaks TLS 1.2 and 1.3");
    client_builder_with(config.with_root_certificates(roots).with_no_client_auth())
}

/// A client that speaks TLS in this way, and asks no proxy.
pub(crate) fn client_builder_with(config: ClientConfig) -> ClientBuilder {
    ClientBuilder::new().tls_backend_preconfigured(config).no_proxy()
}

/// The authorities that this machine trusts; none where it has no files with them.
pub fn trusted_roots() -> RootCertStore {
    let mut roots = RootCertStore::empty();
    let found = rustls_native_certs::load_native_certs();
    for fault in &found.errors {
        tracing::debug!(%fault, "certificates of authorities were not read");
    }
    roots.add_parsable_certificates(found.certs);
    roots
}

/// The cause that says something: "connection refused" rather than "error sending request", which also holds the URL.
pub(crate) fn innermost<'a>(error: &'a (dyn Error + 'static)) -> &'a (dyn Error + 'static) {
    let mut cause = error;
    while let Some(source) = cause.source() {
        cause = source;
    }
    cause
}
