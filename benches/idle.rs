//! What 10,000 connections that rest cost: memory, and the time of a plan for somebody else meanwhile.
//!
//! The service is a process of its own, so that its memory is its own. Fails where it grows by more than 200 MB, where a
//! plan takes more than twice as long in the median as without them, or where one of them was not held. By TLS it tells
//! the memory of each connection alone. Linux only: reads the memory from `/proc`.

mod cases;
#[path = "cases/client.rs"]
mod client;
#[path = "cases/server.rs"]
mod server;
#[path = "cases/tls.rs"]
mod tls;

use std::process::ExitCode;
use std::time::{Duration, Instant};

use rustix::process::{Resource, getrlimit, setrlimit};
use singulate::wire::SceneBody;

use client::{Client, get, post};
use server::{Server, resident};
use tls::TlsServer;

const CONNECTIONS: u64 = 10_000;
/// Files of this process, and of the service, that are none of them.
const OTHER_FILES: u64 = 200;
const MAX_GROWTH_KB: u64 = 200_000;
const MAX_RATIO: f64 = 2.0;
/// Enough for a mean.
const TLS_CONNECTIONS: u64 = 2000;
/// Plans in one median.
const PLANS: usize = 1000;

fn main() -> ExitCode {
    let mut limit = getrlimit(Resource::Nofile);
    limit.current = limit.maximum;
    setrlimit(Resource::Nofile, limit).expect("the hard limit");
    let count = limit.maximum.map_or(CONNECTIONS, |files| files.saturating_sub(OTHER_FILES).min(CONNECTIONS));
    if count < CONNECTIONS {
        println!("the limit of open files allows only {count} connections");
    }
    let server = Server::start("sqlite::memory:", &[]);
    let (plan, livez) = (plan(), get("/livez"));
    // What the first plans allocate is no cost of connections.
    median(&server, &plan);
    let (memory, without) = (resident(server.process()), median(&server, &plan));
    let mut resting: Vec<_> = (0..count).map(|_| rested(&server, &livez)).collect();
    let (growth, with) = (resident(server.process()).saturating_sub(memory), median(&server, &plan));
    let held = resting.iter_mut().filter_map(|connection| connection.try_ask(&livez).ok()).count() as u64;
    drop((resting, server));
    let ratio = with.as_secs_f64() / without.as_secs_f64();
    let ms = |duration: Duration| duration.as_secs_f64() * 1e3;
    println!("{held} of {count} connections held; {:.1} kB each, {growth} kB in all", growth as f64 / count as f64);
    println!("a plan: {:.2} ms without them, {:.2} ms with them, {ratio:.2} times", ms(without), ms(with));
    println!("by TLS {:.1} kB each", by_tls(count.min(TLS_CONNECTIONS), &livez));
    println!("at most {MAX_GROWTH_KB} kB and {MAX_RATIO} times");
    if held == count && growth <= MAX_GROWTH_KB && ratio <= MAX_RATIO { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// The request for a plan of 50 dishes.
fn plan() -> Vec<u8> {
    let scene = cases::scene(cases::equal_density(50, 0));
    post("/v1/plans", &serde_json::to_vec(&SceneBody::new(&scene, None)).expect("JSON"))
}

/// A connection that rests after an answer. One that asks nothing at first is cut off after some seconds.
fn rested(server: &Server, livez: &[u8]) -> Client {
    let mut connection = Client::connect(server.address());
    assert_eq!(connection.ask(livez).status, 200);
    connection
}

/// The memory of a connection that rests, kB.
fn by_tls(count: u64, livez: &[u8]) -> f64 {
    let tls = TlsServer::start();
    let rested = |_| {
        let mut connection = tls.connect();
        assert_eq!(connection.ask(livez).status, 200);
        connection
    };
    let first = rested(0);
    let before = resident(tls.server.process());
    let resting: Vec<_> = (0..count).map(rested).collect();
    let growth = resident(tls.server.process()).saturating_sub(before);
    drop((first, resting));
    growth as f64 / count as f64
}

/// The median time of a plan on one connection.
fn median(server: &Server, plan: &[u8]) -> Duration {
    let mut connection = Client::connect(server.address());
    let once = |_| {
        let started = Instant::now();
        assert_eq!(connection.ask(plan).status, 200);
        started.elapsed()
    };
    let mut taken: Vec<Duration> = (0..PLANS).map(once).collect();
    taken.sort_unstable();
    taken[PLANS / 2]
}
