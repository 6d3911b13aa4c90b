//! Ten times what a server can take, for half a minute: it says no to what is too much, in time, and keeps its word to the
//! rest.
//!
//! A real server with one thread for plans and one for jobs. First some clients find out what it gets done; then a
//! generator of load sends ten times that, whatever comes back. It shares the machine with the server, so what counts is
//! what it has sent. Fails where a bound is broken.

mod capacity;
#[path = "../cases/client.rs"]
mod client;
mod ends;
mod generator;
mod memory;
mod mix;
#[path = "../cases/paper.rs"]
mod paper;
#[path = "../cases/server.rs"]
mod server;
#[path = "../cases/store_file.rs"]
mod store_file;
mod tally;
#[path = "../cases/timer.rs"]
mod timer;

use std::process::ExitCode;
use std::rc::Rc;
use std::time::Duration;

use capacity::Capacity;
use memory::{Memory, Resident};
use mix::Mix;
use server::Server;
use store_file::StoreFile;
use tally::{Kind, Tally};
use timer::{Timer, p99};

const LOAD: Duration = Duration::from_secs(30);
const TIMES: f64 = 10.0;
/// A little more is tried for, so that ten times is reached.
const TRIED: f64 = 10.5;
const GRACE: Duration = Duration::from_millis(50);
/// Of the memory in the first seconds.
const GROWTH: f64 = 1.2;
/// A queue that fills within the first seconds and is worked off soon after the last.
const SETTINGS: [&str; 6] = ["--threads", "1", "--job-threads", "1", "--max-queued-jobs", "300"];

fn main() -> ExitCode {
    let file = StoreFile::new("overload");
    let server = Server::start(&file.url(), &SETTINGS);
    let mix = Rc::new(Mix::new());
    let capacity = capacity::measure(server.address(), &mix);
    let tried = Capacity { plans: TRIED * capacity.plans, jobs: TRIED * capacity.jobs };
    let (timer, memory) = (Timer::start(), Memory::watch(server.process()));
    let mut tally = generator::offer(server.address(), &mix, &tried, LOAD);
    let (allowance, resident) = (GRACE + timer.p99(), memory.stop());
    let lost = ends::lost(server.address(), &tally.accepted);
    tally.lateness.sort_unstable();
    print(&capacity, &tally, &resident);
    let bounds = bounds(&capacity, &tally, &resident, allowance, lost);
    bounds.iter().for_each(|(holds, text)| println!("{} {text}", if *holds { "ok    " } else { "BROKEN" }));
    if bounds.iter().all(|(holds, _)| *holds) { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn print(capacity: &Capacity, tally: &Tally, resident: &Resident) {
    println!(
        "{:<8} {:>10} {:>10} {:>6} {:>8} {:>9} {:>9}",
        "", "capacity/s", "offered/s", "times", "sent", "accepted", "refused"
    );
    for (name, capacity, kind) in [("plans", capacity.plans, &tally.plans), ("jobs", capacity.jobs, &tally.jobs)] {
        let Kind { sent, accepted, refused, .. } = kind;
        let (offered, times) = (offered(kind, tally), offered(kind, tally) / capacity);
        println!("{name:<8} {capacity:>10.0} {offered:>10.0} {times:>6.1} {sent:>8} {accepted:>9} {refused:>9}");
    }
    println!("not sent for want of a free connection: {}", tally.unsent);
    let mb = |size: u64| size / 1024;
    println!(
        "resident memory: first {} MB, last {} MB, peak {} MB",
        mb(resident.first),
        mb(resident.last),
        mb(resident.peak)
    );
    tally.faults.iter().for_each(|(fault, count)| println!("{count} times: {fault}"));
}

/// Sent per second.
fn offered(kind: &Kind, tally: &Tally) -> f64 {
    number(kind.sent) / tally.sending.as_secs_f64()
}

/// What has to hold, and whether it does.
fn bounds(
    capacity: &Capacity,
    tally: &Tally,
    resident: &Resident,
    allowance: Duration,
    lost: usize,
) -> [(bool, String); 6] {
    let times = (offered(&tally.plans, tally) / capacity.plans).min(offered(&tally.jobs, tally) / capacity.jobs);
    let growth = resident.last as f64 / resident.first as f64;
    let faults: usize = tally.faults.values().sum();
    let (late, ms) = (p99(&tally.lateness), |time: Duration| time.as_secs_f64() * 1e3);
    let (accepted, unanswered) = (tally.plans.accepted > 0 && tally.jobs.accepted > 0, tally.unanswered());
    [
        (times >= TIMES, format!("{times:.1} times the capacity was sent; at least {TIMES}")),
        (growth <= GROWTH, format!("the memory grew to {growth:.2} of what it was; at most {GROWTH}")),
        (faults == 0, format!("{faults} answers were neither what was asked for nor 429 or 503 with Retry-After")),
        (accepted && unanswered == 0, format!("{unanswered} requests without an answer, some of each kind accepted")),
        (lost == 0, format!("{lost} of {} accepted jobs did not succeed", tally.accepted.len())),
        (
            late <= allowance,
            format!(
                "p99 of accepted plans {:.1} ms after their time limit, the last {:.1} ms; at most {:.1} ms",
                ms(late),
                ms(tally.lateness.last().copied().unwrap_or_default()),
                ms(allowance)
            ),
        ),
    ]
}

fn number(count: usize) -> f64 {
    f64::from(u32::try_from(count).expect("few"))
}
