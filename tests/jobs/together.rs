//! Several at once, through two ways into the same database.

use core::time::Duration;
use std::collections::HashSet;
use std::sync::Arc;

use singulate::jobs::{End, Job, JobId, JobState, NewJob, Store, SubmitError};
use tokio::task::JoinSet;
use tokio::time::sleep;

use crate::home::{Home, ann, at, claimed, job, jobs, keyed, seen, submitted};

async fn two(home: &Home) -> [Arc<dyn Store>; 2] {
    [home.store().await, home.store().await]
}

/// A busy machine may keep a store waiting for longer than it waits. It says so, and is asked again.
async fn submit(store: &Arc<dyn Store>, jobs: &[NewJob]) -> Result<Vec<Job>, SubmitError> {
    loop {
        match store.submit(jobs, at(0)).await {
            Err(SubmitError::Store(_)) => sleep(Duration::from_millis(50)).await,
            answer => return answer,
        }
    }
}

pub(crate) async fn one_key_at_once_gives_one_job(home: &Home) {
    let stores = two(home).await;
    let mut calls = JoinSet::new();
    for turn in 0..32 {
        let store = Arc::clone(&stores[turn % 2]);
        calls.spawn(async move { submit(&store, &[keyed("k", 0), keyed("k", 1)]).await.unwrap() });
    }
    let answers = calls.join_all().await;
    let ids: HashSet<Vec<JobId>> = answers.iter().map(|jobs| jobs.iter().map(|job| job.id).collect()).collect();
    assert_eq!((answers.len(), ids.len()), (32, 1));
    assert_eq!(stores[0].counts().await.unwrap().queued, 2);
}

pub(crate) async fn claims_at_once_get_each_job_once(home: &Home) {
    let stores = two(home).await;
    let all: HashSet<JobId> = stores[0].submit(&jobs::<200>(), at(0)).await.unwrap().iter().map(|job| job.id).collect();
    let mut calls = JoinSet::new();
    for turn in 0..16 {
        let store = Arc::clone(&stores[turn % 2]);
        calls.spawn(async move {
            let mut mine = Vec::new();
            // Nothing to claim may also mean that others are just claiming the last.
            while !matches!(store.counts().await, Ok(counts) if counts.queued == 0) {
                mine.extend(store.claim(&at(1).into()).await.ok().flatten().map(|work| work.claim.id));
            }
            mine
        });
    }
    let claims = calls.join_all().await.concat();
    assert_eq!(claims.len(), 200);
    assert_eq!(claims.into_iter().collect::<HashSet<JobId>>(), all);
}

pub(crate) async fn the_queue_is_never_overfilled(home: &Home) {
    let stores = two(home).await;
    stores[0].submit(&jobs::<990>(), at(0)).await.unwrap();
    let mut calls = JoinSet::new();
    for turn in 0..16 {
        let store = Arc::clone(&stores[turn % 2]);
        calls.spawn(async move { submit(&store, &jobs::<2>()).await });
    }
    let answers = calls.join_all().await;
    assert_eq!(answers.iter().filter(|answer| answer.is_ok()).count(), 5);
    assert_eq!(answers.iter().filter(|answer| **answer == Err(SubmitError::Full)).count(), 11);
}

pub(crate) async fn sweeps_at_once_share_the_work(home: &Home) {
    let stores = two(home).await;
    let many: Vec<NewJob> = (0..450).map(|_| job()).collect();
    stores[0].submit(&many, at(0)).await.unwrap();
    let mut calls = JoinSet::new();
    for turn in 0..4 {
        let store = Arc::clone(&stores[turn % 2]);
        calls.spawn(async move { store.sweep(at(1000)).await.unwrap().expired.len() });
    }
    let expired: usize = calls.join_all().await.into_iter().sum();
    // One that was left because somebody else was at it, and then was not: next time.
    assert_eq!(expired + stores[0].sweep(at(1000)).await.unwrap().expired.len(), 450);
}

pub(crate) async fn of_two_ends_at_once_one_counts(home: &Home) {
    let stores = two(home).await;
    for _ in 0..10 {
        let id = submitted(&stores[0], job()).await.id;
        let claim = claimed(&stores[0], 1).await.claim;
        let (sweeper, worker) = (Arc::clone(&stores[0]), Arc::clone(&stores[1]));
        let swept = tokio::spawn(async move { sweeper.sweep(at(101)).await.unwrap() });
        let finished = worker.finish(claim, &End::Succeeded("{}".parse().unwrap()), at(101)).await.unwrap();
        let requeued = swept.await.unwrap().requeued;
        assert_eq!(requeued.len(), usize::from(!finished));
        let state = seen(&stores[0], id).await.state;
        assert_eq!(state, if finished { JobState::Succeeded } else { JobState::Queued });
        stores[0].cancel(&ann(), id, at(102)).await.unwrap();
    }
}
