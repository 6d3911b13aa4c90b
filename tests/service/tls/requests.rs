//! What is asked over TLS is answered as it is without.

use core::time::Duration;
use std::sync::atomic::{AtomicUsize, Ordering};

use rustls::version;
use serde_json::json;
use singulate::api::{Engine, ServerSettings};
use singulate_planner::budget::Budget;
use singulate_planner::paper::Judged;
use singulate_planner::plan::PlanError;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;
use tokio::time::timeout;

use super::authority::Authority;
use super::{LIVEZ, answers, connect, others_are_served, raw, read_to_end, rested, secure_host};
use crate::host::{PATIENCE, raw_plan, scene, wait_until};
use crate::jobs::{crowded, path, submit};
use crate::planning::{endless, wait_for_the_end};

#[tokio::test]
async fn a_plan_comes_over_tls() {
    let authority = Authority::new("plan");
    let host = secure_host(&authority, ServerSettings::default(), Engine::default()).await;
    let reply = host.post("/v1/plans", &scene(60_000)).await;
    assert_eq!((reply.status, &reply.json()["verdict"]), (200, &"graspable".into()));
    let stream = connect(&host, &authority.client(None)).await.unwrap();
    assert_eq!(stream.get_ref().1.protocol_version(), Some(rustls::ProtocolVersion::TLSv1_3));
}

#[tokio::test]
async fn alpn_chooses_http_1_1_and_refuses_other_protocols() {
    let authority = Authority::new("alpn");
    let host = secure_host(&authority, ServerSettings::default(), Engine::default()).await;
    for (offered, chosen) in [(&["h2", "http/1.1"][..], Some(&b"http/1.1"[..])), (&["h2"], None), (&[], None)] {
        let mut client = rustls::ClientConfig::clone(&authority.client(None));
        client.alpn_protocols = offered.iter().map(|name| name.as_bytes().to_vec()).collect();
        let connected = connect(&host, &client.into()).await;
        assert_eq!(connected.is_ok(), chosen.is_some() || offered.is_empty(), "{offered:?}");
        if let Ok(stream) = connected {
            assert_eq!(stream.get_ref().1.alpn_protocol(), chosen);
        }
    }
}

#[tokio::test]
async fn an_older_version_is_refused() {
    let authority = Authority::new("older");
    let host = secure_host(&authority, ServerSettings::default(), Engine::default()).await;
    let refused = connect(&host, &authority.client_of(&version::TLS12, None)).await.unwrap_err();
    assert!(refused.to_string().contains("ProtocolVersion"), "{refused}");
    others_are_served(&host, &authority.client(None)).await;
}

#[tokio::test]
async fn a_client_that_speaks_plain_http_is_told_that_this_is_tls() {
    let authority = Authority::new("plain");
    let host = secure_host(&authority, ServerSettings::default(), Engine::default()).await;
    for request in [LIVEZ.to_owned(), raw_plan(&scene(1000))] {
        let text = host.ask(&request).await;
        assert!(text.starts_with("HTTP/1.1 400 ") && text.contains("this port speaks TLS"), "{text}");
        assert!(text.contains("\r\nconnection: close\r\n") && text.contains("malformed_http"), "{text}");
    }
    others_are_served(&host, &authority.client(None)).await;
}

#[tokio::test]
async fn a_client_that_sends_a_large_body_in_plain_http_is_told_so_too() {
    let authority = Authority::new("plain-large");
    let settings = ServerSettings { body_timeout: PATIENCE, ..ServerSettings::default() };
    let host = secure_host(&authority, settings, Engine::default()).await;
    let mut stream = TcpStream::connect(host.address).await.unwrap();
    // More than the system keeps for a server that does not read.
    stream.write_all(raw_plan(&json!(" ".repeat(30_000_000))).as_bytes()).await.unwrap();
    let mut text = String::new();
    timeout(PATIENCE, stream.read_to_string(&mut text)).await.expect("the server ends it").unwrap();
    assert!(text.starts_with("HTTP/1.1 400 ") && text.contains("this port speaks TLS"), "{text}");
}

