//! The HTTP client of callbacks and of the health check: the authorities that it trusts, and for callbacks the
//! addresses that it may call. It connects only to addresses from [`AllowedAddresses`], so no second DNS answer can
//! slip in between check and call.

use core::error::Error;
use std::io;
use std::net::{IpAddr, SocketAddr, ToSocketAddrs};
use std::sync::Arc;
use std::thread;

use reqwest::ClientBuilder;
use reqwest::dns::{Addrs, Name, Resolve, Resolving};
use rustls::crypto::ring;
use rustls::{ClientConfig, RootCertStore};
use tokio::sync::{Semaphore, oneshot};

use super::allow::CallbackAllow;

/// The addresses of a name.
pub(super) type Lookup = fn(&str) -> io::Result<Vec<IpAddr>>;

/// Lookups at a time. A lookup that hangs keeps its thread as long as the system likes, so the threads are limited.
const MAX_LOOKUPS: usize = 32;

/// A client that trusts these authorities and uses no proxy: a proxy from the environment would look up the wrong
/// machine, or call a receiver that is not allowed. The default of reqwest requires root certificates even without TLS,
/// so all our clients are built here.
///
/// # Panics
/// Never: ring speaks every version of TLS that rustls asks for.
pub fn client_builder(roots: RootCertStore) -> ClientBuilder {
    let config = ClientConfig::builder_with_provider(Arc::new(ring::default_provider()));
    let config = config.with_safe_default_protocol_versions().expect("ring speaks TLS 1.2 and 1.3");
    client_builder_with(config.with_root_certificates(roots).with_no_client_auth())
}

/// A client with this TLS configuration and no proxy.
pub(crate) fn client_builder_with(config: ClientConfig) -> ClientBuilder {
    ClientBuilder::new().tls_backend_preconfigured(config).no_proxy()
}

/// The authorities that this machine trusts; empty if it has no certificate files.
pub fn trusted_roots() -> RootCertStore {
    let mut roots = RootCertStore::empty();
    let found = rustls_native_certs::load_native_certs();
    for fault in &found.errors {
        tracing::debug!(%fault, "certificates of authorities were not read");
    }
    roots.add_parsable_certificates(found.certs);
    roots
}

/// The root cause: "connection refused" instead of "error sending request", which also holds the URL.
pub(crate) fn innermost<'a>(error: &'a (dyn Error + 'static)) -> &'a (dyn Error + 'static) {
    let mut cause = error;
    while let Some(source) = cause.source() {
        cause = source;
    }
    cause
}

/// Resolves the hosts of callbacks and refuses addresses that the list does not allow.
pub(super) struct AllowedAddresses {
    allow: Arc<CallbackAllow>,
    lookup: Lookup,
    threads: Arc<Semaphore>,
}

impl AllowedAddresses {
    pub(super) fn new(allow: Arc<CallbackAllow>, lookup: Lookup) -> Self {
        Self { allow, lookup, threads: Arc::new(Semaphore::new(MAX_LOOKUPS)) }
    }
}

/// The system's resolver.
pub(super) fn system(name: &str) -> io::Result<Vec<IpAddr>> {
    Ok((name, 0).to_socket_addrs()?.map(|address| address.ip()).collect())
}

impl Resolve for AllowedAddresses {
    fn resolve(&self, name: Name) -> Resolving {
        let (allow, lookup, threads) = (Arc::clone(&self.allow), self.lookup, Arc::clone(&self.threads));
        Box::pin(async move {
            let name = name.as_str().to_owned();
            let addresses = on_a_thread(lookup, name.clone(), threads).await?;
            if addresses.is_empty() {
                return Err(format!("'{name}' has no address").into());
            }
            allow.check_addresses(&name, &addresses)?;
            Ok(Box::new(addresses.into_iter().map(|address| SocketAddr::new(address, 0))) as Addrs)
        })
    }
}

/// Runs on its own thread: on a thread of the runtime a hanging lookup would keep the process from ending.
async fn on_a_thread(
    lookup: Lookup,
    name: String,
    threads: Arc<Semaphore>,
) -> Result<Vec<IpAddr>, Box<dyn Error + Send + Sync>> {
    let permit = threads.acquire_owned().await?;
    let (done, outcome) = oneshot::channel();
    thread::Builder::new().name("lookup".to_owned()).spawn(move || {
        // The caller may have stopped waiting.
        let _ = done.send(lookup(&name));
        drop(permit);
    })?;
    Ok(outcome.await??)
}
