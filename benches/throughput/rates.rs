//! The rate of plans over HTTP beside that of `/livez`, and beside that of the JSON alone.

use core::hint::black_box;
use std::net::SocketAddr;
use std::sync::Barrier;
use std::thread;
use std::time::{Duration, Instant};

use singulate::wire::{AnswerBody, PlanRequest, RequestLimits, read_scene};
use singulate_planner::budget::Budget;
use singulate_planner::paper::{Judged, plan_by};
use singulate_planner::search::SILENT;

use super::client::{Client, get, post};

const CONNECTIONS: usize = 4;
/// Both kinds take turns, so that what else goes on hits both.
const ROUNDS: usize = 8;
const TURN: Duration = Duration::from_millis(500);

/// Prints the rates; gives that of plans over that of `/livez`, the median of the rounds.
pub(super) fn print(address: SocketAddr, bodies: &[Vec<u8>]) -> f64 {
    let probes = [get("/livez")];
    let plans: Vec<Vec<u8>> = bodies.iter().map(|body| post("/v1/plans", body)).collect();
    let over_http = |requests: &[Vec<u8>]| {
        rate(CONNECTIONS, || {
            let (mut client, mut requests) = (Client::connect(address), requests.iter().cycle());
            move || assert_eq!(client.ask(requests.next().expect("a cycle")).status, 200)
        })
    };
    over_http(&probes);
    over_http(&plans);
    let rounds: Vec<(f64, f64)> = (0..ROUNDS).map(|_| (over_http(&probes), over_http(&plans))).collect();
    let answered: Vec<(&[u8], PlanRequest, Judged)> = bodies.iter().map(|body| answered(body)).collect();
    let alone = |threads| {
        rate(threads, || {
            let mut answered = answered.iter().cycle();
            move || json(answered.next().expect("a cycle"))
        })
    };
    let row = |what: &str, rate: f64| println!("{what:<34} {rate:>10.0}");
    println!("\n{:<34} {:>10}", "on 4 connections, N=50", "per s");
    row("/livez", median(rounds.iter().map(|round| round.0)));
    row("plans", median(rounds.iter().map(|round| round.1)));
    row("reading and writing, 1 thread", alone(1));
    row("reading and writing, 4 threads", alone(CONNECTIONS));
    median(rounds.iter().map(|(probes, plans)| plans / probes))
}

/// How often a second so many threads together do what `prepare` gives each of them.
fn rate<W: FnMut()>(threads: usize, prepare: impl Fn() -> W + Sync) -> f64 {
    let together = Barrier::new(threads);
    let work = || {
        let mut work = prepare();
        together.wait();
        let (started, mut count) = (Instant::now(), 0_u32);
        while started.elapsed() < TURN {
            work();
            count += 1;
        }
        f64::from(count) / started.elapsed().as_secs_f64()
    };
    thread::scope(|scope| {
        let threads: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        threads.into_iter().map(|thread| thread.join().expect("it works")).sum()
    })
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_unstable_by(f64::total_cmp);
    values[values.len() / 2]
}

fn answered(body: &[u8]) -> (&[u8], PlanRequest, Judged) {
    let request = read_scene(body, &RequestLimits::default()).expect("sound");
    let judged = plan_by(&request.methods, &request.scene, &request.settings, &Budget::unlimited(), SILENT);
    (body, request, judged.expect("checked"))
}

/// All that is done with JSON for one answer.
fn json((body, request, judged): &(&[u8], PlanRequest, Judged)) {
    black_box(read_scene(body, &RequestLimits::default()).expect("sound"));
    black_box(serde_json::to_vec(&AnswerBody::new(request, judged)).expect("JSON"));
}
