//! One server that is killed, and started again on the same file.

use std::sync::Arc;

use serde_json::Value;

use crate::LEASE;
use crate::client::Client;
use crate::database::Database;
use crate::ends::{Loss, are_all_and_end};
use crate::load::{Accepted, Load, running};
use crate::scenes::{short, thousand};
use crate::server::Server;

/// So many results are compared across each crash: enough to find what is lost, few enough not to wait for them.
const COMPARED: usize = 50;

#[tokio::test(flavor = "multi_thread")]
async fn a_thousand_jobs_outlive_three_kills() {
    let database = Database::in_a_file();
    let mut server = Server::start(&database.url, &LEASE);
    let client = Arc::new(Client::of(&[&server.url]));
    let load = Load::begin(&client, thousand(0));
    let (mut losses, mut holders) = (Vec::new(), Vec::<Accepted>::new());
    for round in 1..=3 {
        load.reaches(250 * round).await;
        holders.extend(running(&client, &[&format!("holder-{round}")], 60_000).await);
        let finished = finished(&client).await;
        losses.push(Loss::by(|| server.kill()));
        server = Server::start(&database.url, &LEASE);
        client.servers_are(&[&server.url]);
        for job in &finished {
            assert_eq!(client.job(job["id"].as_str().unwrap()).await, *job);
        }
        let holder = &holders[round - 1].1;
        client.job_when(holder, |job| job["attempts"] == 2).await;
        client.cancel(holder).await;
    }
    let thousand = load.accepted().await;
    assert_eq!(thousand.len(), 1000);
    are_all_and_end(&client, &[(&thousand, &["succeeded"]), (&holders, &["cancelled", "succeeded"])], &losses).await;
}

/// Some jobs that have succeeded.
async fn finished(client: &Client) -> Vec<Value> {
    let mut jobs = Vec::new();
    for id in client.list(Some("succeeded")).await.iter().take(COMPARED) {
        jobs.push(client.job(id).await);
    }
    jobs
}

#[tokio::test(flavor = "multi_thread")]
async fn a_job_that_goes_down_with_three_servers_is_not_begun_again() {
    let database = Database::in_a_file();
    let mut server = Server::start(&database.url, &LEASE);
    let client = Client::of(&[&server.url]);
    let holder = running(&client, &["poison"], 60_000).await.remove(0).1;
    for attempt in 1..=3 {
        client.job_when(&holder, |job| job["attempts"] == attempt && job["state"] == "running").await;
        server.kill();
        server = Server::start(&database.url, &LEASE);
        client.servers_are(&[&server.url]);
    }
    let job = client.job_when(&holder, |job| !job["finished_at"].is_null()).await;
    assert_eq!((&job["state"], &job["attempts"]), (&"failed".into(), &3.into()), "{job}");
    assert_eq!(job["problem"]["type"], "urn:singulate:problem:poison", "{job}");
    let events: Vec<String> = client.follow(&holder).await.into_iter().map(|event| event.name).collect();
    let told: Vec<&str> = events.iter().map(String::as_str).filter(|name| *name != "incumbent").collect();
    assert_eq!(told, ["queued", "running", "queued", "running", "queued", "running", "finished"]);
    // Its server is none the worse for it.
    let after = short("after".to_owned(), 0);
    let after = client.submit(&after).await;
    let after = client.job_when(after["id"].as_str().unwrap(), |job| !job["finished_at"].is_null()).await;
    assert_eq!(after["state"], "succeeded");
}
