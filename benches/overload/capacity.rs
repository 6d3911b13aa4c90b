//! What a server gets done when nobody asks for more: some clients, each with one request at a time.

use std::net::SocketAddr;
use std::thread;
use std::time::{Duration, Instant};

use super::client::{Client, get};
use super::mix::Mix;

/// As many as keep the threads busy without a queue to speak of.
const PLAN_CLIENTS: usize = 3;
const JOB_CLIENTS: usize = 3;
const WINDOW: Duration = Duration::from_secs(10);

/// Ends per second, of both kinds at the same time.
pub(super) struct Capacity {
    pub(super) plans: f64,
    pub(super) jobs: f64,
}

pub(super) fn measure(address: SocketAddr, mix: &Mix) -> Capacity {
    let until = Instant::now() + WINDOW;
    let plans = |at: usize| {
        let mut client = Client::connect(address);
        let orders = mix.plans.iter().cycle().skip(at).take_while(|_| Instant::now() < until);
        orders.filter(|order| client.ask(&order.request).status == 200).count()
    };
    let jobs = |at: usize| {
        let mut client = Client::connect(address);
        let orders = mix.jobs.iter().cycle().skip(at).take_while(|_| Instant::now() < until);
        orders.filter(|order| ended(&mut client, order)).count()
    };
    let (plans, jobs) = (&plans, &jobs);
    let started = Instant::now();
    let (plans, jobs): (usize, usize) = thread::scope(|scope| {
        let plans: Vec<_> = (0..PLAN_CLIENTS).map(|at| scope.spawn(move || plans(at))).collect();
        let jobs: Vec<_> = (0..JOB_CLIENTS).map(|at| scope.spawn(move || jobs(at))).collect();
        let sum = |clients: Vec<thread::ScopedJoinHandle<'_, usize>>| {
            clients.into_iter().map(|client| client.join().expect("answers")).sum()
        };
        (sum(plans), sum(jobs))
    });
    let rate = |count: usize| f64::from(u32::try_from(count).expect("few")) / started.elapsed().as_secs_f64();
    Capacity { plans: rate(plans), jobs: rate(jobs) }
}

/// True if the job was accepted and has ended.
fn ended(client: &mut Client, order: &[u8]) -> bool {
    let accepted = client.ask(order);
    let Some(place) = accepted.header("location") else { return false };
    String::from_utf8_lossy(&client.ask(&get(&format!("{place}?wait_ms=60000"))).body).contains("\"finished_at\":\"")
}
