//! Clients with certificates, and those without.

use std::sync::Arc;
use std::time::Instant;

use rustls::ClientConfig;
use serde_json::json;
use singulate::api::{Engine, ServerSettings};
use tokio::io::AsyncWriteExt;

use super::authority::Authority;
use super::{LAST_LIVEZ, answers, connect, raw, read_to_end, rested, secure_host};
use crate::host::{Host, PATIENCE, raw_plan};

const VERSION: &str = "GET /version HTTP/1.1\r\nhost: x\r\nconnection: close\r\n\r\n";

/// A service that lets clients of these authorities in.
async fn host_for(authority: &Authority, clients: &[&Authority]) -> Host {
    authority.write_client_ca(clients);
    let settings = ServerSettings { tls: authority.service_with_client_ca(), ..ServerSettings::default() };
    secure_host(authority, settings, Engine::default()).await
}

/// True if the client gets an answer; false where there is no connection for it, which a client of TLS 1.3 may learn
/// only after it has sent its request.
async fn let_in(host: &Host, client: &Arc<ClientConfig>) -> bool {
    let Ok(mut stream) = connect(host, client).await else { return false };
    let _ = stream.write_all(VERSION.as_bytes()).await;
    let text = read_to_end(&mut stream).await;
    // The authorities may be replaced between the two.
    assert!(text.is_empty() || text.starts_with("HTTP/1.1 200 ") || text.contains("is no longer valid"), "{text}");
    text.starts_with("HTTP/1.1 200 ")
}

#[tokio::test]
async fn without_a_certificate_there_are_only_probes() {
    let authority = Authority::new("probes");
    let host = host_for(&authority, &[&authority]).await;
    for path in ["/livez", "/readyz"] {
        assert_eq!(host.get(path).await.status, 200, "{path}");
    }
    for path in ["/version", "/openapi.json", "/docs/", "/metrics", "/v1/jobs", "/nowhere", "/livez/", "//readyz"] {
        let reply = host.get(path).await;
        reply.is_problem(401, "unauthorized");
        assert_eq!(reply.header("www-authenticate"), "Bearer realm=\"singulate\"", "{path}");
    }
    let client = authority.client(Some(&authority.pair()));
    assert!(let_in(&host, &client).await);
    assert!(read_to_end(&mut raw(&host, &client, LAST_LIVEZ).await).await.contains(" 200 "));
}

#[tokio::test]
async fn a_client_that_sends_a_large_body_without_a_certificate_learns_that_it_is_refused() {
    let authority = Authority::new("large");
    let host = host_for(&authority, &[&authority]).await;
    let body = raw_plan(&json!(" ".repeat(3_000_000)));
    // The client writes everything before it reads.
    let mut stream = raw(&host, &authority.client(None), &body).await;
    stream.write_all(LAST_LIVEZ.as_bytes()).await.unwrap();
    let text = read_to_end(&mut stream).await;
    assert!(text.starts_with("HTTP/1.1 401 ") && text.contains("HTTP/1.1 200 OK"), "{text}");
    let metrics = VERSION.replace("/version", "/metrics");
    let text = read_to_end(&mut raw(&host, &authority.client(Some(&authority.pair())), &metrics).await).await;
    assert!(text.contains("requests_refused_total{reason=\"unauthorized\"} 1\n"), "{text}");
}

#[tokio::test]
async fn a_certificate_of_a_stranger_gets_no_connection() {
    let authority = Authority::new("friend");
    let stranger = Authority::new("stranger");
    let host = host_for(&authority, &[&authority]).await;
    assert!(!let_in(&host, &authority.client(Some(&stranger.pair()))).await);
    assert!(let_in(&host, &authority.client(Some(&authority.pair()))).await);
}

#[tokio::test]
async fn clients_of_a_removed_authority_are_shut_out_on_open_connections() {
    let authority = Authority::new("listed");
    let (old, new) = (Authority::new("listed-old"), Authority::new("listed-new"));
    let host = host_for(&authority, &[&old, &new]).await;
    // The same client comes again: it offers to go on with the session it had.
    let (was_here, stays) = (authority.client(Some(&old.pair())), authority.client(Some(&new.pair())));
    assert!(let_in(&host, &was_here).await && let_in(&host, &stays).await);
    let (mut open, mut open_and_stays) = (rested(&host, &was_here).await, rested(&host, &stays).await);
    authority.write_client_ca(&[&new]);
    let started = Instant::now();
    while let_in(&host, &was_here).await {
        assert!(started.elapsed() < PATIENCE, "it is let in for ever");
    }
    assert!(let_in(&host, &stays).await);
    // Connections from before: probes are answered as they are without a certificate, and the one that stays goes on.
    assert!(answers(&mut open).await && answers(&mut open_and_stays).await);
    open.write_all(VERSION.replace("connection: close\r\n", "").as_bytes()).await.unwrap();
    let text = read_to_end(&mut open).await;
    assert!(text.starts_with("HTTP/1.1 401 ") && text.contains("is no longer valid"), "{text}");
    assert!(text.contains("\r\nconnection: close\r\n"), "{text}");
    open_and_stays.write_all(VERSION.as_bytes()).await.unwrap();
    assert!(read_to_end(&mut open_and_stays).await.starts_with("HTTP/1.1 200 "));
}
