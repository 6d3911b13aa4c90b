//! Jobs from their submission to their end.

use std::net::SocketAddr;
use std::thread;
use std::time::{Duration, Instant};

use super::client::{Client, get, post};
use super::server::{Server, resident};

const CLIENTS: usize = 8;
const WINDOW: Duration = Duration::from_secs(8);

/// The rate of a server of its own on this store, and how long a job takes.
pub(super) fn print_rate(name: &str, url: &str, bodies: &[Vec<u8>]) {
    let server = Server::start(url, &[]);
    let requests: Vec<Vec<u8>> = bodies.iter().map(|body| post("/v1/jobs", body)).collect();
    let (requests, address, started) = (&requests[..], server.address(), Instant::now());
    let mut taken: Vec<Duration> = thread::scope(|scope| {
        let client = |at| scope.spawn(move || run(address, requests.iter().cycle().skip(at), started + WINDOW));
        let clients: Vec<_> = (0..CLIENTS).map(client).collect();
        clients.into_iter().flat_map(|client| client.join().expect("its jobs end")).collect()
    });
    let elapsed = started.elapsed();
    taken.sort_unstable();
    let rate = f64::from(u32::try_from(taken.len()).expect("few")) / elapsed.as_secs_f64();
    let ms = |percent: usize| taken[(taken.len() - 1) * percent / 100].as_secs_f64() * 1e3;
    let size = resident(server.process()) / 1024;
    println!("{name:<34} {rate:>10.0} {:>10.1} {:>10.1} {size:>7}", ms(50), ms(99));
}

/// One client: a job at a time, each waited for.
fn run<'a>(address: SocketAddr, requests: impl Iterator<Item = &'a Vec<u8>>, until: Instant) -> Vec<Duration> {
    let (mut client, mut taken) = (Client::connect(address), Vec::new());
    for request in requests {
        let started = Instant::now();
        if started >= until {
            break;
        }
        let accepted = client.ask(request);
        assert_eq!(accepted.status, 202, "{}", String::from_utf8_lossy(&accepted.body));
        let wait = get(&format!("{}?wait_ms=60000", accepted.header("location").expect("the job's place")));
        let ended = String::from_utf8(client.ask(&wait).body).expect("JSON");
        assert!(ended.contains(r#""state":"succeeded""#), "{ended}");
        taken.push(started.elapsed());
    }
    taken
}
