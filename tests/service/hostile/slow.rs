//! Clients that take their time.

use core::time::Duration;
use std::io::Write;
use std::net::{Shutdown, TcpStream};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use singulate::api::{Engine, ServerSettings};
use singulate::jobs::JobSettings;
use singulate::wire::PlanRequest;
use singulate_planner::budget::Budget;
use singulate_planner::paper::Judged;
use singulate_planner::plan::PlanError;
use singulate_planner::search::Progress;
use tokio::time::sleep;

use super::{others_are_served, served_meanwhile};
use crate::host::{Host, PATIENCE, raw_plan, read_to_end, scene, wait_until};
use crate::jobs::submit;
use crate::planning::{endless, wait_for_the_end};

/// How long the server waits, and how long the client pauses: each piece comes well within the time, the whole never.
const TIMEOUT: Duration = Duration::from_millis(200);
const PAUSE: Duration = Duration::from_millis(60);

/// Send one piece after the other until the server has had enough.
async fn drip(client: &mut TcpStream, piece: &str) {
    let mut pieces = 0;
    while client.write_all(piece.as_bytes()).is_ok() {
        pieces += 1;
        assert!(pieces < 1000, "the server waits for ever");
        sleep(PAUSE).await;
    }
}

#[tokio::test]
async fn a_head_that_comes_field_by_field_gets_no_more_time_than_any_other() {
    let host =
        Host::with(ServerSettings { header_timeout: TIMEOUT, ..ServerSettings::default() }, Engine::default()).await;
    served_meanwhile(&host, async || drip(&mut host.raw("GET /livez HTTP/1.1\r\n"), "x: y\r\n").await).await;
}

#[tokio::test]
async fn a_body_that_comes_byte_by_byte_gets_no_more_time_than_any_other() {
    let host =
        Host::with(ServerSettings { body_timeout: TIMEOUT, ..ServerSettings::default() }, Engine::default()).await;
    let head = "POST /v1/plans HTTP/1.1\r\nhost: x\r\ncontent-type: application/json\r\n";
    served_meanwhile(&host, async || {
        for (length, piece) in [("content-length: 100000", " "), ("transfer-encoding: chunked", "1\r\n \r\n")] {
            let mut client = host.raw(&format!("{head}{length}\r\n\r\n"));
            drip(&mut client, piece).await;
        }
    })
    .await;
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
async fn clients_that_close_their_sending_half_hold_up_nobody() {
    let host = Host::start().await;
    let plan = raw_plan(&scene(60_000));
    let begun = &plan[..plan.len() - 1];
    served_meanwhile(&host, async || {
        for text in ["", "GET /livez HT", "GET /livez HTTP/1.1\r\nhost: x\r\n\r\n", begun, &plan] {
            let client = host.raw(text);
            client.shutdown(Shutdown::Write).unwrap();
            // Whatever it is told, the connection ends by itself.
            read_to_end(client).await;
        }
    })
    .await;
}

/// Plans as ever, but never comes to an end with a scene whose first object is so called.
fn all_but_one_ends() -> Engine {
    fn plan(request: &PlanRequest, budget: &Budget<'_>, progress: Progress<'_>) -> Result<Judged, PlanError> {
        if request.scene.objects()[0].id() == "held" {
            return wait_for_the_end(&AtomicUsize::new(0), budget);
        }
        (Engine::default().plan)(request, budget, progress)
    }
    Engine { plan, ..Engine::default() }
}

#[tokio::test]
async fn streams_of_events_that_nobody_reads_hold_up_nobody() {
    let jobs = JobSettings { threads: 1, ..JobSettings::default() };
    let most = 50;
    let settings = ServerSettings { jobs, max_streams: most, ..ServerSettings::default() };
    let host = Host::with(settings, all_but_one_ends()).await;
    let mut held = scene(60_000);
    held["objects"][0]["id"] = "held".into();
    held["target"] = "held".into();
    let events = format!("/v1/jobs/{}/events", submit(&host, &held).await["id"].as_str().unwrap());
    let listen = format!("GET {events} HTTP/1.1\r\nhost: x\r\n\r\n");
    let wait_for = async |open: usize| {
        let (started, line) = (Instant::now(), format!("singulate_streams_open {open}"));
        while host.get("/metrics").await.text.lines().all(|other| other != line) {
            assert!(started.elapsed() < PATIENCE);
        }
    };
    served_meanwhile(&host, async || {
        // Each asks on and on, and reads none of it.
        let listeners: Vec<_> = (0..most).map(|_| host.raw(&listen.repeat(10))).collect();
        wait_for(most).await;
        host.get(&events).await.is_problem(503, "overloaded");
        drop(listeners);
        wait_for(0).await;
    })
    .await;
}

#[tokio::test]
async fn answers_that_nobody_reads_hold_up_nobody() {
    let settings = ServerSettings { write_timeout: TIMEOUT, ..ServerSettings::default() };
    let host = Host::with(settings, Engine::default()).await;
    let requests = "GET /openapi.json HTTP/1.1\r\nhost: x\r\n\r\n".repeat(500);
    let greedy: Vec<_> = (0..20).map(|_| host.raw(&requests)).collect();
    others_are_served(&host).await;
    // They are cut off, though they would wait for ever.
    for client in greedy {
        drip(&mut client.try_clone().unwrap(), "x").await;
    }
}
