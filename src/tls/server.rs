//! From the contents of the files to what a connection begins with.

use core::fmt::Write;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use rustls::crypto::{CryptoProvider, ring};
use rustls::pki_types::pem::PemObject;
use rustls::pki_types::{CertificateDer, PrivateKeyDer};
use rustls::server::WebPkiClientVerifier;
use rustls::server::danger::ClientCertVerifier;
use rustls::{RootCertStore, ServerConfig, version};
use sha2::{Digest, Sha256};

/// Why TLS can't be spoken. Says nothing of what stands in a key's file.
#[derive(Debug, thiserror::Error)]
pub enum TlsError {
    /// Not all files are named.
    #[error("{0}")]
    Incomplete(&'static str),
    /// A file can't be read.
    #[error(transparent)]
    Unread(#[from] io::Error),
    /// A file does not hold what it should.
    #[error("{}: {detail}", .path.display())]
    Unfit {
        /// Which file.
        path: PathBuf,
        /// What is wrong with it.
        detail: String,
    },
}

fn unfit(path: &Path, detail: impl ToString) -> TlsError {
    TlsError::Unfit { path: path.to_owned(), detail: detail.to_string() }
}

/// How connections begin, and by what the operator knows the certificate again: SHA-256, as openssl prints it.
pub(super) struct Server {
    pub(super) config: Arc<ServerConfig>,
    pub(super) fingerprint: String,
}

impl Server {
    /// From the files of [`TlsSettings`](super::TlsSettings), in their order.
    ///
    /// # Errors
    /// If one of them holds something else than it should, or the key is not the certificate's.
    ///
    /// # Panics
    /// Never: ring speaks TLS 1.3.
    pub(super) fn new(paths: &[PathBuf], contents: &[Vec<u8>]) -> Result<Self, TlsError> {
        let mut files = paths.iter().map(PathBuf::as_path).zip(contents);
        let missing = TlsError::Incomplete("a certificate and its key are needed");
        let (Some((cert, chain)), Some((key, secret))) = (files.next(), files.next()) else { return Err(missing) };
        let chain = certificates(cert, chain)?;
        let fingerprint = fingerprint(&chain[0]);
        // What the parser has to say may hold a line of the file.
        let no_key = "no private key in PEM (PKCS#8, SEC1 or PKCS#1, not encrypted)";
        let secret = PrivateKeyDer::from_pem_slice(secret).map_err(|_| unfit(key, no_key))?;
        let provider = Arc::new(ring::default_provider());
        let versions =
            ServerConfig::builder_with_provider(Arc::clone(&provider)).with_protocol_versions(&[&version::TLS13]);
        let clients = match files.next() {
            Some((path, authorities)) => client_verifier(path, authorities, provider)?,
            None => WebPkiClientVerifier::no_client_auth(),
        };
        let config = versions.expect("ring speaks TLS 1.3").with_client_cert_verifier(clients);
        let config = config.with_single_cert(chain, secret);
        let mut config = config.map_err(|error| unfit(key, format!("with {}: {error}", cert.display())))?;
        config.alpn_protocols = vec![b"http/1.1".to_vec()];
        Ok(Self { config: Arc::new(config), fingerprint })
    }
}

/// All certificates in a file, at least one.
fn certificates(path: &Path, pem: &[u8]) -> Result<Vec<CertificateDer<'static>>, TlsError> {
    let found = CertificateDer::pem_slice_iter(pem).collect::<Result<Vec<_>, _>>();
    match found {
        Ok(found) if !found.is_empty() => Ok(found),
        // Somebody may have named the key's file here, so this does not say what the parser has to say either.
        _ => Err(unfit(path, "no certificate in PEM, or one that is broken")),
    }
}

/// Clients show certificates of these authorities or none. Whoever shows none is refused request by request, since probes
/// are answered all the same.
fn client_verifier(
    path: &Path,
    pem: &[u8],
    provider: Arc<CryptoProvider>,
) -> Result<Arc<dyn ClientCertVerifier>, TlsError> {
    let mut authorities = RootCertStore::empty();
    for authority in certificates(path, pem)? {
        authorities.add(authority).map_err(|error| unfit(path, error))?;
    }
    let verifier = WebPkiClientVerifier::builder_with_provider(Arc::new(authorities), provider);
    verifier.allow_unauthenticated().build().map_err(|error| unfit(path, error))
}

fn fingerprint(certificate: &CertificateDer<'_>) -> String {
    let mut text = String::new();
    for byte in Sha256::digest(certificate) {
        let colon = if text.is_empty() { "" } else { ":" };
        // Nothing is wrong with a string as a place to write to.
        let _ = write!(text, "{colon}{byte:02X}");
    }
    text
}
