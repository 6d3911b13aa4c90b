//! What the operator may set about TLS.

use std::path::PathBuf;

use super::TlsError;

/// The files with certificates, PEM. Without any of them the service speaks plain HTTP.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct TlsSettings {
    /// The service's certificate, followed by those that lead to an authority which clients know.
    pub cert: Option<PathBuf>,
    /// Its private key.
    pub key: Option<PathBuf>,
    /// The authorities whose clients are let in.
    pub client_ca: Option<PathBuf>,
}

impl TlsSettings {
    /// The files: certificate, key, and the clients' authorities if clients need a certificate. None where TLS is not
    /// spoken.
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
