//! The beginning of a connection.

use std::io;
use std::sync::Arc;

use rustls::ServerConfig;
use tokio::io::{AsyncRead, AsyncWrite};
use tokio::sync::watch;
use tokio_rustls::TlsAcceptor;
use tokio_rustls::server::TlsStream;

/// Accepts connections with the certificate that is current.
#[derive(Clone)]
pub struct Acceptor(watch::Receiver<Arc<ServerConfig>>);

/// A connection once both sides have agreed.
pub struct Accepted<S> {
    /// What to speak over.
    pub stream: TlsStream<S>,
    /// True if the client has shown a certificate of one of the authorities.
    pub client_certificate: bool,
}

impl Acceptor {
    pub(super) fn new(config: watch::Receiver<Arc<ServerConfig>>) -> Self {
        Self(config)
    }

    /// Agree with a client. Takes as long as the client does.
    ///
    /// # Errors
    /// If the client speaks no TLS 1.3, or shows a certificate of a stranger, or goes away.
    pub async fn accept<S: AsyncRead + AsyncWrite + Unpin>(&self, stream: S) -> io::Result<Accepted<S>> {
        let config = Arc::clone(&self.0.borrow());
        let stream = TlsAcceptor::from(config).accept(stream).await?;
        let client_certificate = stream.get_ref().1.peer_certificates().is_some();
        Ok(Accepted { stream, client_certificate })
    }
}
