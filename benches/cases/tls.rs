//! A server that speaks TLS, and connections to it.

use std::fs;
use std::net::{SocketAddr, TcpStream};
use std::sync::Arc;

use rustls::crypto::ring;
use rustls::pki_types::ServerName;
use rustls::{ClientConfig, ClientConnection, RootCertStore, StreamOwned};

use crate::client::Client;
use crate::server::Server;

/// A server with a certificate of its own, and what trusts it.
pub(crate) struct TlsServer {
    pub(crate) server: Server,
    trust: Arc<ClientConfig>,
}

impl TlsServer {
    pub(crate) fn start() -> Self {
        let certified = rcgen::generate_simple_self_signed(["localhost".to_owned()]).expect("a certificate");
        let [cert, key] = ["cert", "key"].map(|name| format!("{}/idle-{name}.pem", env!("CARGO_TARGET_TMPDIR")));
        fs::write(&cert, certified.cert.pem()).expect("a file");
        fs::write(&key, certified.signing_key.serialize_pem()).expect("a file");
        let mut roots = RootCertStore::empty();
        roots.add(certified.cert.der().clone()).expect("a root");
        let trust = ClientConfig::builder_with_provider(Arc::new(ring::default_provider()))
            .with_safe_default_protocol_versions();
        let trust = trust.expect("ring speaks TLS").with_root_certificates(roots).with_no_client_auth();
        let server = Server::start("sqlite::memory:", &["--tls-cert", &cert, "--tls-key", &key]);
        Self { server, trust: Arc::new(trust) }
    }

    pub(crate) fn connect(&self) -> Client<StreamOwned<ClientConnection, TcpStream>> {
        let name = ServerName::try_from("localhost").expect("a name");
        let agreed = ClientConnection::new(Arc::clone(&self.trust), name).expect("a client");
        let address: SocketAddr = self.server.address();
        Client::over(StreamOwned::new(agreed, TcpStream::connect(address).expect("the server listens")))
    }
}
