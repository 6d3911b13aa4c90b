//! Clients that are slow, idle or many.

use core::time::Duration;
use std::io::Write;

use singulate::api::{Engine, ServerSettings};

use crate::host::{Host, PATIENCE, read_to_end};

#[tokio::test]
async fn a_slow_head_is_cut_off() {
    let settings = ServerSettings { header_timeout: Duration::from_millis(50), ..ServerSettings::default() };
    let host = Host::with(settings, Engine::default()).await;
    let stream = host.raw("GET /livez HTTP/1.1\r\nhost:");
    assert!(!read_to_end(stream).await.contains("200"));
}

#[tokio::test]
async fn a_connection_may_rest_longer_between_requests_than_a_head_may_take() {
    let patience = Duration::from_millis(50);
    let host =
        Host::with(ServerSettings { header_timeout: patience, ..ServerSettings::default() }, Engine::default()).await;
    let request = "GET /livez HTTP/1.1\r\nhost: x\r\n";
    let mut stream = host.raw(&format!("{request}\r\n"));
    tokio::time::sleep(patience * 4).await;
    stream.write_all(format!("{request}connection: close\r\n\r\n").as_bytes()).unwrap();
    assert_eq!(read_to_end(stream).await.matches("HTTP/1.1 200 OK").count(), 2);
}

#[tokio::test]
async fn a_slow_second_head_is_cut_off_too() {
    let settings = ServerSettings { header_timeout: Duration::from_millis(50), ..ServerSettings::default() };
    let host = Host::with(settings, Engine::default()).await;
    let mut stream = host.raw("GET /livez HTTP/1.1\r\nhost: x\r\n\r\n");
    tokio::time::sleep(Duration::from_millis(100)).await;
    stream.write_all(b"GET /livez").unwrap();
    assert_eq!(read_to_end(stream).await.matches("HTTP/1.1 200 OK").count(), 1);
}

#[tokio::test]
async fn a_body_that_nobody_reads_is_no_slow_head() {
    let header_timeout = Duration::from_millis(50);
    let settings = ServerSettings { header_timeout, body_timeout: PATIENCE, ..ServerSettings::default() };
    let host = Host::with(settings, Engine::default()).await;
    let body = " ".repeat(20_000);
    let mut stream = host.raw("POST /v1/nothing HTTP/1.1\r\nhost: x\r\ncontent-length: 60000\r\n\r\n");
    for _ in 0..3 {
        tokio::time::sleep(header_timeout * 2).await;
        stream.write_all(body.as_bytes()).unwrap();
    }
    stream.write_all(b"GET /livez HTTP/1.1\r\nhost: x\r\nconnection: close\r\n\r\n").unwrap();
    let text = read_to_end(stream).await;
    assert!(text.starts_with("HTTP/1.1 404 "), "{text}");
    assert!(text.contains("\r\nconnection: close\r\n"), "the end is announced, here or in the next answer: {text}");
}

#[tokio::test]
async fn http_2_without_negotiation_is_told_that_this_is_http_1_1() {
    let host = Host::start().await;
    // What such a client begins with, and its first settings.
    let text = host.ask("PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n\0\0\0\x04\0\0\0\0\0").await;
    let (head, body) = text.split_once("\r\n\r\n").unwrap();
    assert!(head.starts_with("HTTP/1.1 400 ") && head.contains("\r\nconnection: close"), "{text}");
    let problem: serde_json::Value = serde_json::from_str(body).unwrap();
    assert_eq!(problem["type"], "urn:singulate:problem:malformed_http");
    assert_eq!(problem["detail"], "this service speaks HTTP/1.1, not HTTP/2");
}

#[tokio::test]
async fn a_slow_body_is_a_408() {
    let settings = ServerSettings { body_timeout: Duration::from_millis(50), ..ServerSettings::default() };
    let host = Host::with(settings, Engine::default()).await;
    let head = "POST /v1/plans HTTP/1.1\r\nhost: x\r\ncontent-type: application/json\r\ncontent-length: 100\r\n\r\n";
    let text = read_to_end(host.raw(&format!("{head}{{\"table\""))).await;
    assert!(text.starts_with("HTTP/1.1 408 ") && text.contains("application/problem+json"), "{text}");
}

#[tokio::test]
async fn a_connection_serves_many_requests() {
    let host = Host::start().await;
    let request = "GET /livez HTTP/1.1\r\nhost: x\r\n";
    let stream = host.raw(&format!("{request}\r\n{request}connection: close\r\n\r\n"));
    assert_eq!(read_to_end(stream).await.matches("HTTP/1.1 200 OK").count(), 2);
}

#[tokio::test]
async fn connections_above_the_cap_wait_for_their_turn() {
    let settings = ServerSettings { connections: 1, ..ServerSettings::default() };
    let host = Host::with(settings, Engine::default()).await;
    let request = "GET /livez HTTP/1.1\r\nhost: x\r\nconnection: close\r\n";
    let first = host.raw(request);
    let second = host.raw(&format!("{request}\r\n"));
    drop(first);
    assert!(read_to_end(second).await.starts_with("HTTP/1.1 200 OK"));
}

#[tokio::test]
async fn a_head_that_is_no_http_is_a_problem() {
    let host = Host::start().await;
    let long = "a".repeat(70_000);
    for (text, status, kind) in [
        ("rubbish\r\n\r\n".to_owned(), 400, "malformed_http"),
        ("GET / HTTP/9.9\r\n\r\n".to_owned(), 400, "malformed_http"),
        ("GET / HTTP/1.1\r\nno colon\r\n\r\n".to_owned(), 400, "malformed_http"),
        (format!("GET /{long} HTTP/1.1\r\n\r\n"), 414, "uri_too_long"),
        (format!("GET / HTTP/1.1\r\n{}\r\n", "x: y\r\n".repeat(101)), 431, "head_too_large"),
        (format!("GET /livez HTTP/1.1\r\nx: {}\r\n\r\n", long.repeat(20)), 431, "head_too_large"),
        ("GET /livez HTTP/1.1\r\nhost: x\r\n\r\nrubbish\r\n\r\n".to_owned(), 400, "malformed_http"),
    ] {
        let text = read_to_end(host.raw(&text)).await;
        let last = &text[text.rfind("HTTP/1.1 ").unwrap()..];
        let (head, body) = last.split_once("\r\n\r\n").unwrap();
        assert!(head.starts_with(&format!("HTTP/1.1 {status} ")), "{text}");
        assert!(head.contains("\r\ncontent-type: application/problem+json\r\n"), "{text}");
        assert!(head.contains(&format!("\r\ncontent-length: {}\r\n", body.len())), "{text}");
        let problem: serde_json::Value = serde_json::from_str(body).unwrap();
        assert_eq!(problem["type"], format!("urn:singulate:problem:{kind}"));
        assert_eq!(problem["status"], status);
    }
}

#[tokio::test]
async fn a_client_that_takes_none_of_its_answers_is_not_waited_for() {
    let write_timeout = Duration::from_millis(100);
    let host =
        Host::with(ServerSettings { connections: 1, write_timeout, ..ServerSettings::default() }, Engine::default());
    let host = host.await;
    // So many answers at once fit in no buffer between the two.
    let requests = "GET /openapi.json HTTP/1.1\r\nhost: x\r\n\r\n".repeat(500);
    let greedy = host.raw(&requests);
    let next = host.raw("GET /livez HTTP/1.1\r\nhost: x\r\nconnection: close\r\n\r\n");
    assert!(read_to_end(next).await.starts_with("HTTP/1.1 200 OK"), "the only connection is free again");
    drop(greedy);
}
