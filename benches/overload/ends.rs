//! What became of the jobs that were accepted.

use std::collections::HashSet;
use std::net::SocketAddr;
use std::thread;
use std::time::{Duration, Instant};

use serde_json::Value;

use super::client::{Client, get};

/// For the jobs that still wait when the load is over, a queue full of them.
const PATIENCE: Duration = Duration::from_secs(120);
const LOOK_AGAIN: Duration = Duration::from_millis(100);

/// How many of these jobs have not succeeded when none waits or runs any more.
pub(super) fn lost(address: SocketAddr, places: &[String]) -> usize {
    let (mut client, started) = (Client::connect(address), Instant::now());
    let mut busy = |state: &str| !page(&mut client, &format!("?state={state}&limit=1")).0.is_empty();
    while (busy("queued") || busy("running")) && started.elapsed() < PATIENCE {
        thread::sleep(LOOK_AGAIN);
    }
    let succeeded = succeeded(&mut client);
    places.iter().filter(|place| !succeeded.contains(place.trim_start_matches("/v1/jobs/"))).count()
}

fn succeeded(client: &mut Client) -> HashSet<String> {
    let mut all = HashSet::new();
    let mut cursor = String::new();
    loop {
        let (ids, next) = page(client, &format!("?state=succeeded&limit=100{cursor}"));
        all.extend(ids);
        let Some(next) = next else { return all };
        cursor = format!("&cursor={next}");
    }
}

/// The ids of a page, and where the next one begins.
fn page(client: &mut Client, query: &str) -> (Vec<String>, Option<String>) {
    let reply = client.ask(&get(&format!("/v1/jobs{query}")));
    let page: Value = serde_json::from_slice(&reply.body).expect("JSON");
    let text = |value: &Value| value.as_str().map(str::to_owned);
    let ids = page["jobs"].as_array().expect("a list").iter().filter_map(|job| text(&job["id"])).collect();
    (ids, text(&page["next_cursor"]))
}
