//! Workers that renew, are lost, come back too late or give up.

use std::sync::Arc;

use singulate::jobs::{Claim, End, EventKind, JobState, MAX_ATTEMPTS, Renewal, Store, Swept};
use singulate_planner::cost::Cost;
use singulate_planner::search::Incumbent;

use crate::home::{Home, ann, at, claimed, job, seen, submitted};

fn answer() -> End {
    End::Succeeded("{}".parse().unwrap())
}

pub(crate) async fn a_worker_that_renews_keeps_its_job(home: &Home) {
    let store = home.store().await;
    let id = submitted(&store, job()).await.id;
    let claim = claimed(&store, 0).await.claim;
    assert_eq!(store.sweep(at(99)).await.unwrap(), Swept::default());
    assert_eq!(store.renew(claim, &at(99).into()).await.unwrap(), Renewal::Held);
    assert_eq!(store.sweep(at(198)).await.unwrap(), Swept::default());
    assert_eq!(seen(&store, id).await.state, JobState::Running);
    assert_eq!(store.sweep(at(199)).await.unwrap(), Swept { requeued: vec![id], ..Swept::default() });
    let queued = seen(&store, id).await;
    assert_eq!((queued.state, queued.attempts, queued.queue_position), (JobState::Queued, 1, Some(1)));
    assert_eq!(queued.started_at, Some(at(0)));
    assert_eq!(queued.events.last().unwrap().kind, EventKind::Queued);
}

/// Whatever this claim's worker says, nothing changes.
async fn is_lost(store: &Arc<dyn Store>, claim: Claim, millis: i64) {
    let before = seen(store, claim.id).await;
    assert_eq!(store.renew(claim, &at(millis).into()).await.unwrap(), Renewal::Lost);
    assert!(!store.note(claim, Incumbent { cost: Cost::new(1), lower_bound: Cost::new(1) }, at(millis)).await.unwrap());
    assert!(!store.finish(claim, &answer(), at(millis)).await.unwrap());
    assert!(!store.hand_back(claim, at(millis)).await.unwrap());
    assert_eq!(seen(store, claim.id).await, before);
}

pub(crate) async fn a_lost_worker_has_no_say_any_more(home: &Home) {
    let store = home.store().await;
    submitted(&store, job()).await;
    let lost = claimed(&store, 0).await.claim;
    store.sweep(at(100)).await.unwrap();
    is_lost(&store, lost, 101).await;
    let next = claimed(&store, 102).await.claim;
    is_lost(&store, lost, 103).await;
    assert!(store.finish(next, &answer(), at(104)).await.unwrap());
    is_lost(&store, lost, 105).await;
}

pub(crate) async fn an_end_is_kept_once_and_may_be_told_twice(home: &Home) {
    let store = home.store().await;
    let id = submitted(&store, job()).await.id;
    let claim = claimed(&store, 0).await.claim;
    // Late, but nobody has noticed.
    assert!(store.finish(claim, &answer(), at(150)).await.unwrap());
    let ended = seen(&store, id).await;
    assert!(store.finish(claim, &answer(), at(160)).await.unwrap());
    assert_eq!(seen(&store, id).await, ended);
    assert_eq!(store.renew(claim, &at(161).into()).await.unwrap(), Renewal::Lost);
    assert!(!store.hand_back(claim, at(161)).await.unwrap());
    assert!(!store.note(claim, Incumbent { cost: Cost::new(1), lower_bound: Cost::new(1) }, at(161)).await.unwrap());
    assert_eq!(seen(&store, id).await, ended);
}

pub(crate) async fn a_job_that_is_handed_back_was_never_claimed(home: &Home) {
    let store = home.store().await;
    let first = submitted(&store, job()).await;
    submitted(&store, job()).await;
    for round in 0..5 {
        let work = claimed(&store, round).await;
        assert_eq!((work.claim.id, work.attempt), (first.id, 1));
        assert!(store.hand_back(work.claim, at(round)).await.unwrap());
        assert!(!store.hand_back(work.claim, at(round)).await.unwrap());
        let back = seen(&store, first.id).await;
        assert_eq!((back.state, back.attempts, back.started_at), (JobState::Queued, 0, None));
        assert_eq!((back.queue_position, back.expires_at), (Some(1), first.expires_at));
    }
}

pub(crate) async fn a_cancelled_job_that_is_handed_back_is_cancelled(home: &Home) {
    let store = home.store().await;
    let id = submitted(&store, job()).await.id;
    let claim = claimed(&store, 0).await.claim;
    store.cancel(&ann(), id, at(1)).await.unwrap();
    assert!(store.hand_back(claim, at(2)).await.unwrap());
    let ended = seen(&store, id).await;
    assert_eq!((ended.state, ended.finished_at, ended.result), (JobState::Cancelled, Some(at(2)), None));
}

pub(crate) async fn the_third_lost_worker_ends_a_job(home: &Home) {
    let store = home.store().await;
    let id = submitted(&store, job()).await.id;
    let mut claim = None;
    for attempt in 1..=MAX_ATTEMPTS {
        let begin = i64::from(attempt) * 200;
        let work = claimed(&store, begin).await;
        assert_eq!(work.attempt, attempt);
        claim = Some(work.claim);
        let swept = store.sweep(at(begin + 100)).await.unwrap();
        let (requeued, poisoned) = if attempt < MAX_ATTEMPTS { (vec![id], Vec::new()) } else { (Vec::new(), vec![id]) };
        assert_eq!(swept, Swept { requeued, poisoned, ..Swept::default() });
    }
    assert_eq!(store.claim(&at(710).into()).await.unwrap(), None);
    let failed = seen(&store, id).await;
    assert_eq!((failed.state, failed.attempts, failed.finished_at), (JobState::Failed, 3, Some(at(700))));
    let problem: serde_json::Value = serde_json::from_str(failed.problem.as_deref().unwrap()).unwrap();
    assert_eq!((&problem["type"], &problem["status"]), (&"urn:singulate:problem:poison".into(), &500.into()));
    assert!(!store.finish(claim.unwrap(), &answer(), at(720)).await.unwrap());
    assert_eq!(seen(&store, id).await, failed);
}

pub(crate) async fn a_cancelled_job_ends_with_its_worker(home: &Home) {
    let store = home.store().await;
    let id = submitted(&store, job()).await.id;
    claimed(&store, 0).await;
    store.cancel(&ann(), id, at(1)).await.unwrap();
    assert_eq!(store.sweep(at(100)).await.unwrap(), Swept { cancelled: vec![id], ..Swept::default() });
    let ended = seen(&store, id).await;
    assert_eq!((ended.state, ended.finished_at, ended.attempts), (JobState::Cancelled, Some(at(100)), 1));
}

pub(crate) async fn a_fence_grows_with_each_claim(home: &Home) {
    let store = home.store().await;
    submitted(&store, job()).await;
    let mut last = i64::MIN;
    for round in 0..4 {
        let claim = claimed(&store, round).await.claim;
        assert!(claim.fence > last);
        last = claim.fence;
        assert!(store.hand_back(claim, at(round)).await.unwrap());
    }
}
