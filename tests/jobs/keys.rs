//! Idempotency keys, requests of several jobs, the full queue.

use singulate::jobs::{End, JobId, JobState, NewJob, SubmitError};

use crate::home::{Home, ann, at, bob, claimed, job, jobs, keyed, seen, submitted};

pub(crate) async fn a_known_key_gives_the_same_jobs(home: &Home) {
    let store = home.store().await;
    let batch: Vec<NewJob> = (0..5).map(|position| keyed("k", position)).collect();
    let first = store.submit(&batch, at(0)).await.unwrap();
    let ids: Vec<JobId> = batch.iter().map(|job| job.id).collect();
    assert_eq!(first.iter().map(|job| job.id).collect::<Vec<_>>(), ids);
    assert_eq!(first.iter().filter_map(|job| job.queue_position).collect::<Vec<_>>(), [1, 2, 3, 4, 5]);
    let work = claimed(&store, 1).await;
    assert!(store.finish(work.claim, &End::Succeeded("{}".parse().unwrap()), at(2)).await.unwrap());
    let again: Vec<NewJob> = (0..5).map(|position| keyed("k", position)).collect();
    let second = store.submit(&again, at(3)).await.unwrap();
    assert_eq!(second.iter().map(|job| job.id).collect::<Vec<_>>(), ids);
    assert_eq!((second[0].state, second[0].result.as_deref()), (JobState::Succeeded, Some("{}")));
    assert_eq!(second[1], seen(&store, ids[1]).await);
    assert_eq!(store.counts().await.unwrap().queued, 4);
}

pub(crate) async fn a_key_belongs_to_one_request_of_one_owner(home: &Home) {
    let store = home.store().await;
    let first = submitted(&store, keyed("k", 0)).await;
    let other = NewJob { request_sha256: "cc".to_owned(), ..keyed("k", 0) };
    assert_eq!(store.submit(core::slice::from_ref(&other), at(1)).await, Err(SubmitError::KeyReused));
    assert_eq!(store.get(&ann(), other.id).await.unwrap(), None);
    for distinct in [NewJob { owner: bob(), ..keyed("k", 0) }, keyed("K", 0), job(), job()] {
        let id = distinct.id;
        assert_eq!(submitted(&store, distinct).await.id, id);
        assert_ne!(id, first.id);
    }
}

pub(crate) async fn a_forgotten_job_frees_its_key(home: &Home) {
    let store = home.store().await;
    let first = submitted(&store, keyed("k", 0)).await;
    store.cancel(&ann(), first.id, at(1)).await.unwrap();
    assert_eq!(submitted(&store, keyed("k", 0)).await.id, first.id);
    store.forget(&ann(), first.id).await.unwrap();
    let second = submitted(&store, NewJob { request_sha256: "cc".to_owned(), ..keyed("k", 0) }).await;
    assert_ne!(second.id, first.id);
    // And so does one whose time is over.
    store.sweep(at(1000)).await.unwrap();
    store.sweep(at(2000)).await.unwrap();
    assert_ne!(submitted(&store, keyed("k", 0)).await.id, second.id);
}

pub(crate) async fn a_request_is_accepted_as_a_whole_or_not_at_all(home: &Home) {
    let store = home.store().await;
    assert_eq!(store.submit(&[], at(0)).await.unwrap(), []);
    store.submit(&jobs::<997>(), at(0)).await.unwrap();
    assert_eq!(store.submit(&jobs::<4>(), at(0)).await, Err(SubmitError::Full));
    assert_eq!(store.counts().await.unwrap().queued, 997);
    // The last of these is there already.
    let [one, two] = jobs();
    submitted(&store, two.clone()).await;
    let refused = store.submit(&[one.clone(), two], at(0)).await;
    assert!(matches!(refused, Err(SubmitError::Store(_))), "{refused:?}");
    assert_eq!(store.get(&ann(), one.id).await.unwrap(), None);
    assert_eq!(store.submit(&jobs::<2>(), at(0)).await.unwrap().len(), 2);
}

pub(crate) async fn a_known_key_is_answered_by_a_full_queue(home: &Home) {
    let store = home.store().await;
    let first = submitted(&store, keyed("k", 0)).await;
    store.submit(&jobs::<999>(), at(0)).await.unwrap();
    assert_eq!(store.submit(&jobs::<1>(), at(0)).await, Err(SubmitError::Full));
    assert_eq!(submitted(&store, keyed("k", 0)).await.id, first.id);
    let other = NewJob { request_sha256: "cc".to_owned(), ..keyed("k", 0) };
    assert_eq!(store.submit(&[other], at(0)).await, Err(SubmitError::KeyReused));
}

pub(crate) async fn a_claimed_job_leaves_its_place_in_the_queue(home: &Home) {
    let store = home.store().await;
    store.submit(&jobs::<1000>(), at(0)).await.unwrap();
    assert_eq!(store.submit(&jobs::<1>(), at(0)).await, Err(SubmitError::Full));
    let claim = claimed(&store, 1).await.claim;
    store.submit(&jobs::<1>(), at(1)).await.unwrap();
    // What was accepted goes back, full or not.
    assert!(store.hand_back(claim, at(2)).await.unwrap());
    assert_eq!(store.counts().await.unwrap().queued, 1001);
}
