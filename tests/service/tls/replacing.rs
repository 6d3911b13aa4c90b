//! Certificates that are replaced while the service runs.

use core::time::Duration;
use std::fs;
use std::time::Instant;

use rustls::pki_types::CertificateDer;
use singulate::api::{Engine, ServerSettings};

use super::authority::Authority;
use super::{answers, connect, rested, secure_host};
use crate::host::{Host, PATIENCE};

/// The certificate that a new connection is shown.
async fn shown(host: &Host, authority: &Authority) -> CertificateDer<'static> {
    let stream = connect(host, &authority.client(None)).await.unwrap();
    stream.get_ref().1.peer_certificates().unwrap()[0].clone().into_owned()
}

async fn wait_for(host: &Host, authority: &Authority, certificate: &CertificateDer<'static>) {
    let started = Instant::now();
    while shown(host, authority).await != *certificate {
        assert!(started.elapsed() < PATIENCE, "the certificate is not replaced");
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
}

#[tokio::test]
async fn a_new_certificate_is_for_new_connections_and_old_ones_live_on() {
    let authority = Authority::new("replaced");
    let first = authority.pair();
    authority.replace(&first);
    let host = secure_host(&authority, ServerSettings::default(), Engine::default()).await;
    let mut old = rested(&host, &authority.client(None)).await;
    assert_eq!(shown(&host, &authority).await, first.certificate);
    let second = authority.pair();
    authority.replace(&second);
    wait_for(&host, &authority, &second.certificate).await;
    assert!(answers(&mut old).await);
}

#[tokio::test]
async fn files_that_do_not_fit_together_change_nothing_until_they_do() {
    let authority = Authority::new("halfway");
    let first = authority.pair();
    authority.replace(&first);
    let host = secure_host(&authority, ServerSettings::default(), Engine::default()).await;
    assert_eq!(shown(&host, &authority).await, first.certificate);
    let second = authority.pair();
    let halfway: [&dyn Fn(); 4] = [
        &|| authority.write_certificate(&second),
        &|| fs::write(authority.folder.join("cert.pem"), "-----BEGIN CERTIFICATE-----\nMIIB").unwrap(),
        &|| fs::remove_file(authority.folder.join("cert.pem")).unwrap(),
        &|| fs::write(authority.folder.join("key.pem"), "").unwrap(),
    ];
    for state in halfway {
        state();
        // More than one look at the files.
        let looked = Instant::now();
        while looked.elapsed() < Duration::from_millis(1500) {
            assert_eq!(shown(&host, &authority).await, first.certificate);
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    }
    authority.replace(&second);
    wait_for(&host, &authority, &second.certificate).await;
}
