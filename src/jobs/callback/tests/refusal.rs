//! Destinations and certificates that callbacks refuse.

use std::net::{IpAddr, Ipv4Addr};
use std::sync::Arc;

use rcgen::generate_simple_self_signed;
use rustls::pki_types::PrivateKeyDer;
use rustls::{RootCertStore, ServerConfig};
use tokio_rustls::TlsAcceptor;

use super::delivery::{pace, secret};
use super::receiver::{Receiver, status, until};
use super::store::Callbacks;
use crate::jobs::Delivery;
use crate::jobs::callback::client::{Lookup, system};
use crate::jobs::callback::deliver::{CallbackDelivery, MAX_TRIES};

const HERE: IpAddr = IpAddr::V4(Ipv4Addr::LOCALHOST);

/// Delivers one callback under these rules; true if it arrived, false if it was given up.
async fn arrives(url: &str, allow: &str, lookup: Lookup, roots: RootCertStore) -> bool {
    let store = Arc::new(Callbacks::default());
    let id = store.add(url);
    let delivery = CallbackDelivery::for_tests(Arc::clone(&store) as _, allow, &secret(), (lookup, roots, pace()));
    let running = tokio::spawn(delivery.run(std::future::pending()));
    until("the callback's end", || store.over(id)).await;
    running.abort();
    let (tries, delivery) = *store.settled(id).last().unwrap();
    assert!(delivery == Delivery::Over && (tries == 1 || tries == MAX_TRIES), "{tries} tries");
    tries == 1
}

#[tokio::test]
async fn a_name_is_called_only_where_it_may_lead() {
    let receiver = Receiver::start(&[status(200)]).await;
    let url = format!("http://erp.example.com:{}/", receiver.address.port());
    let here: Lookup = |name| if name == "erp.example.com" { Ok(vec![HERE]) } else { Ok(Vec::new()) };
    let mixed: Lookup = |_| Ok(vec![HERE, IpAddr::V4(Ipv4Addr::new(10, 0, 0, 5))]);
    let nowhere: Lookup = |_| Ok(Vec::new());
    let unknown: Lookup = |_| Err(std::io::Error::other("no such name"));
    let table = [
        ("erp.example.com", here, false),
        ("erp.example.com,10.0.0.0/8", here, false),
        ("erp.example.com,127.0.0.0/8", mixed, false),
        ("erp.example.com,127.0.0.0/8", nowhere, false),
        ("erp.example.com,127.0.0.0/8", unknown, false),
        // Removed from the list since the job was accepted.
        ("127.0.0.0/8", here, false),
    ];
    for (at, (allow, lookup, expected)) in table.into_iter().enumerate() {
        assert_eq!(arrives(&url, allow, lookup, RootCertStore::empty()).await, expected, "{at}: {allow}");
    }
    assert!(receiver.received().is_empty());
    for allow in ["erp.example.com,127.0.0.0/8", "*.example.com,localhost"] {
        assert!(arrives(&url, allow, here, RootCertStore::empty()).await, "{allow}");
    }
    assert_eq!(receiver.received().len(), 2);
}

#[tokio::test]
async fn an_address_is_called_only_where_it_is_listed() {
    let receiver = Receiver::start(&[status(200)]).await;
    let port = receiver.address.port();
    for host in ["127.0.0.1", "2130706433", "0x7f.1", "[::ffff:127.0.0.1]", "localhost"] {
        let url = format!("http://{host}:{port}/");
        assert!(!arrives(&url, "erp.example.com,10.0.0.0/8", system, RootCertStore::empty()).await, "{host}");
    }
    assert!(receiver.received().is_empty());
    assert!(arrives(&format!("http://127.1:{port}/"), "127.0.0.1", system, RootCertStore::empty()).await);
    assert!(arrives(&format!("http://[::ffff:7f00:1]:{port}/"), "127.0.0.1", system, RootCertStore::empty()).await);
}

#[tokio::test]
async fn a_receiver_by_https_is_trusted_if_its_certificate_is() {
    let own = generate_simple_self_signed(["erp.example.com".to_owned()]).unwrap();
    let key = PrivateKeyDer::try_from(own.signing_key.serialize_der()).unwrap();
    let server = ServerConfig::builder_with_provider(Arc::new(rustls::crypto::ring::default_provider()));
    let server = server.with_safe_default_protocol_versions().unwrap().with_no_client_auth();
    let server = server.with_single_cert(vec![own.cert.der().clone()], key).unwrap();
    let receiver = Receiver::start_with(&[status(200)], Some(TlsAcceptor::from(Arc::new(server)))).await;
    let mut roots = RootCertStore::empty();
    roots.add(own.cert.der().clone()).unwrap();
    let here: Lookup = |_| Ok(vec![HERE]);
    let url = |name: &str| format!("https://{name}:{}/", receiver.address.port());
    let allow = "*.example.com,localhost";
    assert!(!arrives(&url("erp.example.com"), allow, here, RootCertStore::empty()).await);
    assert!(!arrives(&url("mes.example.com"), allow, here, roots.clone()).await);
    assert!(receiver.received().is_empty());
    assert!(arrives(&url("erp.example.com"), allow, here, roots).await);
}
