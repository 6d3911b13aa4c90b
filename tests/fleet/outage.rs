//! A database that goes away and comes back.

use core::time::Duration;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::Arc;
use std::time::{Instant, SystemTime};

use tokio::time::sleep;

use crate::client::Client;
use crate::database::{Database, variable};
use crate::ends::{Loss, are_all_and_end, time};
use crate::load::{Load, running};
use crate::scenes::{short, thousand};
use crate::server::Server;
use crate::{LOOK_AGAIN, PATIENCE};

/// How long the jobs run that the database misses the end of.
const RUN: Duration = Duration::from_secs(4);
/// Much longer than the database is away: a worker that has a job then keeps it.
const LEASE: Duration = Duration::from_secs(20);

/// A database that is away until its command hears no more, or the test has failed.
struct Away {
    command: Child,
    input: Option<ChildStdin>,
    from: SystemTime,
}

impl Away {
    fn begin(command: &str) -> Self {
        let from = SystemTime::now();
        let mut command = Command::new("bash").args(["-c", command]).stdin(Stdio::piped()).spawn().unwrap();
        let input = command.stdin.take();
        Self { command, input, from }
    }

    fn end(mut self) -> Loss {
        self.input.take();
        assert!(self.command.wait().unwrap().success(), "the database is there again");
        Loss { from: self.from, to: SystemTime::now() }
    }
}

impl Drop for Away {
    fn drop(&mut self) {
        self.input.take();
        // Its status counts where the test goes on.
        let _ = self.command.wait();
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_thousand_jobs_outlive_a_restart_of_their_database() {
    let Some(restart) = variable("TEST_POSTGRES_RESTART") else { return };
    let Some(database) = Database::in_postgres().await else { return };
    let flags = ["--job-lease-ms", &LEASE.as_millis().to_string()];
    let servers = [Server::start(&database.url, &flags), Server::start(&database.url, &flags)];
    let urls = servers.each_ref().map(|server| server.url.as_str());
    let client = Arc::new(Client::of(&urls));
    let load = Load::begin(&client, thousand(2));
    load.reaches(300).await;
    let run = u64::try_from(RUN.as_millis()).unwrap();
    let holders = running(&client, &["holder-1", "holder-2"], run).await;
    let mut streams = Vec::new();
    for (_, id) in &holders {
        streams.push(client.listen(id, None).await.unwrap());
    }
    let (began, away) = (Instant::now(), Away::begin(&restart));
    for url in urls {
        refuses_work(&Client::of(&[url]), &holders[0].1).await;
    }
    // By then they have ended, and nobody can be told.
    sleep((RUN + Duration::from_millis(500)).saturating_sub(began.elapsed())).await;
    let loss = away.end();
    for url in urls {
        ready_is(&Client::of(&[url]), 200).await;
    }
    let back = began.elapsed();
    for stream in &mut streams {
        let job = stream.until("finished").await.data;
        assert!(time(&job["finished_at"]) >= loss.from, "it ended while the database was away: {job}");
        // A lease is renewed at a third of its length.
        if back < LEASE.mul_f64(0.6) {
            assert_eq!(job["attempts"], 1, "the end of the first attempt was kept: {job}");
        }
    }
    let mut jobs = load.accepted().await;
    jobs.extend(holders);
    assert_eq!(jobs.len(), 1000);
    are_all_and_end(&client, &[(&jobs, &["succeeded"])], &[loss]).await;
    drop(servers);
    database.remove().await;
}

/// While its database is away, a server is not ready, and says when to come again.
async fn refuses_work(client: &Client, id: &str) {
    ready_is(client, 503).await;
    let submitted = client.try_submit(&short("while-away".to_owned(), 0)).await.unwrap();
    assert_eq!(submitted.status, 503, "{submitted:?}");
    assert_eq!(submitted.json()["type"], "urn:singulate:problem:store_unavailable");
    assert!(submitted.retry_after.is_some_and(|seconds| seconds.parse::<u32>().is_ok()));
    let asked = client.try_get(&format!("/v1/jobs/{id}")).await.unwrap();
    assert_eq!(asked.status, 503, "{asked:?}");
    assert_eq!(client.try_get("/livez").await.unwrap().status, 200);
}

async fn ready_is(client: &Client, status: u16) {
    let begin = Instant::now();
    loop {
        let reply = client.try_get("/readyz").await.unwrap();
        if reply.status == status {
            assert_eq!(reply.retry_after.is_some(), status == 503, "{reply:?}");
            return;
        }
        assert!(begin.elapsed() < PATIENCE, "not {status} but {reply:?}");
        sleep(LOOK_AGAIN).await;
    }
}
