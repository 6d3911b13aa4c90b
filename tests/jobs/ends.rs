//! How jobs end, but by their workers, and are forgotten.

use singulate::jobs::{Cancellation, End, EventKind, JobState, NewJob, Page, Removal, Renewal, Swept};

use crate::home::{Home, ann, at, bob, claimed, job, seen, submitted};

pub(crate) async fn a_queued_job_is_cancelled_at_once(home: &Home) {
    let store = home.store().await;
    let id = submitted(&store, job()).await.id;
    let Cancellation::Accepted(job) = store.cancel(&ann(), id, at(5)).await.unwrap() else { panic!("not accepted") };
    assert_eq!((job.state, job.finished_at, job.expires_at), (JobState::Cancelled, Some(at(5)), at(1005)));
    assert_eq!((&job.result, &job.problem, job.queue_position, job.attempts), (&None, &None, None, 0));
    assert_eq!(job.version.as_deref(), Some(env!("CARGO_PKG_VERSION")));
    assert_eq!(job.events.iter().map(|event| event.kind).collect::<Vec<_>>(), [EventKind::Queued, EventKind::Finished]);
    assert_eq!(*job, seen(&store, id).await);
    assert_eq!(store.claim(&at(6).into()).await.unwrap(), None);
}

pub(crate) async fn a_running_job_is_cancelled_with_its_answer(home: &Home) {
    let store = home.store().await;
    let id = submitted(&store, job()).await.id;
    let claim = claimed(&store, 1).await.claim;
    assert_eq!(store.renew(claim, &at(2).into()).await.unwrap(), Renewal::Held);
    for millis in [3, 4] {
        let Cancellation::Accepted(job) = store.cancel(&ann(), id, at(millis)).await.unwrap() else {
            panic!("not accepted")
        };
        assert_eq!((job.state, job.finished_at), (JobState::Running, None));
    }
    assert_eq!(store.renew(claim, &at(5).into()).await.unwrap(), Renewal::Cancelled);
    assert!(store.finish(claim, &End::Succeeded("{}".parse().unwrap()), at(6)).await.unwrap());
    let ended = seen(&store, id).await;
    assert_eq!((ended.state, ended.result.as_deref()), (JobState::Cancelled, Some("{}")));
    assert_eq!(ended.finished_at, Some(at(6)));
}

pub(crate) async fn a_cancelled_job_that_fails_has_no_answer(home: &Home) {
    let store = home.store().await;
    let id = submitted(&store, job()).await.id;
    let claim = claimed(&store, 1).await.claim;
    store.cancel(&ann(), id, at(2)).await.unwrap();
    for _ in 0..2 {
        assert!(store.finish(claim, &End::Failed("{}".parse().unwrap()), at(3)).await.unwrap());
    }
    let ended = seen(&store, id).await;
    assert_eq!((ended.state, ended.result, ended.problem), (JobState::Cancelled, None, None));
}

pub(crate) async fn what_has_ended_is_not_cancelled(home: &Home) {
    let store = home.store().await;
    let id = submitted(&store, job()).await.id;
    assert_eq!(store.cancel(&bob(), id, at(1)).await.unwrap(), Cancellation::Unknown);
    assert_eq!(store.cancel(&ann(), job().id, at(1)).await.unwrap(), Cancellation::Unknown);
    let claim = claimed(&store, 1).await.claim;
    assert!(store.finish(claim, &End::Succeeded("{}".parse().unwrap()), at(2)).await.unwrap());
    let ended = seen(&store, id).await;
    assert_eq!(store.cancel(&ann(), id, at(3)).await.unwrap(), Cancellation::Finished);
    assert_eq!(seen(&store, id).await, ended);
}

pub(crate) async fn only_ended_jobs_are_deleted(home: &Home) {
    let store = home.store().await;
    let id = submitted(&store, job()).await.id;
    assert_eq!(store.forget(&ann(), id).await.unwrap(), Removal::Unfinished);
    let claim = claimed(&store, 1).await.claim;
    assert_eq!(store.forget(&ann(), id).await.unwrap(), Removal::Unfinished);
    assert!(store.finish(claim, &End::Succeeded("{}".parse().unwrap()), at(2)).await.unwrap());
    assert_eq!(store.forget(&bob(), id).await.unwrap(), Removal::Unknown);
    assert_eq!(store.forget(&ann(), id).await.unwrap(), Removal::Forgotten);
    assert_eq!(store.forget(&ann(), id).await.unwrap(), Removal::Unknown);
    assert_eq!(store.get(&ann(), id).await.unwrap(), None);
    assert!(!store.finish(claim, &End::Succeeded("{}".parse().unwrap()), at(3)).await.unwrap());
}

pub(crate) async fn a_job_that_waited_too_long_expires(home: &Home) {
    let store = home.store().await;
    let id = submitted(&store, job()).await.id;
    assert_eq!(store.sweep(at(999)).await.unwrap(), Swept::default());
    assert_eq!(store.claim(&at(1000).into()).await.unwrap(), None);
    assert_eq!(store.sweep(at(1000)).await.unwrap(), Swept { expired: vec![id], ..Swept::default() });
    let expired = seen(&store, id).await;
    assert_eq!((expired.state, expired.finished_at), (JobState::Expired, Some(at(1000))));
    assert_eq!((expired.expires_at, expired.result, expired.problem), (at(2000), None, None));
    assert_eq!(expired.events.last().unwrap().kind, EventKind::Finished);
}

pub(crate) async fn a_job_that_begins_in_time_may_take_longer(home: &Home) {
    let store = home.store().await;
    let id = submitted(&store, job()).await.id;
    let claim = claimed(&store, 999).await.claim;
    assert_eq!(store.renew(claim, &at(1050).into()).await.unwrap(), Renewal::Held);
    assert_eq!(store.sweep(at(1060)).await.unwrap(), Swept::default());
    assert_eq!(seen(&store, id).await.state, JobState::Running);
}

pub(crate) async fn what_ended_is_forgotten_when_its_time_is_over(home: &Home) {
    let store = home.store().await;
    let id = submitted(&store, job()).await.id;
    store.cancel(&ann(), id, at(500)).await.unwrap();
    assert_eq!(store.sweep(at(1499)).await.unwrap(), Swept::default());
    assert_eq!(store.sweep(at(1500)).await.unwrap(), Swept { forgotten: 1, ..Swept::default() });
    assert_eq!(store.get(&ann(), id).await.unwrap(), None);
}

pub(crate) async fn a_sweep_sees_to_more_than_one_batch(home: &Home) {
    let store = home.store().await;
    let many: Vec<NewJob> = (0..500).map(|_| job()).collect();
    store.submit(&many, at(0)).await.unwrap();
    let mut swept = store.sweep(at(1000)).await.unwrap();
    swept.expired.sort_unstable();
    assert_eq!(swept, Swept { expired: many.iter().map(|job| job.id).collect(), ..Swept::default() });
    let page = Page { state: Some(JobState::Expired), before: None, limit: 1000 };
    assert_eq!(store.list(&ann(), page).await.unwrap().len(), 500);
    assert_eq!(store.sweep(at(2000)).await.unwrap(), Swept { forgotten: 500, ..Swept::default() });
}
