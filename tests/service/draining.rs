//! The end of the service: who is answered, who is refused, who is not waited for.

use core::time::Duration;
use std::io::Read;
use std::net::TcpStream;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Instant;

use singulate::api::{Engine, ServerSettings};
use singulate::wire::PlanRequest;
use singulate_planner::budget::Budget;
use singulate_planner::paper::Judged;
use singulate_planner::plan::PlanError;
use singulate_planner::search::Progress;

use crate::host::{Host, PATIENCE, raw_plan, read_to_end, scene, wait_until};
use crate::planning::{endless, timed_out, wait_for_the_end};

const LIVEZ: &str = "GET /livez HTTP/1.1\r\nhost: x\r\n\r\n";
const READYZ: &str = "GET /readyz HTTP/1.1\r\nhost: x\r\n\r\n";

/// One thread, and so long to drain.
fn draining_within(drain: Duration) -> ServerSettings {
    ServerSettings { threads: 1, drain, ..ServerSettings::default() }
}

/// Ask a host to stop, and wait until new requests are told that it does.
async fn begin_to_drain(host: &Host) {
    host.ask_to_stop();
    let started = Instant::now();
    while !host.ask(READYZ).await.starts_with("HTTP/1.1 503 ") {
        assert!(started.elapsed() < PATIENCE, "it is ready still");
    }
}

/// Clients of which the service expects nothing more: one that rests after an answer, one that has sent nothing, one with
/// half a head.
async fn idle_clients(host: &Host) -> Vec<TcpStream> {
    let mut rested = host.raw(LIVEZ);
    let answer = tokio::task::spawn_blocking(move || {
        let mut bytes = Vec::new();
        while !bytes.ends_with(b"{\"status\":\"ok\"}") {
            let mut piece = [0; 1024];
            let count = rested.read(&mut piece).unwrap();
            assert!(count > 0);
            bytes.extend_from_slice(&piece[..count]);
        }
        rested
    });
    vec![answer.await.unwrap(), host.raw(""), host.raw("GET /livez HTTP/1.1\r\nhost:")]
}

#[tokio::test]
async fn while_it_drains_a_service_answers_probes_and_begins_nothing_new() {
    static RUNNING: AtomicUsize = AtomicUsize::new(0);
    let host = Host::with(draining_within(2 * PATIENCE), endless!(RUNNING)).await;
    let running = host.raw(&raw_plan(&scene(60_000)));
    wait_until(|| RUNNING.load(Ordering::SeqCst) == 1).await;
    begin_to_drain(&host).await;
    assert!(host.ask(LIVEZ).await.starts_with("HTTP/1.1 200 "));
    for path in ["/v1/plans", "/v1/survey", "/v1/knowledge"] {
        let reply = host.post(path, &scene(1000)).await;
        reply.is_problem(503, "not_ready");
        assert_eq!((reply.header("retry-after"), reply.header("connection")), ("1", "close"));
    }
    assert_eq!(RUNNING.load(Ordering::SeqCst), 1, "what ran still runs");
    drop(running);
    let address = host.address;
    host.stopped().await;
    assert_eq!(RUNNING.load(Ordering::SeqCst), 0);
    assert!(TcpStream::connect(address).is_err());
}

#[tokio::test]
async fn what_runs_is_finished() {
    static RUNNING: AtomicUsize = AtomicUsize::new(0);
    let settings = ServerSettings { threads: 2, ..draining_within(PATIENCE) };
    let host = Host::with(settings, endless!(RUNNING)).await;
    let running = [host.raw(&raw_plan(&scene(500))), host.raw(&raw_plan(&scene(1000)))];
    wait_until(|| RUNNING.load(Ordering::SeqCst) == 2).await;
    host.ask_to_stop();
    for client in running {
        let text = read_to_end(client).await;
        assert!(text.starts_with("HTTP/1.1 200 ") && text.contains("timed_out"), "{text}");
    }
    host.stopped().await;
}

#[tokio::test]
async fn a_service_drains_within_its_time_with_any_client_connected() {
    static RUNNING: AtomicUsize = AtomicUsize::new(0);
    let host = Host::with(draining_within(Duration::from_secs(2)), endless!(RUNNING)).await;
    let running = host.raw(&raw_plan(&scene(60_000)));
    wait_until(|| RUNNING.load(Ordering::SeqCst) == 1).await;
    let waiting = host.raw(&raw_plan(&scene(60_000)));
    let idle = idle_clients(&host).await;
    let half_a_body = host.raw(&raw_plan(&scene(1000))[..200]);
    let greedy = host.raw(&"GET /openapi.json HTTP/1.1\r\nhost: x\r\n\r\n".repeat(500));
    let started = Instant::now();
    host.ask_to_stop();
    // The best so far, long before its own time limit.
    let text = read_to_end(running).await;
    assert!(text.starts_with("HTTP/1.1 200 ") && text.contains("timed_out"), "{text}");
    host.stopped().await;
    assert!(started.elapsed() < PATIENCE / 2, "a time limit ended it, not the time for draining");
    drop((waiting, idle, half_a_body, greedy));
}

#[tokio::test]
async fn idle_connections_do_not_delay_the_end_of_a_service() {
    let host = Host::with(draining_within(2 * PATIENCE), Engine::default()).await;
    let idle = idle_clients(&host).await;
    host.ask_to_stop();
    // The time for draining is longer than this waits.
    host.stopped().await;
    for client in idle {
        read_to_end(client).await;
    }
}

#[tokio::test]
async fn a_computation_that_does_not_end_is_left_behind() {
    static RELEASED: AtomicBool = AtomicBool::new(false);
    static RUNNING: AtomicBool = AtomicBool::new(false);
    fn plan(_: &PlanRequest, _: &Budget<'_>, _: Progress<'_>) -> Result<Judged, PlanError> {
        RUNNING.store(true, Ordering::SeqCst);
        while !RELEASED.load(Ordering::SeqCst) {
            std::thread::sleep(Duration::from_millis(1));
        }
        Ok(timed_out())
    }
    let host = Host::with(draining_within(Duration::from_millis(100)), Engine { plan, ..Engine::default() }).await;
    let client = host.raw(&raw_plan(&scene(60_000)));
    wait_until(|| RUNNING.load(Ordering::SeqCst)).await;
    host.ask_to_stop();
    host.stopped().await;
    assert_eq!(read_to_end(client).await, "");
    RELEASED.store(true, Ordering::SeqCst);
}
