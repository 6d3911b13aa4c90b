//! Two servers on one PostgreSQL, of which one is killed.

use std::sync::Arc;

use tokio::time::{Instant, sleep};

use crate::client::{Client, id};
use crate::database::Database;
use crate::ends::{Loss, are_all_and_end};
use crate::load::{Accepted, Load, running};
use crate::scenes::{long, thousand};
use crate::server::Server;
use crate::{LEASE, LOOK_AGAIN, PATIENCE};

#[tokio::test(flavor = "multi_thread")]
async fn a_thousand_jobs_outlive_one_of_two_servers() {
    let Some(database) = Database::in_postgres().await else { return };
    let (mut here, there) = (Server::start(&database.url, &LEASE), Server::start(&database.url, &LEASE));
    let client = Arc::new(Client::of(&[&here.url, &there.url]));
    let load = Load::begin(&client, thousand(1));
    load.reaches(200).await;
    let answered = any_server_answers(&here.url, &there.url).await;
    load.reaches(400).await;
    // One thread is left for the load, and each server has one of these.
    let holders = running(&client, &["holder-1", "holder-2", "holder-3"], 60_000).await;
    let follow = |(_, id): &Accepted| {
        let (client, id) = (Arc::clone(&client), id.clone());
        tokio::spawn(async move { client.follow(&id).await })
    };
    let streams: Vec<_> = holders.iter().map(follow).collect();
    let loss = Loss::by(|| here.kill());
    let again = waiting_again(&client, &holders).await;
    for (_, id) in holders.iter().filter(|(_, id)| *id != again) {
        client.cancel(id).await;
    }
    client.job_when(&again, |job| job["attempts"] == 2).await;
    client.cancel(&again).await;
    for stream in streams {
        // Each stream goes on at the other server.
        let events = stream.await.unwrap();
        assert_eq!(events.iter().filter(|event| event.name == "finished").count(), 1, "{events:?}");
    }
    let mut succeeded = load.accepted().await;
    succeeded.push(answered);
    assert_eq!(succeeded.len(), 1000);
    client.servers_are(&[&there.url]);
    are_all_and_end(&client, &[(&succeeded, &["succeeded"]), (&holders, &["cancelled", "succeeded"])], &[loss]).await;
    drop((here, there));
    database.remove().await;
}

/// Whichever accepted the job and whichever runs it: both tell the same of it, then and later.
async fn any_server_answers(here: &str, there: &str) -> Accepted {
    let (here, there) = (Client::of(&[here]), Client::of(&[there]));
    let request = long("asked-everywhere".to_owned(), 500);
    let job = id(&here.submit(&request).await);
    let (by_one, by_other) = tokio::join!(here.follow(&job), there.follow(&job));
    assert_eq!(by_one, by_other);
    assert_eq!(here.job(&job).await, there.job(&job).await);
    assert_eq!(id(&there.submit(&request).await), job);
    (request, job)
}

/// One of these jobs that lost its server.
async fn waiting_again(client: &Client, jobs: &[Accepted]) -> String {
    let begin = Instant::now();
    loop {
        for (_, id) in jobs {
            let job = client.job(id).await;
            if job["state"] == "queued" || job["attempts"] == 2 {
                return id.clone();
            }
        }
        assert!(begin.elapsed() < PATIENCE, "no job of the killed server is begun again");
        sleep(LOOK_AGAIN).await;
    }
}
