//! TLS handshakes of new connections.

use std::io;
use std::sync::Arc;

use rustls::pki_types::{CertificateDer, UnixTime};
use tokio::io::{AsyncRead, AsyncWrite};
use tokio::sync::watch;
use tokio_rustls::TlsAcceptor;
use tokio_rustls::server::TlsStream;

use super::server::Server;

/// Accepts connections with the current certificate.
#[derive(Clone)]
pub struct Acceptor(watch::Receiver<Arc<Server>>);

/// A connection after its handshake.
pub struct Accepted<S> {
    /// The encrypted stream.
    pub stream: TlsStream<S>,
    /// The client's certificate.
    pub client_certificate: Option<ClientCertificate>,
}

/// A client's certificate, signed by a listed authority at the time of the handshake.
pub struct ClientCertificate {
    /// The client's own certificate first.
    chain: Vec<CertificateDer<'static>>,
    checked_by: Arc<Server>,
    server: watch::Receiver<Arc<Server>>,
}

impl ClientCertificate {
    /// True while one of the authorities listed now has signed it. If files were replaced since the handshake, it is
    /// verified again at each request, with its dates: clients of an authority that is still listed keep their
    /// connections.
    pub fn holds(&self) -> bool {
        let server = Arc::clone(&self.server.borrow());
        let Some((own, others)) = self.chain.split_first() else { return false };
        Arc::ptr_eq(&server, &self.checked_by)
            || server.clients.verify_client_cert(own, others, UnixTime::now()).is_ok()
    }
}

impl Acceptor {
    pub(super) fn new(server: watch::Receiver<Arc<Server>>) -> Self {
        Self(server)
    }

    /// Do the handshake. Takes as long as the client does.
    ///
    /// # Errors
    /// If the client lacks TLS 1.3, shows a certificate of an unknown authority, or disconnects.
    pub async fn accept<S: AsyncRead + AsyncWrite + Unpin>(&self, stream: S) -> io::Result<Accepted<S>> {
        let server = Arc::clone(&self.0.borrow());
        let stream = TlsAcceptor::from(Arc::clone(&server.config)).accept(stream).await?;
        let chain = stream.get_ref().1.peer_certificates().map(<[_]>::to_vec);
        let client_certificate =
            chain.map(|chain| ClientCertificate { chain, checked_by: server, server: self.0.clone() });
        Ok(Accepted { stream, client_certificate })
    }
}
