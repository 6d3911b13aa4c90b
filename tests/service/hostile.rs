//! Clients that mean harm. Whatever one of them does, the service lives and the others are served meanwhile.

use core::time::Duration;
use std::io::Write;
use std::net::{Shutdown, TcpStream};
use std::sync::atomic::{AtomicUsize, Ordering};

use serde_json::json;
use singulate::api::{Engine, ServerSettings};
use singulate::budget::Budget;
use singulate::plan::{Answer, PlanError, Settings};
use singulate::scene::Scene;

use crate::host::{Host, raw_plan, read_to_end, scene, wait_until};
use crate::planning::{endless, wait_for_the_end};

/// Somebody else gets a plan, on a connection of its own.
async fn others_are_served(host: &Host) {
    let plan = raw_plan(&scene(60_000)).replacen("host: x", "host: x\r\nconnection: close", 1);
    let text = host.ask(&plan).await;
    assert!(text.starts_with("HTTP/1.1 200 ") && text.contains("graspable"), "{text}");
}

/// Send, however little of it the server takes; it may close the connection meanwhile.
async fn send(mut stream: TcpStream, text: String) -> TcpStream {
    let sending = tokio::task::spawn_blocking(move || {
        stream.set_write_timeout(Some(Duration::from_millis(200))).unwrap();
        let _ = stream.write_all(text.as_bytes());
        stream
    });
    sending.await.unwrap()
}

#[tokio::test]
async fn a_client_that_closes_its_sending_half_has_hung_up() {
    static RUNNING: AtomicUsize = AtomicUsize::new(0);
    let host = Host::with(ServerSettings { threads: 1, ..ServerSettings::default() }, endless!(RUNNING)).await;
    let client = host.raw(&raw_plan(&scene(60_000)));
    wait_until(|| RUNNING.load(Ordering::SeqCst) == 1).await;
    client.shutdown(Shutdown::Write).unwrap();
    wait_until(|| RUNNING.load(Ordering::SeqCst) == 0).await;
    assert_eq!(read_to_end(client).await, "");
}

#[tokio::test]
async fn a_head_that_comes_field_by_field_gets_no_more_time_than_any_other() {
    let header_timeout = Duration::from_millis(200);
    let host = Host::with(ServerSettings { header_timeout, ..ServerSettings::default() }, Engine::default()).await;
    let mut client = host.raw("GET /livez HTTP/1.1\r\n");
    let mut fields = 0;
    // Each field comes well within the time, the whole never.
    while client.write_all(format!("x-{fields}: y\r\n").as_bytes()).is_ok() {
        fields += 1;
        assert!(fields < 1000, "the server waits for ever");
        tokio::time::sleep(Duration::from_millis(60)).await;
    }
    others_are_served(&host).await;
}

#[tokio::test]
async fn a_flood_of_requests_on_one_connection_holds_up_nobody_else() {
    let host = Host::start().await;
    let requests = "GET /openapi.json HTTP/1.1\r\nhost: x\r\n\r\n".repeat(20_000);
    let never_reads = send(host.raw(""), requests.clone()).await;
    let reads_on = send(host.raw(""), requests).await;
    others_are_served(&host).await;
    drop((never_reads, reads_on));
    others_are_served(&host).await;
}

#[tokio::test]
async fn a_flood_of_plans_on_one_connection_is_planned_one_at_a_time() {
    static RUNNING: AtomicUsize = AtomicUsize::new(0);
    let host = Host::with(ServerSettings { threads: 2, ..ServerSettings::default() }, endless!(RUNNING)).await;
    let flood = send(host.raw(""), raw_plan(&scene(1000)).repeat(1000)).await;
    wait_until(|| RUNNING.load(Ordering::SeqCst) == 1).await;
    // The second thread is free for somebody else.
    let other = host.raw(&raw_plan(&scene(60_000)));
    wait_until(|| RUNNING.load(Ordering::SeqCst) == 2).await;
    drop((flood, other));
    // That the first has hung up shows only once its answer can't be written: what it has sent stands before its end.
    wait_until(|| RUNNING.load(Ordering::SeqCst) == 0).await;
}

#[tokio::test]
async fn a_flood_of_header_fields_is_refused() {
    let host = Host::start().await;
    let client = send(host.raw(""), format!("GET /livez HTTP/1.1\r\n{}", "x: y\r\n".repeat(500_000))).await;
    let text = read_to_end(client).await;
    assert!(text.is_empty() || text.starts_with("HTTP/1.1 431 "), "{text}");
    others_are_served(&host).await;
}

#[tokio::test]
async fn noise_is_refused() {
    let host = Host::start().await;
    let mut state: u32 = 7;
    for length in [1, 100, 10_000, 1_000_000] {
        let mut client = host.raw("");
        let noise: Vec<u8> = (0..length)
            .map(|_| {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                (state >> 24) as u8
            })
            .collect();
        // The server may close before it has everything.
        let _ = client.write_all(&noise).and_then(|()| client.write_all(b"\r\n\r\n"));
        let _ = client.shutdown(Shutdown::Write);
        assert!(!read_to_end(client).await.contains("HTTP/1.1 2"));
    }
    others_are_served(&host).await;
}

#[tokio::test]
async fn a_body_of_two_lengths_is_refused() {
    let host = Host::start().await;
    let head = "POST /v1/plans HTTP/1.1\r\nhost: x\r\ncontent-type: application/json\r\nconnection: close\r\n";
    for lengths in
        ["content-length: 5\r\ncontent-length: 6", "content-length: -1", "content-length: 99999999999999999999"]
    {
        let text = host.ask(&format!("{head}{lengths}\r\n\r\n{{}}")).await;
        assert!(text.starts_with("HTTP/1.1 400 "), "{lengths}: {text}");
    }
    // A chunked body has no other length, so nobody behind or before this service reads another one.
    let both = "transfer-encoding: chunked\r\ncontent-length: 2\r\n\r\n2\r\n{}\r\n0\r\n\r\n";
    let text = host.ask(&format!("{head}{both}")).await;
    assert!(text.starts_with("HTTP/1.1 422 ") || text.starts_with("HTTP/1.1 400 "), "{text}");
    others_are_served(&host).await;
}

#[tokio::test]
async fn nested_and_endless_json_is_refused_and_huge_names_are() {
    let host = Host::start().await;
    let json = [("content-type", "application/json")];
    for (body, status) in [
        ("[".repeat(1_000_000), 400),
        ("{\"a\":".repeat(500_000), 400),
        (format!("{}{}", "[".repeat(100_000), "]".repeat(100_000)), 400),
        (format!("\"{}", "a".repeat(3_900_000)), 400),
        (format!("[{}0]", "0,".repeat(1_900_000)), 422),
        (format!("{}1", "9".repeat(3_000_000)), 422),
    ] {
        let reply = host.post_with("/v1/plans", &json, body).await;
        assert_eq!(reply.status, status, "{}", reply.text.chars().take(300).collect::<String>());
    }
    let mut named = scene(60_000);
    named["objects"][0]["id"] = json!("x".repeat(3_000_000));
    named["target"] = named["objects"][0]["id"].clone();
    named["scene_id"] = json!("y".repeat(500_000));
    let reply = host.post("/v1/plans", &named).await;
    assert!(reply.status == 422 || reply.status == 413, "{}", reply.status);
    assert!(reply.text.len() < 10_000, "a huge name comes back whole");
    others_are_served(&host).await;
}
