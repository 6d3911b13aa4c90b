//! How long after its time limit an answer leaves: hard scenes and short limits, alone and eight at a time, against a
//! server in this process with the default settings.
//!
//! Counted at the client, from the end of its sending to the last byte of the answer, so the way through the loopback is
//! in it. A thread that sleeps for 10 ms at a time tells how late the machine itself is. Fails where an answer was later
//! than 50 ms and that thread's 99th percentile together.
//!
//! And how soon a core is free again once a computation is to end before its time, by a hang-up or for the best so far:
//! fails where that took longer than 20 ms and the same percentile.

mod cases;
#[path = "cases/client.rs"]
#[expect(dead_code, reason = "sends and receives apart, for the time between them counts")]
mod client;
#[path = "cases/ends.rs"]
mod ends;
#[path = "cases/hard.rs"]
mod hard;
#[path = "cases/timer.rs"]
mod timer;

use std::collections::BTreeMap;
use std::net::SocketAddr;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::Barrier;
use std::thread;
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use singulate::api::{self, ServerSettings};
use singulate::jobs::JobSettings;
use singulate::scene::{Scene, SceneDraft};
use singulate::wire::{RequestLimits, SceneBody, read_scene};
use tokio::net::TcpListener;

use client::{Client, post};
use ends::End;
use timer::{Timer, p99};

