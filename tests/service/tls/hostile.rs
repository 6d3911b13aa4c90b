//! Clients that mean harm to a service with TLS.

use core::time::Duration;
use std::io::Write;
use std::net::TcpStream;

use singulate::api::{Engine, ServerSettings};
use tokio::io::AsyncWriteExt;

use super::authority::Authority;
use super::{LAST_LIVEZ, answers, connect, others_are_served, read_to_end, rested, secure_host};
use crate::host::{self, Host, PATIENCE};

/// The beginning of a greeting of TLS: a record that announces 512 bytes, of which few come.
const HALF_A_HELLO: &[u8] = b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03";

fn send(host: &Host, bytes: &[u8]) -> TcpStream {
    let mut stream = TcpStream::connect(host.address).unwrap();
    stream.write_all(bytes).unwrap();
    stream
}

#[tokio::test]
async fn a_handshake_that_never_ends_is_cut_off() {
    let authority = Authority::new("endless");
    let header_timeout = Duration::from_millis(200);
    let settings = ServerSettings { connections: 2, header_timeout, ..ServerSettings::default() };
    let host = secure_host(&authority, settings, Engine::default()).await;
    let silent = send(&host, b"");
    let half = send(&host, HALF_A_HELLO);
    assert_eq!(host::read_to_end(silent).await, "");
    assert_eq!(host::read_to_end(half).await, "");
    others_are_served(&host, &authority.client(None)).await;
}

#[tokio::test]
async fn others_are_served_while_handshakes_never_end() {
    let authority = Authority::new("meanwhile");
    let settings = ServerSettings { header_timeout: 2 * PATIENCE, ..ServerSettings::default() };
    let host = secure_host(&authority, settings, Engine::default()).await;
    let waiting: Vec<TcpStream> = (0..100).map(|_| send(&host, HALF_A_HELLO)).collect();
    others_are_served(&host, &authority.client(None)).await;
    drop(waiting);
}

#[tokio::test]
async fn noise_ends_its_own_connection_only() {
    let authority = Authority::new("noise");
    let settings = ServerSettings { header_timeout: 2 * PATIENCE, ..ServerSettings::default() };
    let host = secure_host(&authority, settings, Engine::default()).await;
    let client = authority.client(None);
    let mut kept = rested(&host, &client).await;
    for noise in [
        &b"\x00\x00\x00\x00\x00\x00\x00\x00"[..],
        b"\x16\x03\x01\xff\xff\x01\x00\x01\xfc\x03\x03",
        b"\x15\x03\x01\x00\x02\x02\x28",
        b"\x17\x03\x03\x00\x05hello",
        b"\x80\x2e\x01\x00\x02 an old hello of SSL 2",
        b"ssh or something",
    ] {
        // An alert may come back, but no HTTP, and long before the time for a handshake is over.
        assert!(!host::read_to_end(send(&host, noise)).await.contains("HTTP/"));
    }
    // Noise after the handshake, below the TLS that was agreed on.
    let mut broken = connect(&host, &client).await.unwrap();
    broken.get_mut().0.write_all(&[0x17, 3, 3, 0, 64, 1, 2, 3]).await.unwrap();
    broken.get_mut().0.write_all(&[7; 100]).await.unwrap();
    assert_eq!(read_to_end(&mut broken).await, "");
    assert!(answers(&mut kept).await);
}

#[tokio::test]
async fn a_slow_head_over_tls_is_cut_off() {
    let authority = Authority::new("slow-head");
    let settings = ServerSettings { header_timeout: Duration::from_millis(500), ..ServerSettings::default() };
    let host = secure_host(&authority, settings, Engine::default()).await;
    let client = authority.client(None);
    // Where a busy machine needs longer for the handshake than there is time, there is no head to be slow with.
    if let Ok(mut first) = connect(&host, &client).await {
        let _ = first.write_all(b"GET /livez HTTP/1.1\r\nhost:").await;
        assert_eq!(read_to_end(&mut first).await, "");
    }
    let mut later = rested(&host, &client).await;
    later.write_all(b"GET /livez").await.unwrap();
    // Hyper's own time, which is for connections that rest, is longer than this waits.
    assert_eq!(read_to_end(&mut later).await, "");
}

#[tokio::test]
async fn a_client_that_takes_none_of_its_answers_over_tls_is_not_waited_for() {
    let authority = Authority::new("greedy");
    let write_timeout = Duration::from_millis(100);
    let settings = ServerSettings { connections: 1, write_timeout, ..ServerSettings::default() };
    let host = secure_host(&authority, settings, Engine::default()).await;
    let client = authority.client(None);
    let mut greedy = connect(&host, &client).await.unwrap();
    // So many answers at once fit in no buffer between the two.
    let requests = "GET /openapi.json HTTP/1.1\r\nhost: x\r\n\r\n".repeat(500);
    // What the server does not take is not needed.
    let _ = greedy.write_all(requests.as_bytes()).await;
    let mut next = connect(&host, &client).await.unwrap();
    next.write_all(LAST_LIVEZ.as_bytes()).await.unwrap();
    assert!(read_to_end(&mut next).await.starts_with("HTTP/1.1 200 "), "the only connection is free again");
    drop(greedy);
}
