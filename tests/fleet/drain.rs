//! A server that is asked to end.

use core::time::Duration;
use std::io::Read;
use std::net::TcpStream;
use std::sync::Arc;
use std::time::Instant;

use tokio::task::JoinHandle;
use tokio::time::sleep;

use crate::LEASE;
use crate::client::{Client, Reply, id};
use crate::database::Database;
use crate::events::Messages;
use crate::load::running;
use crate::scenes::short;
use crate::server::Server;

const DRAIN: Duration = Duration::from_secs(2);
/// What an end may take beyond the time for draining.
const LATE: Duration = Duration::from_secs(1);
const QUEUED: u64 = 10;

#[tokio::test(flavor = "multi_thread")]
async fn a_server_ends_in_time_and_the_next_goes_on_with_its_jobs() {
    let database = Database::in_a_file();
    let drain = DRAIN.as_millis().to_string();
    let mut server = Server::start(&database.url, &["--drain-ms", &drain, LEASE[0], LEASE[1]]);
    let client = Arc::new(Client::of(&[&server.url]));
    let held = running(&client, &["ends", "endless"], 60_000).await;
    let (ends, endless) = (&held[0].1, &held[1].1);
    let queued = queued(&client).await;
    let streams = [listener(&client, endless).await, listener(&client, &queued[0]).await];
    let waiter = waiter(&client, endless).await;
    let mut idle = TcpStream::connect(server.url.trim_start_matches("http://")).unwrap();

    let asked = Instant::now();
    server.terminate();
    for mut stream in streams {
        stream.until("draining").await;
        assert!(stream.next().await.unwrap().is_none(), "it ends");
    }
    let waited = waiter.await.unwrap();
    assert_eq!((waited.status, waited.json()["state"].as_str()), (200, Some("running")), "{waited:?}");
    let newcomer = Client::of(&[&server.url]);
    for reply in [newcomer.try_get("/readyz").await, newcomer.try_submit(&short("late".to_owned(), 0)).await] {
        let reply = reply.unwrap();
        assert!(reply.status == 503 && reply.retry_after.is_some(), "{reply:?}");
    }
    // Of the two that run, one still ends.
    newcomer.cancel(ends).await;
    let status = server.ended((DRAIN + LATE).saturating_sub(asked.elapsed())).expect("it ends in time");
    assert_eq!(status.code(), Some(0));
    assert_eq!(idle.read(&mut [0]).unwrap(), 0, "the idle connection is closed");

    let next = Server::start(&database.url, &LEASE);
    client.servers_are(&[&next.url]);
    let ended = client.job(ends).await;
    assert_eq!((&ended["state"], &ended["attempts"]), (&"cancelled".into(), &1.into()), "{ended}");
    assert!(ended["result"].is_object(), "the best so far is kept: {ended}");
    goes_on(&client, endless, &queued).await;
}

async fn queued(client: &Client) -> Vec<String> {
    let mut ids = Vec::new();
    for number in 0..QUEUED {
        ids.push(id(&client.submit(&short(format!("queued-{number}"), number)).await));
    }
    ids
}

/// A client that has heard of the job.
async fn listener(client: &Client, id: &str) -> Messages {
    let mut messages = client.listen(id, None).await.unwrap();
    messages.until("queued").await;
    messages
}

/// A client that waits for the end of the job.
async fn waiter(client: &Arc<Client>, id: &str) -> JoinHandle<Reply> {
    let (client, path) = (Arc::clone(client), format!("/v1/jobs/{id}?wait_ms=60000"));
    let waiter = tokio::spawn(async move { client.try_get(&path).await.unwrap() });
    // Time to arrive; who comes later is answered just so.
    sleep(Duration::from_millis(200)).await;
    assert!(!waiter.is_finished());
    waiter
}

/// What had waited is done, and what had been handed back is begun as if for the first time.
async fn goes_on(client: &Client, handed_back: &str, queued: &[String]) {
    client.job_when(handed_back, |job| job["state"] == "running").await;
    client.cancel(handed_back).await;
    let events = client.follow(handed_back).await;
    let told: Vec<(&str, u64)> = events
        .iter()
        .filter(|event| event.name != "incumbent")
        .map(|event| (event.name.as_str(), event.data["attempts"].as_u64().unwrap()))
        .collect();
    let twice = [("queued", 0), ("running", 1), ("queued", 0), ("running", 1), ("finished", 1)];
    assert_eq!(told, twice);
    for id in queued {
        let job = client.job_when(id, |job| !job["finished_at"].is_null()).await;
        assert_eq!((&job["state"], &job["attempts"]), (&"succeeded".into(), &1.into()), "{job}");
        let names: Vec<String> = client.follow(id).await.into_iter().map(|event| event.name).collect();
        assert_eq!(names.iter().filter(|name| *name == "queued").count(), 1, "it waited all the while: {names:?}");
    }
}
