//! The service's certificate, from its files to the handshake. It may be replaced while the service runs.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;

use rustls::pki_types::{CertificateDer, UnixTime};
use tokio::io::{AsyncRead, AsyncWrite};
use tokio::sync::watch;
use tokio_rustls::TlsAcceptor;
use tokio_rustls::server::TlsStream;

use super::server::{Server, TlsError};
use crate::watched_files::WatchedFiles;

/// The certificate files, PEM. Without any the service speaks plain HTTP.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct TlsSettings {
    /// The service's certificate, followed by its chain up to an authority that clients know.
    pub cert: Option<PathBuf>,
    /// Its private key.
    pub key: Option<PathBuf>,
    /// The authorities of client certificates.
    pub client_ca: Option<PathBuf>,
}

impl TlsSettings {
    /// The files: certificate, key, and the client authorities if clients need a certificate. `None` without TLS.
    pub(super) fn files(&self) -> Result<Option<Vec<PathBuf>>, TlsError> {
        match (&self.cert, &self.key) {
            (Some(cert), Some(key)) => Ok(Some([cert, key].into_iter().chain(&self.client_ca).cloned().collect())),
            (Some(_), None) => Err(TlsError::Incomplete("tls_cert needs tls_key: the certificate's private key")),
            (None, Some(_)) => Err(TlsError::Incomplete("tls_key needs tls_cert: the certificate of the key")),
            (None, None) if self.client_ca.is_some() => {
                Err(TlsError::Incomplete("tls_client_ca needs tls_cert and tls_key: only TLS knows of certificates"))
            }
            (None, None) => Ok(None),
        }
    }
}

/// The service's certificate with its key, and the client authorities, from the current files.
pub struct Certificates {
    files: WatchedFiles,
    server: watch::Sender<Arc<Server>>,
}

impl Certificates {
    /// Read the files. `None` without TLS.
    ///
    /// # Errors
    /// If files are missing, unreadable, or don't match.
    pub fn read(settings: &TlsSettings) -> Result<Option<Self>, TlsError> {
        let Some(paths) = settings.files()? else { return Ok(None) };
        let files = WatchedFiles::read(paths)?;
        let server = watch::Sender::new(Arc::new(Server::new(files.paths(), files.contents())?));
        Ok(Some(Self { files, server }))
    }

    /// An acceptor that always uses the current certificate.
    pub fn acceptor(&self) -> Acceptor {
        Acceptor(self.server.subscribe())
    }

    /// Reload the files for ever. Open connections survive a new certificate, except those of clients whose authority
    /// is no longer listed. Files that don't match change nothing: perhaps only one of them is written yet.
    pub async fn keep_current(mut self) {
        tracing::info!(sha256 = %self.server.borrow().fingerprint, "certificate");
        loop {
            self.files.changed().await;
            if let Err(error) = self.replace() {
                tracing::error!(%error, "the certificate was not replaced");
            }
        }
    }

    fn replace(&mut self) -> Result<(), TlsError> {
        let server = Server::new(self.files.paths(), self.files.contents())?;
        tracing::info!(sha256 = %server.fingerprint, "certificate replaced");
        self.server.send_replace(Arc::new(server));
        Ok(())
    }
}

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
