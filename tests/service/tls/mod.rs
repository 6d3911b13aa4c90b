//! The service over TLS.

pub(crate) mod authority;
mod clients;
mod hostile;
mod replacing;
mod requests;

use std::io;
use std::sync::Arc;
use std::time::Instant;

use rustls::ClientConfig;
use rustls::pki_types::ServerName;
use singulate::api::{Engine, ServerSettings};
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;
use tokio::time::timeout;
use tokio_rustls::TlsConnector;
use tokio_rustls::client::TlsStream;

use crate::host::{Host, PATIENCE};
use authority::Authority;

const LIVEZ: &str = "GET /livez HTTP/1.1\r\nhost: x\r\n\r\n";
const LAST_LIVEZ: &str = "GET /livez HTTP/1.1\r\nhost: x\r\nconnection: close\r\n\r\n";

/// A service with a certificate of the authority, whose own client trusts it.
pub(crate) async fn secure_host(authority: &Authority, settings: ServerSettings, engine: Engine) -> Host {
    let tls = if settings.tls.cert.is_some() { settings.tls } else { authority.service() };
    let mut host = Host::with(ServerSettings { tls, ..settings }, engine).await;
    let config = ClientConfig::clone(&authority.client(None));
    host.client = reqwest::Client::builder().tls_backend_preconfigured(config).build().unwrap();
    host
}

/// A connection of a client's, or why there is none.
pub(crate) async fn connect(host: &Host, client: &Arc<ClientConfig>) -> io::Result<TlsStream<TcpStream>> {
    let stream = TcpStream::connect(host.address).await.unwrap();
    let name = ServerName::try_from("localhost").unwrap();
    timeout(PATIENCE, TlsConnector::from(Arc::clone(client)).connect(name, stream)).await.unwrap()
}

/// A connection on which the text has been sent.
async fn raw(host: &Host, client: &Arc<ClientConfig>, text: &str) -> TlsStream<TcpStream> {
    let mut stream = connect(host, client).await.unwrap();
    stream.write_all(text.as_bytes()).await.unwrap();
    stream
}

/// All that the server sends until it ends the connection, in whatever way.
async fn read_to_end(stream: &mut TlsStream<TcpStream>) -> String {
    let mut bytes = Vec::new();
    let _ = timeout(PATIENCE, stream.read_to_end(&mut bytes)).await.expect("the server ends it");
    String::from_utf8_lossy(&bytes).into_owned()
}

/// True if `/livez` is answered, on a connection that stays open.
async fn answers(stream: &mut TlsStream<TcpStream>) -> bool {
    if stream.write_all(LIVEZ.as_bytes()).await.is_err() {
        return false;
    }
    let mut bytes = Vec::new();
    while !bytes.ends_with(b"{\"status\":\"ok\"}") {
        let read = timeout(PATIENCE, stream.read_buf(&mut bytes)).await.expect("an answer or an end");
        if !read.is_ok_and(|count| count > 0) {
            return false;
        }
    }
    bytes.starts_with(b"HTTP/1.1 200 ")
}

/// A connection that rests after an answer. A service that gives little time may cut off a few before on a busy machine.
async fn rested(host: &Host, client: &Arc<ClientConfig>) -> TlsStream<TcpStream> {
    let started = Instant::now();
    loop {
        if let Ok(mut stream) = connect(host, client).await
            && answers(&mut stream).await
        {
            return stream;
        }
        assert!(started.elapsed() < PATIENCE, "nobody is served");
    }
}

/// Somebody else is answered, on a connection of its own.
async fn others_are_served(host: &Host, client: &Arc<ClientConfig>) {
    drop(rested(host, client).await);
}
