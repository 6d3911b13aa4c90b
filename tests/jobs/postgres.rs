//! What only PostgreSQL has: servers that hear each other, and connections that break.

use std::sync::Arc;

use core::time::Duration;

use singulate::jobs::{End, NewJob};
use tokio::task::JoinSet;
use tokio::time::{Instant, sleep, timeout};

use crate::home::{Home, PATIENCE, at, claimed, execute, job, postgres_url, submitted};

#[tokio::test]
async fn a_change_wakes_waiters_on_another_server() {
    let Some(home) = Home::in_postgres().await else { return };
    let (here, there) = (home.store().await, home.store().await);
    let new = NewJob { callback_url: Some("https://example.org".to_owned()), ..job() };
    let watcher = there.hints().watch(new.id);
    let changed = watcher.changed();
    submitted(&here, new).await;
    timeout(PATIENCE, changed).await.expect("the change is heard");
    timeout(PATIENCE, there.hints().work.notified()).await.expect("there is work");
    let changed = watcher.changed();
    let claim = claimed(&here, 1).await.claim;
    timeout(PATIENCE, changed).await.expect("the change is heard");
    assert!(here.finish(claim, &End::Succeeded("{}".parse().unwrap()), at(2)).await.unwrap());
    timeout(PATIENCE, there.hints().callbacks.notified()).await.expect("a callback is due");
    drop((here, there));
    home.remove().await;
}

#[tokio::test]
async fn broken_connections_are_made_again() {
    let Some(home) = Home::in_postgres().await else { return };
    let (here, there) = (home.store().await, home.store().await);
    let id = submitted(&here, job()).await.id;
    let watcher = there.hints().watch(id);
    let changed = watcher.changed();
    let ours = format!(
        "SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE application_name = '{}'",
        home.schema.as_ref().unwrap()
    );
    execute(&postgres_url().unwrap(), &ours).await;
    let begin = Instant::now();
    while here.claim(&at(1).into()).await.is_err() {
        assert!(begin.elapsed() < PATIENCE);
        sleep(Duration::from_millis(20)).await;
    }
    timeout(PATIENCE, changed).await.expect("who may have missed something looks again");
    drop((here, there));
    home.remove().await;
}

#[tokio::test]
async fn tables_are_made_once_however_many_start_at_the_same_time() {
    let Some(home) = Home::in_postgres().await else { return };
    let mut starts = JoinSet::new();
    for _ in 0..4 {
        let settings = home.settings.clone();
        starts.spawn(async move {
            let store = singulate::jobs::open(&settings, Arc::default()).await.unwrap();
            submitted(&store, job()).await;
        });
    }
    starts.join_all().await;
    assert_eq!(home.store().await.counts().await.unwrap().queued, 4);
    home.remove().await;
}
