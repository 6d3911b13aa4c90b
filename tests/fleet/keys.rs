//! One key, many clients, two servers.

use std::collections::HashSet;
use std::sync::Arc;

use tokio::sync::Barrier;
use tokio::task::JoinSet;

use crate::LEASE;
use crate::client::{Client, id};
use crate::database::Database;
use crate::scenes::short;
use crate::server::Server;

const CLIENTS: usize = 32;
/// Each race is run again with another key: one may be won by luck.
const ROUNDS: usize = 5;

#[tokio::test(flavor = "multi_thread")]
async fn one_key_is_one_job_for_two_processes_on_one_file() {
    let database = Database::in_a_file();
    one_key_is_one_job(&database).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn one_key_is_one_job_for_two_servers_on_one_postgresql() {
    let Some(database) = Database::in_postgres().await else { return };
    one_key_is_one_job(&database).await;
    database.remove().await;
}

async fn one_key_is_one_job(database: &Database) {
    let servers = [Server::start(&database.url, &LEASE), Server::start(&database.url, &LEASE)];
    let urls = servers.each_ref().map(|server| server.url.clone());
    let mut jobs = HashSet::new();
    for round in 0..ROUNDS {
        let request = Arc::new(short(format!("key-{round}"), 0));
        let together = Arc::new(Barrier::new(CLIENTS));
        let mut clients = JoinSet::new();
        for number in 0..CLIENTS {
            let client = Client::of(&[&urls[number % 2]]);
            let (request, together) = (Arc::clone(&request), Arc::clone(&together));
            clients.spawn(async move {
                // Connected before, so that nobody is late.
                client.try_get("/livez").await.unwrap();
                together.wait().await;
                let reply = client.try_submit(&request).await.unwrap();
                assert_eq!(reply.status, 202, "{reply:?}");
                id(&reply.json())
            });
        }
        let ids: HashSet<String> = clients.join_all().await.into_iter().collect();
        assert_eq!(ids.len(), 1, "one job for all: {ids:?}");
        jobs.extend(ids);
    }
    assert_eq!(jobs.len(), ROUNDS);
    for url in &urls {
        assert_eq!(Client::of(&[url]).list(None).await.into_iter().collect::<HashSet<_>>(), jobs);
    }
}
