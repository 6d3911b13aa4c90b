//! Clients that send too much.

use std::io::Write;
use std::net::Shutdown;
use std::sync::atomic::{AtomicUsize, Ordering};

use singulate::api::{Engine, ServerSettings};
use singulate_planner::budget::Budget;
use singulate_planner::paper::Judged;
use singulate_planner::plan::PlanError;

use super::{others_are_served, send, served_meanwhile};
use crate::host::{Host, PATIENCE, raw_plan, read_to_end, scene, wait_until};
use crate::planning::{endless, wait_for_the_end};

#[tokio::test]
async fn a_flood_of_requests_on_one_connection_holds_up_nobody_else() {
    let host = Host::start().await;
    let requests = "GET /openapi.json HTTP/1.1\r\nhost: x\r\n\r\n".repeat(20_000);
    served_meanwhile(&host, async || drop(send(host.raw(""), requests.clone()).await)).await;
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

// More connections than the system holds for a server that can't accept: on another thread than the server.
#[tokio::test(flavor = "multi_thread")]
async fn a_flood_of_connections_that_ask_nothing_holds_up_nobody_else() {
    // None of them is cut off meanwhile.
    let settings = ServerSettings { header_timeout: PATIENCE * 10, ..ServerSettings::default() };
    let host = Host::with(settings, Engine::default()).await;
    served_meanwhile(&host, async || {
        let connections: Vec<_> = (0..200).map(|_| host.raw("")).collect();
        others_are_served(&host).await;
        drop(connections);
    })
    .await;
}

#[tokio::test]
async fn a_flood_of_header_fields_is_refused() {
    let host = Host::start().await;
    let flood = format!("GET /livez HTTP/1.1\r\n{}", "x: y\r\n".repeat(500_000));
    served_meanwhile(&host, async || {
        let text = read_to_end(send(host.raw(""), flood.clone()).await).await;
        assert!(text.is_empty() || text.starts_with("HTTP/1.1 431 "), "{text}");
    })
    .await;
}

#[tokio::test]
async fn noise_is_refused() {
    let host = Host::start().await;
    let mut state: u32 = 7;
    let mut noise = |length: usize| -> Vec<u8> {
        let byte = |_| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 24) as u8
        };
        (0..length).map(byte).collect()
    };
    served_meanwhile(&host, async || {
        for length in [1, 100, 10_000, 1_000_000] {
            let mut client = send(host.raw(""), noise(length)).await;
            // The server may have closed before it had everything.
            let _ = client.write_all(b"\r\n\r\n");
            let _ = client.shutdown(Shutdown::Write);
            assert!(!read_to_end(client).await.contains("HTTP/1.1 2"));
        }
    })
    .await;
}
