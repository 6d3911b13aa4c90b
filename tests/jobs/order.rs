//! Who goes first, and where one stands.

use std::sync::Arc;

use singulate::jobs::{JobId, JobState, NewJob, Owner, Page, Store};

use crate::home::{Home, ann, at, bob, claimed, job, submitted};

/// Everything that waits, in the order in which it is claimed.
async fn claims(store: &Arc<dyn Store>) -> Vec<JobId> {
    let mut ids = Vec::new();
    while let Some(work) = store.claim(&at(1).into()).await.unwrap() {
        ids.push(work.claim.id);
    }
    ids
}

async fn of(store: &Arc<dyn Store>, owner: Owner, priority: i64) -> JobId {
    submitted(store, NewJob { owner, priority, ..job() }).await.id
}

pub(crate) async fn priorities_go_first_and_then_the_earliest(home: &Home) {
    let store = home.store().await;
    let mut expected = Vec::new();
    for priority in [0, 5, -7, 5, i64::MAX, 0, i64::MIN] {
        expected.push((priority, of(&store, ann(), priority).await));
    }
    expected.sort_by_key(|(priority, id)| (core::cmp::Reverse(*priority), *id));
    assert_eq!(claims(&store).await, expected.iter().map(|(_, id)| *id).collect::<Vec<_>>());
}

pub(crate) async fn owners_alternate_whatever_each_has_queued(home: &Home) {
    let store = home.store().await;
    // What she has at another priority costs Ann no turn at this one.
    for _ in 0..3 {
        of(&store, ann(), 9).await;
    }
    let hers: Vec<NewJob> = (0..40).map(|_| job()).collect();
    store.submit(&hers, at(0)).await.unwrap();
    for _ in 0..10 {
        of(&store, bob(), 0).await;
    }
    let order = claims(&store).await;
    for (place, id) in order[3..23].iter().enumerate() {
        let his = store.get(&bob(), *id).await.unwrap().is_some();
        assert_eq!(his, place % 2 == 1, "place {place}");
    }
}

pub(crate) async fn who_comes_late_is_owed_no_turns(home: &Home) {
    let store = home.store().await;
    let mut hers = Vec::new();
    for _ in 0..6 {
        hers.push(of(&store, ann(), 0).await);
    }
    for id in &hers[..4] {
        assert_eq!(claimed(&store, 1).await.claim.id, *id);
    }
    let his = [of(&store, bob(), 0).await, of(&store, bob(), 0).await];
    assert_eq!(claims(&store).await, [hers[4], his[0], hers[5], his[1]]);
}

pub(crate) async fn a_jobs_position_is_when_it_is_claimed(home: &Home) {
    let store = home.store().await;
    let mut all = Vec::new();
    for (owner, priority) in [(ann(), 0), (ann(), 0), (bob(), 0), (ann(), 3), (bob(), -1), (bob(), 0)] {
        all.push((owner.clone(), of(&store, owner, priority).await));
    }
    let mut places = Vec::new();
    for (owner, id) in &all {
        let position = store.get(owner, *id).await.unwrap().unwrap().queue_position.unwrap();
        let page = Page { state: None, before: None, limit: 100 };
        let listed = store.list(owner, page).await.unwrap();
        assert_eq!(listed.iter().find(|job| job.id == *id).unwrap().queue_position, Some(position));
        places.push((position, *id));
    }
    places.sort_unstable();
    assert_eq!(places.iter().map(|(place, _)| *place).collect::<Vec<_>>(), [1, 2, 3, 4, 5, 6]);
    assert_eq!(claims(&store).await, places.iter().map(|(_, id)| *id).collect::<Vec<_>>());
}

pub(crate) async fn a_list_goes_page_by_page_from_the_latest(home: &Home) {
    let store = home.store().await;
    let mut ids = Vec::new();
    for _ in 0..7 {
        of(&store, bob(), 0).await;
        ids.push(of(&store, ann(), 0).await);
    }
    for at_place in [1, 4] {
        store.cancel(&ann(), ids[at_place], at(1)).await.unwrap();
    }
    ids.reverse();
    let page = Page { state: None, before: None, limit: 3 };
    let mut seen = Vec::new();
    loop {
        let before = seen.last().copied();
        let some = store.list(&ann(), Page { before, ..page }).await.unwrap();
        assert!(some.len() == 3 || seen.len() + some.len() == 7);
        if some.is_empty() {
            break;
        }
        seen.extend(some.iter().map(|job| job.id));
    }
    assert_eq!(seen, ids);
    let cancelled = Page { state: Some(JobState::Cancelled), ..page };
    let some = store.list(&ann(), cancelled).await.unwrap();
    assert_eq!(some.iter().map(|job| job.id).collect::<Vec<_>>(), [ids[2], ids[5]]);
    let rest = store.list(&ann(), Page { before: Some(ids[2]), ..cancelled }).await.unwrap();
    assert_eq!(rest.iter().map(|job| job.id).collect::<Vec<_>>(), [ids[5]]);
}
