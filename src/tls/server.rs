//! The TLS configuration of the server, from the contents of the files.

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

/// Why TLS can't start. Never shows the content of a key file.
#[derive(Debug, thiserror::Error)]
pub enum TlsError {
    /// Not all files are named.
    #[error("{0}")]
    Incomplete(&'static str),
    /// A file can't be read.
    #[error(transparent)]
    Unread(#[from] io::Error),
    /// A file has the wrong content.
    #[error("{}: {detail}", .path.display())]
    Unfit {
        /// The file.
        path: PathBuf,
        /// The fault.
        detail: String,
    },
}

fn unfit(path: &Path, detail: impl ToString) -> TlsError {
    TlsError::Unfit { path: path.to_owned(), detail: detail.to_string() }
}

/// The TLS configuration, and the fingerprint of the certificate for the log: SHA-256, as openssl prints it.
pub(super) struct Server {
    pub(super) config: Arc<ServerConfig>,
    /// Verifies client certificates.
    pub(super) clients: Arc<dyn ClientCertVerifier>,
    pub(super) fingerprint: String,
}

impl Server {
    /// From the files of [`TlsSettings`](super::TlsSettings), in their order.
    ///
    /// # Errors
    /// If a file has the wrong content, or the key does not match the certificate.
    ///
    /// # Panics
    /// Never: ring speaks TLS 1.3.
    pub(super) fn new(paths: &[PathBuf], contents: &[Vec<u8>]) -> Result<Self, TlsError> {
        let mut files = paths.iter().map(PathBuf::as_path).zip(contents);
        let missing = TlsError::Incomplete("a certificate and its key are needed");
        let (Some((cert, chain)), Some((key, secret))) = (files.next(), files.next()) else { return Err(missing) };
        let chain = certificates(cert, chain)?;
        let fingerprint = fingerprint(&chain[0]);
        // The parser's message may quote a line of the file.
        let no_key = "no private key in PEM (PKCS#8, SEC1 or PKCS#1, not encrypted)";
        let secret = PrivateKeyDer::from_pem_slice(secret).map_err(|_| unfit(key, no_key))?;
        let provider = Arc::new(ring::default_provider());
        let versions =
            ServerConfig::builder_with_provider(Arc::clone(&provider)).with_protocol_versions(&[&version::TLS13]);
        let clients = match files.next() {
            Some((path, authorities)) => client_verifier(path, authorities, provider)?,
            None => WebPkiClientVerifier::no_client_auth(),
        };
        let config = versions.expect("ring speaks TLS 1.3").with_client_cert_verifier(Arc::clone(&clients));
        let config = config.with_single_cert(chain, secret);
        let mut config = config.map_err(|error| unfit(key, format!("with {}: {error}", cert.display())))?;
        config.alpn_protocols = vec![b"http/1.1".to_vec()];
        Ok(Self { config: Arc::new(config), clients, fingerprint })
    }
}

/// All certificates in a file, at least one.
fn certificates(path: &Path, pem: &[u8]) -> Result<Vec<CertificateDer<'static>>, TlsError> {
    let found = CertificateDer::pem_slice_iter(pem).collect::<Result<Vec<_>, _>>();
    match found {
        Ok(found) if !found.is_empty() => Ok(found),
        // The key file may have been named here by mistake, so the parser's message is left out too.
        _ => Err(unfit(path, "no certificate in PEM, or one that is broken")),
    }
}

/// Client certificates are optional at the handshake and must be of these authorities. A client without one is refused
/// request by request, since probes are answered even so.
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
    let pairs: Vec<String> = Sha256::digest(certificate).iter().map(|byte| format!("{byte:02X}")).collect();
    pairs.join(":")
}

#[cfg(test)]
mod tests {
    use rcgen::{CertificateParams, KeyPair, generate_simple_self_signed};

    use super::*;

    /// A certificate and its key, PEM.
    fn pair() -> (String, String) {
        let own = generate_simple_self_signed(["localhost".to_owned()]).unwrap();
        (own.cert.pem(), own.signing_key.serialize_pem())
    }

