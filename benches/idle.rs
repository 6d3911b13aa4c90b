//! What 10,000 connections that rest cost: memory, and the time of a plan for somebody else meanwhile.
//!
//! The service is a process of its own, so that its memory is its own. Fails where it grows by more than 200 MB, where a
//! plan takes more than twice as long in the median as without them, or where one of them was not held. Linux only: reads
//! the memory from `/proc`.

mod cases;

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, ExitCode, Stdio};
use std::time::{Duration, Instant};

use rustix::process::{Resource, getrlimit, setrlimit};
use singulate::wire::SceneBody;

const CONNECTIONS: u64 = 10_000;
/// Files of this process, and of the service, that are none of them.
const OTHER_FILES: u64 = 200;
const MAX_GROWTH_KB: u64 = 200_000;
const MAX_RATIO: f64 = 2.0;
/// Plans in one median.
const PLANS: usize = 1000;
const LIVEZ: &str = "GET /livez HTTP/1.1\r\nhost: x\r\n\r\n";

fn main() -> ExitCode {
    let mut limit = getrlimit(Resource::Nofile);
    limit.current = limit.maximum;
    setrlimit(Resource::Nofile, limit).expect("the hard limit");
    let count = limit.maximum.map_or(CONNECTIONS, |files| files.saturating_sub(OTHER_FILES).min(CONNECTIONS));
    if count < CONNECTIONS {
        println!("the limit of open files allows only {count} connections");
    }
    let service = Service::start();
    let plan = plan();
    // What the first plans allocate is no cost of connections.
    service.median(&plan);
    let (memory, without) = (service.memory_kb(), service.median(&plan));
    let mut resting: Vec<_> = (0..count).map(|_| service.rested()).collect();
    let (growth, with) = (service.memory_kb().saturating_sub(memory), service.median(&plan));
    let held = resting.iter_mut().filter_map(|connection| ask(connection, LIVEZ)).count() as u64;
    let ratio = with.as_secs_f64() / without.as_secs_f64();
    let ms = |duration: Duration| duration.as_secs_f64() * 1e3;
    println!("{held} of {count} connections held; {:.1} kB each, {growth} kB in all", growth as f64 / count as f64);
    println!("a plan: {:.2} ms without them, {:.2} ms with them, {ratio:.2} times", ms(without), ms(with));
    println!("at most {MAX_GROWTH_KB} kB and {MAX_RATIO} times");
    if held == count && growth <= MAX_GROWTH_KB && ratio <= MAX_RATIO { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// The request for a plan of 50 dishes.
fn plan() -> String {
    let scene = cases::scene(cases::equal_density(50, 0));
    let body = serde_json::to_string(&SceneBody::new(&scene, None)).expect("JSON");
    let head = "POST /v1/plans HTTP/1.1\r\nhost: x\r\ncontent-type: application/json\r\ncontent-length: ";
    format!("{head}{}\r\n\r\n{body}", body.len())
}

/// Send a request; the status of its answer, `None` where the connection is closed.
fn ask(connection: &mut BufReader<TcpStream>, request: &str) -> Option<u16> {
    connection.get_mut().write_all(request.as_bytes()).ok()?;
    let mut head = String::new();
    while !head.ends_with("\r\n\r\n") {
        if connection.read_line(&mut head).ok()? == 0 {
            return None;
        }
    }
    let length = head.lines().find_map(|line| line.strip_prefix("content-length: "))?;
    let mut body = vec![0; length.parse().ok()?];
    connection.read_exact(&mut body).ok()?;
    head.split(' ').nth(1)?.parse().ok()
}

/// The service; it ends with the bench.
struct Service {
    child: Child,
    address: String,
}

impl Service {
    fn start() -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_singulate"));
        command.args(["serve", "--listen", "127.0.0.1:0", "--log", "warn"]);
        let mut child = command.stdin(Stdio::null()).stdout(Stdio::piped()).spawn().expect("a process");
        let mut line = String::new();
        let mut out = BufReader::new(child.stdout.take().expect("piped"));
        out.read_line(&mut line).expect("a greeting");
        let url = line.split_whitespace().find_map(|word| word.strip_prefix("http://")).expect("an address");
        Self { child, address: url.to_owned() }
    }

    fn connect(&self) -> BufReader<TcpStream> {
        // The default buffer would cost this process as much as a connection costs the service.
        BufReader::with_capacity(512, TcpStream::connect(&self.address).expect("accepted"))
    }

    /// A connection that rests after an answer. One that asks nothing at first is cut off after some seconds.
    fn rested(&self) -> BufReader<TcpStream> {
        let mut connection = self.connect();
        assert_eq!(ask(&mut connection, LIVEZ), Some(200));
        connection
    }

    /// The median time of a plan on one connection.
    fn median(&self, plan: &str) -> Duration {
        let mut connection = self.connect();
        let once = |_| {
            let started = Instant::now();
            assert_eq!(ask(&mut connection, plan), Some(200));
            started.elapsed()
        };
        let mut taken: Vec<Duration> = (0..PLANS).map(once).collect();
        taken.sort_unstable();
        taken[PLANS / 2]
    }

    /// Its resident memory.
    fn memory_kb(&self) -> u64 {
        let status = fs::read_to_string(format!("/proc/{}/status", self.child.id())).expect("Linux");
        let resident = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).expect("a figure");
        resident.trim().trim_end_matches(" kB").parse().expect("a number")
    }
}

impl Drop for Service {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
