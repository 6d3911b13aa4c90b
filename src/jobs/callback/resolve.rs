//! Resolves the hosts of callbacks, and refuses what may not be called. The client connects to what this gives and
//! nowhere else, so no second answer can slip in between the check and the call.

use core::error::Error;
use std::io;
use std::net::{IpAddr, SocketAddr, ToSocketAddrs};
use std::sync::Arc;
use std::thread;

use reqwest::dns::{Addrs, Name, Resolve, Resolving};
use tokio::sync::{Semaphore, oneshot};

use super::allow::CallbackAllow;

/// The addresses of a name.
pub(super) type Lookup = fn(&str) -> io::Result<Vec<IpAddr>>;

/// Lookups at a time. One that hangs keeps its thread for as long as the system likes, so there must not be many.
const MAX_LOOKUPS: usize = 32;

/// Resolves what the list allows.
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

/// As the system resolves it.
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

/// On a thread of its own and not one of the runtime's, which would keep the process from ending while a lookup hangs.
async fn on_a_thread(
    lookup: Lookup,
    name: String,
    threads: Arc<Semaphore>,
) -> Result<Vec<IpAddr>, Box<dyn Error + Send + Sync>> {
    let permit = threads.acquire_owned().await?;
    let (done, outcome) = oneshot::channel();
    thread::Builder::new().name("lookup".to_owned()).spawn(move || {
        // Nobody may be waiting any more.
        let _ = done.send(lookup(&name));
        drop(permit);
    })?;
    Ok(outcome.await??)
}
