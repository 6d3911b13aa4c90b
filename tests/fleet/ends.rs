//! What must be true of jobs whatever happened to their servers.

use std::collections::HashSet;
use std::sync::Arc;
use std::time::SystemTime;

use serde_json::Value;
use tokio::task::JoinSet;

use crate::client::{Client, id};
use crate::events::Message;
use crate::load::Accepted;

/// As many jobs are looked at as clients handed them in.
const CLIENTS: usize = 8;

/// When a server, or the database, was taken away.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Loss {
    pub(crate) from: SystemTime,
    pub(crate) to: SystemTime,
}

impl Loss {
    pub(crate) fn by(work: impl FnOnce()) -> Self {
        let from = SystemTime::now();
        work();
        Self { from, to: SystemTime::now() }
    }
}

/// These are all the jobs there are, each one another, and all end in one of these states, each once.
pub(crate) async fn are_all_and_end(
    client: &Arc<Client>,
    groups: &[(&[Accepted], &'static [&'static str])],
    losses: &[Loss],
) {
    let mut looks = JoinSet::new();
    let mut ids = HashSet::new();
    for (accepted, states) in groups.iter().copied() {
        ids.extend(accepted.iter().map(|(_, id)| id.clone()));
        for part in accepted.chunks(accepted.len().div_ceil(CLIENTS)) {
            let (client, part, losses) = (Arc::clone(client), part.to_vec(), losses.to_vec());
            looks.spawn(async move {
                for accepted in &part {
                    ends_once(&client, accepted, states, &losses).await;
                }
            });
        }
    }
    looks.join_all().await;
    let kept: HashSet<String> = client.list(None).await.into_iter().collect();
    assert_eq!(ids.len(), groups.iter().map(|(accepted, _)| accepted.len()).sum::<usize>(), "no two keys, one job");
    assert_eq!(kept, ids, "no job that nobody knows");
}

async fn ends_once(client: &Client, (request, job_id): &Accepted, states: &[&str], losses: &[Loss]) {
    let events = client.follow(job_id).await;
    let job = client.job(job_id).await;
    let state = job["state"].as_str().unwrap();
    assert!(states.contains(&state) && job["scene_id"] == request.key, "{job}");
    if state == "succeeded" {
        assert_eq!(job["result"]["scene_id"], request.key, "{job}");
    }
    let seen: Vec<(&str, &str)> = events.iter().map(|event| (event.id.as_str(), event.name.as_str())).collect();
    let numbers: Vec<String> = (1..=events.len()).map(|number| number.to_string()).collect();
    assert_eq!(seen.iter().map(|(id, _)| *id).collect::<Vec<_>>(), numbers, "{seen:?}");
    assert_eq!(seen[0].1, "queued");
    assert_eq!(seen.iter().position(|(_, name)| *name == "finished"), Some(seen.len() - 1), "{seen:?}");
    assert_eq!(events[events.len() - 1].data, job);
    begun_again_after_losses(&job, &events, losses);
    assert_eq!(id(&client.submit(request).await), *job_id, "the key is known");
}

/// Between two attempts something was taken away; so most jobs have one.
fn begun_again_after_losses(job: &Value, events: &[Message], losses: &[Loss]) {
    let begun: Vec<SystemTime> =
        events.iter().filter(|event| event.name == "running").map(|event| time(&event.data["started_at"])).collect();
    assert_eq!(job["attempts"], begun.len(), "{job}");
    for pair in begun.windows(2) {
        let lost = losses.iter().any(|loss| pair[0] <= loss.to && loss.from <= pair[1]);
        assert!(lost, "nothing was lost when the job was begun again: {pair:?}, {losses:?}, {job}");
    }
}

pub(crate) fn time(value: &Value) -> SystemTime {
    humantime::parse_rfc3339(value.as_str().unwrap()).unwrap()
}
