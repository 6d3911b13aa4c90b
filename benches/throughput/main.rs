//! How much a server gets done: jobs from their submission to their end, on SQLite and, where `TEST_POSTGRES_URL` names
//! one, on PostgreSQL; and plans over HTTP against the least that it can answer, `/livez`, on the same connections.
//!
//! The ratio is what counts: absolute rates drift with the machine. Fails where plans come at less than 0.05 of the rate of
//! `/livez`.

#[path = "../cases/client.rs"]
mod client;
mod jobs;
#[path = "../cases/paper.rs"]
mod paper;
mod rates;
#[path = "../cases/server.rs"]
mod server;
#[path = "../cases/store_file.rs"]
mod store_file;

use std::process::ExitCode;

use server::Server;
use singulate::wire::SceneBody;
use store_file::StoreFile;

const SCENES: u64 = 40;
/// The least rate of plans over that of `/livez`.
const LEAST: f64 = 0.05;

fn main() -> ExitCode {
    let body = |seed| serde_json::to_vec(&SceneBody::new(&paper::paper_50(seed), None)).expect("JSON");
    let bodies: Vec<Vec<u8>> = (0..SCENES).map(body).collect();
    let file = StoreFile::new("throughput");
    println!("{:<34} {:>10} {:>10} {:>10} {:>7}", "jobs, submission to end", "per s", "median ms", "p99 ms", "MB");
    jobs::print_rate("SQLite in a file", &file.url(), &bodies);
    match std::env::var("TEST_POSTGRES_URL") {
        Ok(url) => jobs::print_rate("PostgreSQL", &url, &bodies),
        Err(_) => println!("PostgreSQL: TEST_POSTGRES_URL names none"),
    }
    let server = Server::start(&file.url(), &[]);
    let ratio = rates::print(server.address(), &bodies);
    println!("plans over /livez: {ratio:.3}; at least {LEAST}");
    if ratio >= LEAST { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