    fn fault(files: &[&str]) -> String {
        let paths = ["cert.pem", "key.pem", "clients.pem"].map(PathBuf::from);
        let contents: Vec<Vec<u8>> = files.iter().map(|text| text.as_bytes().to_vec()).collect();
        Server::new(&paths[..files.len()], &contents).map_or_else(|error| error.to_string(), |_| String::new())
    }

    #[test]
    fn a_key_that_is_not_the_certificates_is_refused_and_so_is_what_is_no_certificate_or_key() {
        let ((cert, key), (other_cert, other_key)) = (pair(), pair());
        assert_eq!(fault(&[&cert, &key]), "");
        assert_eq!(fault(&[&cert, &key, &other_cert]), "");
        // Both in one file, and a chain that starts with the service's certificate.
        assert_eq!(fault(&[&format!("{key}{cert}{other_cert}"), &format!("{cert}{key}")]), "");
        assert!(fault(&[&format!("{other_cert}{cert}"), &key]).starts_with("key.pem: with cert.pem: "));
        assert!(fault(&[&cert, &other_key]).starts_with("key.pem: with cert.pem: "));
        let broken = cert.replace("MII", "MIX");
        for (files, start) in [
            (&[key.as_str(), &key][..], "cert.pem: no certificate"),
            (&["", &key], "cert.pem: no certificate"),
            (&[&cert[..200], &key], "cert.pem: no certificate"),
            (&[&broken, &key], "key.pem: with cert.pem: "),
            (&[&cert, &cert], "key.pem: no private key"),
            (&[&cert, ""], "key.pem: no private key"),
            (&[&cert, &key, ""], "clients.pem: no certificate"),
            (&[&cert, &key, &key], "clients.pem: no certificate"),
            (&[&cert, &key, &broken], "clients.pem: "),
        ] {
            let fault = fault(files);
            assert!(fault.starts_with(start), "{start}: {fault}");
        }
    }

    #[test]
    fn no_fault_shows_a_line_of_a_key() {
        let (cert, key) = pair();
        let secret: String = key.lines().filter(|line| !line.starts_with('-')).collect();
        let one_line = key.replace('\n', "");
        let garbled = key.replace("PRIVATE KEY-----\n", &format!("PRIVATE KEY-----{}", &secret[..40]));
        let shortened = format!("-----BEGIN PRIVATE KEY-----\n{}\n-----END PRIVATE KEY-----\n", &secret[..80]);
        for broken in [one_line, garbled, shortened] {
            for files in [&[cert.as_str(), &broken][..], &[&broken, &key], &[&cert, &key, &broken]] {
                let fault = fault(files);
                assert!(!fault.is_empty(), "{broken}");
                assert!(
                    secret.as_bytes().chunks(8).all(|part| !fault.contains(str::from_utf8(part).unwrap())),
                    "{fault}"
                );
            }
        }
    }

    #[test]
    fn a_key_may_be_written_as_openssl_wrote_keys_of_curves_before_pkcs8() {
        let key = KeyPair::generate().unwrap();
        let cert = CertificateParams::new(["localhost".to_owned()]).unwrap().self_signed(&key).unwrap();
        // PKCS#8 wraps a SEC1 key; it is the last part but for optional ones.
        let pkcs8 = key.serialize_der();
        let at = pkcs8.windows(5).position(|bytes| bytes[0] == 0x30 && bytes[2..] == [2, 1, 1]).unwrap();
        let sec1 = &pkcs8[at..at + 2 + usize::from(pkcs8[at + 1])];
        let mut files = vec![cert.pem().into_bytes(), Vec::new()];
        files[1] = pem("EC PRIVATE KEY", sec1).into_bytes();
        Server::new(&["cert.pem".into(), "key.pem".into()], &files).unwrap();
    }

    /// A PEM section.
    fn pem(label: &str, der: &[u8]) -> String {
        const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        let mut text = String::new();
        for three in der.chunks(3) {
            let bits = three.iter().fold(0, |bits, byte| bits << 8 | usize::from(*byte)) << (8 * (3 - three.len()));
            for place in 0..4 {
                let digit = char::from(DIGITS[bits >> (18 - 6 * place) & 63]);
                text.push(if place <= three.len() { digit } else { '=' });
            }
        }
        format!("-----BEGIN {label}-----\n{text}\n-----END {label}-----\n")
    }
}
