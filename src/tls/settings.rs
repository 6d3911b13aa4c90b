//! The operator's settings for TLS.

use std::path::PathBuf;

use super::TlsError;

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