#[tokio::test]
async fn a_preflight_needs_no_client_certificate() {
    let authority = Authority::new("ahead");
    authority.write_client_ca(&[&authority]);
    let (tls, cors_origins) = (authority.service_with_client_ca(), "https://cell.example.com".parse().unwrap());
    let settings = ServerSettings { tls, cors_origins, ..ServerSettings::default() };
    let host = secure_host(&authority, settings, Engine::default()).await;
    let ask = |verb: &str| {
        let fields = "host: x\r\norigin: https://cell.example.com\r\nconnection: close";
        format!("{verb} /v1/plans HTTP/1.1\r\n{fields}\r\naccess-control-request-method: POST\r\n\r\n")
    };
    let client = authority.client(None);
    for (verb, status) in [("OPTIONS", "200"), ("POST", "401")] {
        let text = read_to_end(&mut raw(&host, &client, &ask(verb)).await).await;
        assert!(text.starts_with(&format!("HTTP/1.1 {status} ")), "{text}");
        assert!(text.contains("\r\naccess-control-allow-origin: https://cell.example.com\r\n"), "{text}");
        let text = host.ask(&ask(verb)).await;
        assert!(text.starts_with("HTTP/1.1 400 ") && text.contains("this port speaks TLS"), "{text}");
    }
}

#[tokio::test]
async fn events_come_over_tls_as_they_happen() {
    let authority = Authority::new("events");
    let host = secure_host(&authority, ServerSettings::default(), Engine::default()).await;
    let job = submit(&host, &crowded()).await;
    let text = host.get(&format!("{}/events", path(&job))).await.text;
    for event in ["event: queued", "event: running", "event: finished"] {
        assert!(text.contains(event), "{text}");
    }
}

#[tokio::test]
async fn a_client_that_says_goodbye_and_one_that_just_goes_have_hung_up() {
    static RUNNING: AtomicUsize = AtomicUsize::new(0);
    let authority = Authority::new("goodbye");
    let settings = ServerSettings { threads: 1, ..ServerSettings::default() };
    let host = secure_host(&authority, settings, endless!(RUNNING)).await;
    let client = authority.client(None);
    for polite in [true, false] {
        let mut stream = raw(&host, &client, &raw_plan(&scene(60_000))).await;
        wait_until(|| RUNNING.load(Ordering::SeqCst) == 1).await;
        if polite {
            stream.shutdown().await.unwrap();
            wait_until(|| RUNNING.load(Ordering::SeqCst) == 0).await;
            assert_eq!(read_to_end(&mut stream).await, "");
        }
        drop(stream);
        wait_until(|| RUNNING.load(Ordering::SeqCst) == 0).await;
    }
}

#[tokio::test]
async fn a_service_drains_over_tls_as_it_does_without() {
    static RUNNING: AtomicUsize = AtomicUsize::new(0);
    let authority = Authority::new("drain");
    let settings = ServerSettings { threads: 1, drain: 2 * PATIENCE, ..ServerSettings::default() };
    let host = secure_host(&authority, settings, endless!(RUNNING)).await;
    let client = authority.client(None);
    let mut running = raw(&host, &client, &raw_plan(&scene(1000))).await;
    wait_until(|| RUNNING.load(Ordering::SeqCst) == 1).await;
    let mut idle = rested(&host, &client).await;
    let silent = connect(&host, &client).await.unwrap();
    let mute = host.raw("");
    host.ask_to_stop();
    let text = read_to_end(&mut running).await;
    assert!(text.starts_with("HTTP/1.1 200 ") && text.contains("timed_out"), "{text}");
    assert_eq!(read_to_end(&mut idle).await, "");
    // The time for draining is longer than this waits.
    host.stopped().await;
    drop((silent, mute));
}

#[tokio::test]
async fn a_connection_may_rest_longer_between_requests_than_a_head_may_take() {
    let patience = Duration::from_millis(500);
    let authority = Authority::new("rest");
    let settings = ServerSettings { header_timeout: patience, ..ServerSettings::default() };
    let host = secure_host(&authority, settings, Engine::default()).await;
    let mut stream = rested(&host, &authority.client(None)).await;
    tokio::time::sleep(patience * 3).await;
    assert!(answers(&mut stream).await);
}
