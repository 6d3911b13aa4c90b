//! What a job is from its beginning to its end.

use singulate::jobs::{Counts, End, Event, EventKind, Job, JobState, MAX_INCUMBENT_EVENTS, NewJob, Page};
use singulate_planner::cost::Cost;
use singulate_planner::search::Incumbent;

use crate::home::{Home, ann, at, bob, claimed, job, seen, submitted};

fn event(kind: EventKind, millis: i64, attempts: u32, incumbent: Option<Incumbent>) -> Event {
    Event { kind, at: at(millis), attempts, incumbent, queue_position: (kind == EventKind::Queued).then_some(1) }
}

pub(crate) async fn a_job_is_queued_runs_and_succeeds(home: &Home) {
    let store = home.store().await;
    let new = NewJob { scene_id: Some("cell-4/17".to_owned()), ..job() };
    let queued = submitted(&store, new.clone()).await;
    let expected = Job {
        id: new.id,
        state: JobState::Queued,
        scene_id: new.scene_id,
        scene_sha256: new.scene_sha256,
        created_at: at(0),
        started_at: None,
        finished_at: None,
        expires_at: at(1000),
        attempts: 0,
        queue_position: Some(1),
        incumbent: None,
        result: None,
        problem: None,
        version: None,
        events: vec![event(EventKind::Queued, 0, 0, None)],
    };
    assert_eq!(queued, expected);
    let work = claimed(&store, 10).await;
    assert_eq!((work.claim.id, work.attempt, work.body, work.created_at), (new.id, 1, new.body, at(0)));
    let mut events = expected.events.clone();
    events.push(event(EventKind::Running, 10, 1, None));
    let (state, started_at) = (JobState::Running, Some(at(10)));
    let running = Job { state, started_at, attempts: 1, queue_position: None, events: events.clone(), ..expected };
    assert_eq!(seen(&store, new.id).await, running);
    let best = Incumbent { cost: Cost::new(3), lower_bound: Cost::new(1) };
    assert!(store.note(work.claim, best, at(20)).await.unwrap());
    assert!(store.finish(work.claim, &End::Succeeded(r#"{"cost":3}"#.parse().unwrap()), at(30)).await.unwrap());
    events.push(event(EventKind::Incumbent, 20, 1, Some(best)));
    events.push(event(EventKind::Finished, 30, 1, Some(best)));
    let ended = Job {
        state: JobState::Succeeded,
        finished_at: Some(at(30)),
        expires_at: at(1030),
        incumbent: Some(best),
        result: Some(r#"{"cost":3}"#.parse().unwrap()),
        version: Some(env!("CARGO_PKG_VERSION").to_owned()),
        events,
        ..running
    };
    assert_eq!(seen(&store, new.id).await, ended);
    let page = Page { state: None, before: None, limit: 10 };
    assert_eq!(store.list(&ann(), page).await.unwrap(), [Job { result: None, ..ended }]);
}

pub(crate) async fn a_failure_keeps_its_problem(home: &Home) {
    let store = home.store().await;
    let id = submitted(&store, job()).await.id;
    let work = claimed(&store, 1).await;
    assert!(store.finish(work.claim, &End::Failed(r#"{"status":500}"#.parse().unwrap()), at(2)).await.unwrap());
    let failed = seen(&store, id).await;
    assert_eq!((failed.state, failed.result), (JobState::Failed, None));
    assert_eq!(failed.problem.as_deref(), Some(r#"{"status":500}"#));
}

pub(crate) async fn nobody_sees_anothers_jobs(home: &Home) {
    let store = home.store().await;
    let id = submitted(&store, job()).await.id;
    let page = Page { state: None, before: None, limit: 10 };
    assert_eq!(store.get(&bob(), id).await.unwrap(), None);
    assert_eq!(store.list(&bob(), page).await.unwrap(), []);
    assert_eq!(store.list(&ann(), page).await.unwrap().len(), 1);
    assert_eq!(store.get(&ann(), job().id).await.unwrap(), None);
}

pub(crate) async fn any_text_and_a_long_body_come_back_as_they_were(home: &Home) {
    let store = home.store().await;
    let text = "a\0b — 'ünïcode' \u{1F916}\n\\";
    let (scene_id, callback_url) = (Some(text.to_owned()), Some(format!("https://example.org/{text}")));
    let body: Vec<u8> = (0..3_000_000_u32).map(|i| i.to_le_bytes()[1]).collect();
    let new = NewJob { scene_id, callback_url: callback_url.clone(), body: body.clone(), ..job() };
    let accepted = submitted(&store, new).await;
    assert_eq!(accepted.scene_id.as_deref(), Some(text));
    let work = claimed(&store, 1).await;
    assert!(work.body == body);
    let result = format!("\"{}\"", "é".repeat(1_000_000));
    assert!(store.finish(work.claim, &End::Succeeded(result.as_str().parse().unwrap()), at(2)).await.unwrap());
    assert!(seen(&store, accepted.id).await.result.as_deref() == Some(&*result));
    let callback = store.take_callback(home.settings.lease, &at(3).into()).await.unwrap().unwrap();
    assert_eq!(Some(callback.url), callback_url);
}

pub(crate) async fn the_best_so_far_never_gets_worse(home: &Home) {
    let store = home.store().await;
    let id = submitted(&store, job()).await.id;
    let claim = claimed(&store, 1).await.claim;
    let best = |cost, bound| Incumbent { cost: Cost::new(cost), lower_bound: Cost::new(bound) };
    for (told, known) in [
        (best(9, 1), best(9, 1)),
        (best(9, 1), best(9, 1)),
        (best(9, 2), best(9, 2)),
        (best(11, 1), best(9, 2)),
        (best(7, 1), best(7, 2)),
    ] {
        assert!(store.note(claim, told, at(5)).await.unwrap());
        assert_eq!(seen(&store, id).await.incumbent, Some(known));
    }
    let events = seen(&store, id).await.events;
    let told: Vec<Incumbent> = events.iter().filter_map(|event| event.incumbent).collect();
    assert_eq!(told, [best(9, 1), best(9, 2), best(7, 2)]);
}

pub(crate) async fn events_of_incumbents_end_at_a_hundred(home: &Home) {
    let store = home.store().await;
    let id = submitted(&store, job()).await.id;
    let claim = claimed(&store, 1).await.claim;
    for lower_bound in 0..MAX_INCUMBENT_EVENTS + 5 {
        assert!(
            store
                .note(claim, Incumbent { cost: Cost::new(500), lower_bound: Cost::of_each(lower_bound) }, at(5))
                .await
                .unwrap()
        );
    }
    let noted = seen(&store, id).await;
    let events = noted.events.iter().filter(|event| event.kind == EventKind::Incumbent).count();
    assert_eq!(events, MAX_INCUMBENT_EVENTS);
    assert_eq!(noted.incumbent.unwrap().lower_bound, Cost::of_each(MAX_INCUMBENT_EVENTS + 4));
    assert!(store.finish(claim, &End::Succeeded("{}".parse().unwrap()), at(6)).await.unwrap());
    let last = *seen(&store, id).await.events.last().unwrap();
    assert_eq!((last.kind, last.incumbent), (EventKind::Finished, noted.incumbent));
}

pub(crate) async fn a_store_answers_and_counts(home: &Home) {
    let store = home.store().await;
    store.ping().await.unwrap();
    assert_eq!(store.counts().await.unwrap(), Counts::default());
    for owner in [ann(), bob(), bob()] {
        submitted(&store, NewJob { owner, ..job() }).await;
    }
    let claim = claimed(&store, 1).await.claim;
    assert_eq!(store.counts().await.unwrap(), Counts { queued: 2, running: 1 });
    assert!(store.finish(claim, &End::Failed("{}".parse().unwrap()), at(2)).await.unwrap());
    assert_eq!(store.counts().await.unwrap(), Counts { queued: 2, running: 0 });
}