const GRACE: Duration = Duration::from_millis(50);
/// For a computation that is to end before its time.
const END_GRACE: Duration = Duration::from_millis(20);
const LIMITS_MS: [u64; 5] = [1, 10, 50, 200, 1000];
const CLIENTS: [usize; 2] = [1, 8];
/// Each row repeats its requests for so long, and no more often than that.
const ROW: Duration = Duration::from_millis(1500);
const MAX_ROUNDS: u128 = 10;
/// A name, a scene, and one of the paper's methods where it is to be planned by that.
type Method = Option<(&'static str, &'static str)>;
type Case = (&'static str, fn() -> SceneDraft, Method);
const SCENES: [Case; 10] = [
    ("pressed, 300", || hard::pressed(300, 0), None),
    ("pressed, 1,000", || hard::pressed(1000, 0), None),
    ("pressed, 10,000", || hard::pressed(10_000, 0), None),
    ("dishes at 45 %, 10,000", || cases::equal_density(10_000, 0), None),
    ("crumbs, 7 mm, 10,000", || hard::crumbs(2.0, 0.007), None),
    ("crumbs, 16.5 mm, 10,000", || hard::crumbs(4.0, 0.0165), None),
    ("sectors, 10,000", || cases::equal_density(10_000, 0), Some(("grasp_model", "sector"))),
    ("LOBS, deep, 100", || hard::too_much_for_lobs(), Some(("search", "lobs"))),
    ("forward A*, locked, 200", || hard::locked(cases::equal_density(200, 0)), Some(("search", "forward_astar"))),
    ("raster, 2,500", || hard::freed_last(cases::equal_density(2500, 0)), Some(("placement", "raster"))),
];

fn main() -> ExitCode {
    let address = serve();
    let timer = Timer::start();
    let mut worst = Duration::ZERO;
    println!(
        "{:<24} {:>9} {:>9} {:>7} {:>8} {:>8}  answers",
        "scene", "limit ms", "at once", "count", "p99 ms", "worst"
    );
    for (name, draft, method) in SCENES {
        let scene = cases::scene(draft());
        println!("{name}: reading the body alone takes {:.1} ms", ms(reading(&scene, method)));
        for limit in LIMITS_MS {
            for clients in CLIENTS {
                let row = Row::measure(
                    address,
                    &post("/v1/plans", &body(&scene, method, limit)),
                    clients,
                    Duration::from_millis(limit),
                );
                println!("{name:<24} {limit:>9} {clients:>9} {row}");
                worst = worst.max(row.worst());
            }
        }
    }
    let ended = early_ends();
    let p99 = timer.stop();
    println!("worst {:.1} ms; the timer's p99 {:.1} ms; at most 50 ms and that", ms(worst), ms(p99));
    println!("worst early end {:.1} ms; at most 20 ms and that", ms(ended));
    if worst <= GRACE + p99 && ended <= END_GRACE + p99 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// The longest time to an early end.
fn early_ends() -> Duration {
    let runtime = tokio::runtime::Runtime::new().expect("threads");
    let mut worst = Duration::ZERO;
    println!("{:<24} {:>11} {:>7} {:>9} {:>8}", "scene", "end", "count", "median ms", "worst");
    for (name, draft, method) in SCENES {
        let body = body(&cases::scene(draft()), method, 60_000);
        let request = Arc::new(read_scene(&body, &RequestLimits::default()).expect("sound"));
        for (end, words) in [(End::HangUp, "hang-up"), (End::BestSoFar, "best so far")] {
            let taken = ends::ends(&runtime, &request, end);
            let Some(&last) = taken.last() else { continue };
            let median = taken[taken.len() / 2];
            println!("{name:<24} {words:>11} {:>7} {:>9.1} {:>8.1}", taken.len(), ms(median), ms(last));
            worst = worst.max(last);
        }
    }
    worst
}

fn ms(duration: Duration) -> f64 {
    duration.as_secs_f64() * 1e3
}

/// A server that runs until this process ends.
fn serve() -> SocketAddr {
    let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().build().expect("threads");
    let listener = runtime.block_on(TcpListener::bind("127.0.0.1:0")).expect("a free port");
    let address = listener.local_addr().expect("bound");
    let jobs = JobSettings { url: "sqlite::memory:".to_owned(), ..JobSettings::default() };
    let settings = ServerSettings { jobs, ..ServerSettings::default() };
    thread::spawn(move || runtime.block_on(api::run(listener, settings, core::future::pending())));
    address
}

/// The fastest of some readings of the scene: the least disturbed one.
fn reading(scene: &Scene, method: Method) -> Duration {
    let body = body(scene, method, 1000);
    let run = |_| {
        let started = Instant::now();
        read_scene(&body, &RequestLimits::default()).expect("sound");
        started.elapsed()
    };
    (0..5).map(run).min().expect("some runs")
}

fn body(scene: &Scene, method: Method, limit: u64) -> Vec<u8> {
    let mut body = serde_json::to_value(SceneBody::new(scene, None)).expect("JSON");
    body["settings"] = json!({"time_limit_ms": limit});
    if let Some((setting, value)) = method {
        body["settings"][setting] = json!(value);
    }
    body.to_string().into_bytes()
}

/// The answers to one kind of request.
struct Row {
    lateness: Vec<Duration>,
    words: BTreeMap<String, usize>,
}

impl Row {
    fn measure(address: SocketAddr, request: &[u8], clients: usize, limit: Duration) -> Self {
        let (together, rounds) = (Barrier::new(clients), ROW.as_millis() / limit.as_millis() + 1);
        let client = || {
            let mut connection = Client::connect(address);
            let round = |_| {
                together.wait();
                ask(&mut connection, request)
            };
            (0..rounds.min(MAX_ROUNDS)).map(round).collect::<Vec<_>>()
        };
        let answers: Vec<(Duration, String)> = thread::scope(|scope| {
            let clients: Vec<_> = (0..clients).map(|_| scope.spawn(client)).collect();
            clients.into_iter().flat_map(|client| client.join().expect("an answer")).collect()
        });
        let mut row = Self { lateness: Vec::new(), words: BTreeMap::new() };
        for (taken, word) in answers {
            row.lateness.push(taken.saturating_sub(limit));
            *row.words.entry(word).or_default() += 1;
        }
        row.lateness.sort_unstable();
        row
    }

    fn worst(&self) -> Duration {
        self.lateness.last().copied().unwrap_or_default()
    }
}

impl core::fmt::Display for Row {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let (count, p99, worst) = (self.lateness.len(), ms(p99(&self.lateness)), ms(self.worst()));
        write!(f, "{count:>7} {p99:>8.1} {worst:>8.1} ")?;
        self.words.iter().try_for_each(|(word, count)| write!(f, " {word} {count}"))
    }
}

/// How long the answer took from the end of the sending, and its verdict, or its status where it is none.
fn ask(connection: &mut Client, request: &[u8]) -> (Duration, String) {
    connection.send(request).expect("sent");
    let sent = Instant::now();
    let reply = connection.receive().expect("an answer");
    let taken = sent.elapsed();
    let body: Value = serde_json::from_slice(&reply.body).expect("JSON");
    let word = body["verdict"].as_str().map_or_else(|| format!("status {}", body["status"]), str::to_owned);
    (taken, word)
}
