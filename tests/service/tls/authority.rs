//! An authority for certificates, and clients that trust it.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use rcgen::{BasicConstraints, CertificateParams, CertifiedIssuer, DnType, IsCa, KeyPair};
use rustls::crypto::ring;
use rustls::pki_types::{CertificateDer, PrivateKeyDer};
use rustls::{ClientConfig, RootCertStore, SupportedProtocolVersion, version};
use singulate::tls::TlsSettings;

/// Signs certificates, and keeps those of a service in a folder of the test's own.
pub(crate) struct Authority {
    issuer: CertifiedIssuer<'static, KeyPair>,
    pub(crate) folder: PathBuf,
}

/// A certificate and its key.
pub(crate) struct Pair {
    pub(crate) certificate: CertificateDer<'static>,
    certificate_pem: String,
    key: KeyPair,
}

fn named(common_name: &str, names: &[&str]) -> CertificateParams {
    let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
    let mut params = CertificateParams::new(names).unwrap();
    params.distinguished_name.push(DnType::CommonName, common_name);
    params
}

impl Authority {
    /// No two tests may say the same name.
    pub(crate) fn new(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("tls-{name}"));
        fs::create_dir_all(&folder).unwrap();
        let mut params = named(&format!("authority {name}"), &[]);
        params.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
        let this = Self { issuer: CertifiedIssuer::self_signed(params, KeyPair::generate().unwrap()).unwrap(), folder };
        this.replace(&this.pair());
        this
    }

    /// A new certificate for a service, or for a client.
    pub(crate) fn pair(&self) -> Pair {
        let key = KeyPair::generate().unwrap();
        let signed = named("singulate", &["localhost", "127.0.0.1"]).signed_by(&key, &self.issuer).unwrap();
        Pair { certificate: signed.der().clone(), certificate_pem: signed.pem(), key }
    }

    pub(crate) fn write_certificate(&self, pair: &Pair) {
        fs::write(self.folder.join("cert.pem"), &pair.certificate_pem).unwrap();
    }

    pub(crate) fn write_key(&self, pair: &Pair) {
        fs::write(self.folder.join("key.pem"), pair.key.serialize_pem()).unwrap();
    }

    /// From now on a service that watches the folder has this certificate.
    pub(crate) fn replace(&self, pair: &Pair) {
        self.write_certificate(pair);
        self.write_key(pair);
    }

    /// The clients of these authorities are let in.
    pub(crate) fn write_client_ca(&self, authorities: &[&Self]) {
        let all: String = authorities.iter().map(|authority| authority.issuer.pem()).collect();
        fs::write(self.folder.join("clients.pem"), all).unwrap();
    }

    /// A service with a certificate of this authority.
    pub(crate) fn service(&self) -> TlsSettings {
        let file = |name| Some(self.folder.join(name));
        TlsSettings { cert: file("cert.pem"), key: file("key.pem"), client_ca: None }
    }

    /// The same, for clients with certificates.
    pub(crate) fn service_with_client_ca(&self) -> TlsSettings {
        TlsSettings { client_ca: Some(self.folder.join("clients.pem")), ..self.service() }
    }

    /// A client that trusts services of this authority and shows `own`.
    pub(crate) fn client(&self, own: Option<&Pair>) -> Arc<ClientConfig> {
        self.client_of(&version::TLS13, own)
    }

    /// The same of another version.
    pub(crate) fn client_of(
        &self,
        version: &'static SupportedProtocolVersion,
        own: Option<&Pair>,
    ) -> Arc<ClientConfig> {
        let mut roots = RootCertStore::empty();
        roots.add(self.issuer.der().clone()).unwrap();
        let config = ClientConfig::builder_with_provider(Arc::new(ring::default_provider()));
        let config = config.with_protocol_versions(&[version]).unwrap().with_root_certificates(roots);
        Arc::new(match own {
            Some(own) => {
                let key = PrivateKeyDer::try_from(own.key.serialize_der()).unwrap();
                config.with_client_auth_cert(vec![own.certificate.clone()], key).unwrap()
            }
            None => config.with_no_client_auth(),
        })
    }
}

impl Drop for Authority {
    fn drop(&mut self) {
        // A folder that is left behind harms nobody.
        let _ = fs::remove_dir_all(&self.folder);
    }
}
