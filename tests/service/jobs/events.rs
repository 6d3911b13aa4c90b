//! Streams of events.

use serde_json::{Value, json};
use singulate::api::ServerSettings;
use singulate::jobs::JobSettings;

use super::{crowded, ended, path, submit};
use crate::host::{Host, PATIENCE, endless, scene};

/// Id, name and data of each event of a stream that has ended.
pub(crate) fn messages(text: &str) -> Vec<(String, String, Value)> {
    let field = |block: &str, name: &str| {
        let line = block.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(": "));
        line.unwrap_or_default().to_owned()
    };
    let blocks = text.split("\n\n").filter(|block| block.contains("event: "));
    let read =
        |block: &str| (field(block, "id"), field(block, "event"), serde_json::from_str(&field(block, "data")).unwrap());
    blocks.map(read).collect()
}

#[tokio::test]
async fn a_stream_tells_all_that_happens_to_a_job() {
    let host = Host::start().await;
    let job = submit(&host, &crowded()).await;
    let events = format!("{}/events", path(&job));
    let reply = host.get(&events).await;
    assert_eq!((reply.status, reply.header("content-type")), (200, "text/event-stream"));
    let told = messages(&reply.text);
    let names: Vec<&str> = told.iter().map(|(_, name, _)| name.as_str()).collect();
    assert_eq!((names[0], names[1], names[names.len() - 1]), ("queued", "running", "finished"), "{names:?}");
    assert!(names[2..names.len() - 1].iter().all(|name| *name == "incumbent") && names.len() > 3, "{names:?}");
    assert!(told.iter().enumerate().all(|(at, (id, _, _))| *id == (at + 1).to_string()));
    for (_, name, data) in &told {
        let state = match name.as_str() {
            "queued" => "queued",
            "finished" => "succeeded",
            _ => "running",
        };
        assert_eq!((&data["id"], &data["state"]), (&job["id"], &json!(state)));
        assert_eq!(data["result"].is_null(), name != "finished");
        assert_eq!(data["queue_position"], if name == "queued" { json!(1) } else { Value::Null });
        assert_eq!(data["incumbent"].is_null(), ["queued", "running"].contains(&name.as_str()), "{data}");
    }
    assert_eq!(told[told.len() - 1].2, host.get(&path(&job)).await.json());
    // A client that comes again goes on where it was.
    let from = |id: &str| host.client.get(host.url(&events)).header("last-event-id", id).send();
    let rest = from("2").await.unwrap().text().await.unwrap();
    assert_eq!(messages(&rest), told[2..]);
    assert_eq!(from(&told.len().to_string()).await.unwrap().status(), 204);
    assert_eq!(messages(&from("what?").await.unwrap().text().await.unwrap()), told);
}

#[tokio::test]
async fn a_stream_ends_with_an_event_when_the_service_does() {
    let jobs = JobSettings { threads: 1, ..JobSettings::default() };
    let host = Host::with(ServerSettings { jobs, ..ServerSettings::default() }, endless()).await;
    let holder = submit(&host, &scene(60_000)).await;
    let waiting = submit(&host, &scene(60_000)).await;
    let stream = host.client.get(host.url(&format!("{}/events", path(&waiting)))).send().await.unwrap();
    let waiter = host.client.get(host.url(&format!("{}?wait_ms=60000", path(&waiting)))).send();
    let waiter = tokio::spawn(waiter);
    host.post(&format!("{}/cancel", path(&holder)), &Value::Null).await;
    host.ask_to_stop();
    let text = stream.text().await.unwrap();
    let last = text.split("\n\n").filter(|block| block.contains("event: ")).last().unwrap();
    assert!(last.contains("event: draining"), "{text}");
    // It is told how the job stands, or that nobody is there any more.
    if let Ok(reply) = waiter.await.unwrap() {
        assert_eq!(reply.status(), 200);
    }
    host.stopped().await;
}

#[tokio::test]
async fn there_are_only_so_many_streams_and_waits() {
    let settings = ServerSettings { max_streams: 1, max_waiting: 1, ..ServerSettings::default() };
    let host = Host::with(
        ServerSettings { jobs: JobSettings { threads: 1, ..JobSettings::default() }, ..settings },
        endless(),
    )
    .await;
    let job = submit(&host, &scene(60_000)).await;
    let events = format!("{}/events", path(&job));
    let stream = host.client.get(host.url(&events)).send().await.unwrap();
    let reply = host.get(&events).await;
    reply.is_problem(503, "overloaded");
    assert_eq!(reply.header("retry-after"), "1");
    let (url, client) = (host.url(&format!("{}?wait_ms=60000", path(&job))), host.client.clone());
    // It may come while the other has the only place.
    let waiter = tokio::spawn(async move {
        loop {
            let reply = client.get(&url).send().await.unwrap();
            if reply.status() != 503 {
                return reply;
            }
        }
    });
    let started = std::time::Instant::now();
    while host.get(&format!("{}?wait_ms=1", path(&job))).await.status != 503 {
        assert!(started.elapsed() < PATIENCE);
    }
    host.post(&format!("{}/cancel", path(&job)), &Value::Null).await;
    assert_eq!(waiter.await.unwrap().status(), 200);
    assert!(stream.text().await.unwrap().contains("event: finished"));
    ended(&host, &job).await;
    assert_eq!(host.get(&events).await.status, 200);
}
