//! Callbacks, from the end of a job until they are over.

use core::time::Duration;
use std::sync::Arc;

use singulate::jobs::{Delivery, End, JobId, JobState, NewJob, Store};
use tokio::task::JoinSet;

use crate::home::{Home, ann, at, claimed, job, seen, submitted};

const LEASE: Duration = Duration::from_millis(50);

fn calling() -> NewJob {
    NewJob { callback_url: Some("https://example.org/told".to_owned()), ..job() }
}

async fn ended(store: &Arc<dyn Store>) -> JobId {
    let id = submitted(store, calling()).await.id;
    let claim = claimed(store, 5).await.claim;
    assert!(store.finish(claim, &End::Succeeded("{}".parse().unwrap()), at(10)).await.unwrap());
    id
}

/// Which try is due.
async fn taken(store: &Arc<dyn Store>, millis: i64) -> Option<u32> {
    store.take_callback(LEASE, &at(millis).into()).await.unwrap().map(|callback| callback.attempt)
}

pub(crate) async fn a_callback_is_due_at_the_end(home: &Home) {
    let store = home.store().await;
    let silent = submitted(&store, job()).await.id;
    store.cancel(&ann(), silent, at(1)).await.unwrap();
    let waiting = submitted(&store, calling()).await.id;
    let claim = claimed(&store, 9).await.claim;
    assert_eq!(claim.id, waiting);
    assert_eq!(store.take_callback(LEASE, &at(9).into()).await.unwrap(), None);
    assert!(store.finish(claim, &End::Succeeded("{}".parse().unwrap()), at(10)).await.unwrap());
    let callback = store.take_callback(LEASE, &at(10).into()).await.unwrap().unwrap();
    assert_eq!((callback.url.as_str(), callback.attempt), ("https://example.org/told", 1));
    assert_eq!(callback.job, seen(&store, waiting).await);
    assert_eq!(callback.job.result.as_deref(), Some("{}"));
}

pub(crate) async fn a_callback_is_tried_until_it_is_over(home: &Home) {
    let store = home.store().await;
    let id = ended(&store).await;
    // Its lease, then somebody else's turn; then again when it is wanted.
    for (millis, attempt) in [(10, Some(1)), (59, None), (60, Some(2))] {
        assert_eq!(taken(&store, millis).await, attempt);
    }
    store.settle_callback(id, 2, Delivery::Again(at(300))).await.unwrap();
    for (millis, attempt) in [(299, None), (300, Some(3))] {
        assert_eq!(taken(&store, millis).await, attempt);
    }
    store.settle_callback(id, 3, Delivery::Over).await.unwrap();
    assert_eq!(taken(&store, 900).await, None);
}

pub(crate) async fn an_older_try_has_no_say(home: &Home) {
    let store = home.store().await;
    let id = ended(&store).await;
    for (millis, attempt) in [(10, 1), (60, 2)] {
        assert_eq!(store.take_callback(LEASE, &at(millis).into()).await.unwrap().unwrap().attempt, attempt);
    }
    store.settle_callback(id, 1, Delivery::Over).await.unwrap();
    assert_eq!(store.take_callback(LEASE, &at(110).into()).await.unwrap().unwrap().attempt, 3);
    store.settle_callback(id, 3, Delivery::Over).await.unwrap();
    // What is over stays so, and what is forgotten is nobody's concern.
    store.settle_callback(id, 3, Delivery::Again(at(120))).await.unwrap();
    assert_eq!(store.take_callback(LEASE, &at(500).into()).await.unwrap(), None);
    let id = ended(&store).await;
    store.forget(&ann(), id).await.unwrap();
    store.settle_callback(id, 1, Delivery::Over).await.unwrap();
    assert_eq!(store.take_callback(LEASE, &at(500).into()).await.unwrap(), None);
}

pub(crate) async fn every_kind_of_end_is_called_back(home: &Home) {
    let store = home.store().await;
    let cancelled = submitted(&store, calling()).await.id;
    store.cancel(&ann(), cancelled, at(1)).await.unwrap();
    let failed = submitted(&store, calling()).await.id;
    let claim = claimed(&store, 2).await.claim;
    assert!(store.finish(claim, &End::Failed("{}".parse().unwrap()), at(2)).await.unwrap());
    let poisoned = submitted(&store, calling()).await.id;
    for millis in [100, 300, 500] {
        claimed(&store, millis).await;
        store.sweep(at(millis + 100)).await.unwrap();
    }
    let expired = submitted(&store, calling()).await.id;
    store.sweep(at(1000)).await.unwrap();
    let ends = [
        (cancelled, JobState::Cancelled),
        (failed, JobState::Failed),
        (poisoned, JobState::Failed),
        (expired, JobState::Expired),
    ];
    for (id, state) in ends {
        let callback = store.take_callback(LEASE, &at(1000).into()).await.unwrap().unwrap();
        assert_eq!((callback.job.id, callback.job.state, callback.attempt), (id, state, 1));
    }
    assert_eq!(store.take_callback(LEASE, &at(1000).into()).await.unwrap(), None);
}

pub(crate) async fn callbacks_at_once_are_taken_once(home: &Home) {
    let store = home.store().await;
    for _ in 0..10 {
        ended(&store).await;
    }
    let other = home.store().await;
    let mut calls = JoinSet::new();
    for turn in 0..8 {
        let store = Arc::clone(if turn % 2 == 0 { &store } else { &other });
        calls.spawn(async move {
            let mut taken = Vec::new();
            while let Some(callback) = store.take_callback(LEASE, &at(20).into()).await.unwrap() {
                taken.push(callback.job.id);
            }
            taken
        });
    }
    let mut taken = calls.join_all().await.concat();
    while let Some(callback) = store.take_callback(LEASE, &at(20).into()).await.unwrap() {
        taken.push(callback.job.id);
    }
    taken.sort_unstable();
    taken.dedup();
    assert_eq!(taken.len(), 10);
}
