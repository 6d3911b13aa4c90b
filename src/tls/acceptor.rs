//! The beginning of a connection.

use std::io;
use std::sync::Arc;

use rustls::pki_types::{CertificateDer, UnixTime};
use tokio::io::{AsyncRead, AsyncWrite};
use tokio::sync::watch;
use tokio_rustls::TlsAcceptor;
use tokio_rustls::server::TlsStream;

use super::server::Server;

/// Accepts connections with the certificate that is current.
#[derive(Clone)]
pub struct Acceptor(watch::Receiver<Arc<Server>>);

/// A connection once both sides have agreed.
pub struct Accepted<S> {
    /// What to speak over.
    pub stream: TlsStream<S>,
    /// What the client has shown.
    pub client_certificate: Option<ClientCertificate>,
}

/// A client's certificate: when it was shown, one of the authorities had signed it.
pub struct ClientCertificate {
    /// The client's own first.
    chain: Vec<CertificateDer<'static>>,
    checked_by: Arc<Server>,
    server: watch::Receiver<Arc<Server>>,
}

impl ClientCertificate {
    /// True as long as one of the authorities that are listed now has signed it. Where files have been replaced since,
    /// it is checked again at each request, its dates too: clients of an authority that is still listed go on with the connections they have.
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

    /// Agree with a client. Takes as long as the client does.
    ///
    /// # Errors
    /// If the client speaks no TLS 1.3, or shows a certificate of a stranger, or goes away.
    pub async fn accept<S: AsyncRead + AsyncWrite + Unpin>(&self, stream: S) -> io::Result<Accepted<S>> {
        let server = Arc::clone(&self.0.borrow());
        let stream = TlsAcceptor::from(Arc::clone(&server.config)).accept(stream).await?;
        let chain = stream.get_ref().1.peer_certificates().map(<[_]>::to_vec);
        let client_certificate =
            chain.map(|chain| ClientCertificate { chain, checked_by: server, server: self.0.clone() });
        Ok(Accepted { stream, client_certificate })
    }
}
