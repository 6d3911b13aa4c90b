//! Who is woken by what.

use singulate::jobs::{End, NewJob, Watcher};
use singulate_planner::cost::Cost;
use singulate_planner::search::Incumbent;
use tokio::sync::Notify;
use tokio::time::timeout;

use crate::home::{Home, PATIENCE, ann, at, job, submitted};

fn calling() -> NewJob {
    NewJob { callback_url: Some("https://example.org".to_owned()), ..job() }
}

/// What the call answers, and it wakes those who watch the job.
async fn waking<T, E: core::fmt::Debug>(watcher: &Watcher, call: impl Future<Output = Result<T, E>>) -> T {
    let changed = watcher.changed();
    let answer = call.await.unwrap();
    timeout(PATIENCE, changed).await.expect("the change is told");
    answer
}

async fn woken(notify: &Notify) {
    timeout(PATIENCE, notify.notified()).await.expect("somebody is woken");
}

pub(crate) async fn what_waits_for_a_worker_wakes_workers(home: &Home) {
    let store = home.store().await;
    let new = job();
    let watcher = store.hints().watch(new.id);
    waking(&watcher, store.submit(&[new], at(0))).await;
    woken(&store.hints().work).await;
    let work = waking(&watcher, store.claim(&at(1).into())).await.unwrap();
    assert!(waking(&watcher, store.hand_back(work.claim, at(2))).await);
    woken(&store.hints().work).await;
    waking(&watcher, store.claim(&at(3).into())).await.unwrap();
    waking(&watcher, store.sweep(at(103))).await;
    woken(&store.hints().work).await;
}

pub(crate) async fn a_change_wakes_who_waits_for_it(home: &Home) {
    let store = home.store().await;
    let id = submitted(&store, calling()).await.id;
    let watcher = store.hints().watch(id);
    let claim = waking(&watcher, store.claim(&at(1).into())).await.unwrap().claim;
    waking(&watcher, store.note(claim, Incumbent { cost: Cost::new(2), lower_bound: Cost::new(1) }, at(2))).await;
    waking(&watcher, store.cancel(&ann(), id, at(3))).await;
    waking(&watcher, store.finish(claim, &End::Succeeded("{}".parse().unwrap()), at(4))).await;
    woken(&store.hints().callbacks).await;
    waking(&watcher, store.forget(&ann(), id)).await;
    let late = submitted(&store, job()).await.id;
    let watcher = store.hints().watch(late);
    waking(&watcher, store.sweep(at(1000))).await;
    waking(&watcher, store.sweep(at(2000))).await;
}
