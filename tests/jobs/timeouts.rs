//! Calls that the store keeps waiting: what has timed out has not happened, and a lease begins when the job is taken.

use core::sync::atomic::{AtomicI64, Ordering};
use core::time::Duration;
use std::sync::Arc;

use futures_util::future::{ready, select};
use singulate::jobs::{
    Claim, Delivery, End, EventKind, Job, JobId, JobState, NewJob, Renewal, Store, Swept, WallClock,
};
use singulate_planner::cost::Cost;
use singulate_planner::search::Incumbent;
use sqlx::{Connection, PgConnection, SqliteConnection};
use tokio::time::{Instant, sleep};

use crate::home::{Home, LEASE, PATIENCE, ann, at, claimed, job, seen, submitted};

/// While it is there, nothing can be written.
enum WriteLock {
    Sqlite(SqliteConnection),
    Postgres(PgConnection),
}

impl WriteLock {
    async fn on(home: &Home) -> Self {
        let url = &home.settings.url;
        if home.schema.is_none() {
            let mut connection = SqliteConnection::connect(url).await.unwrap();
            sqlx::raw_sql("BEGIN IMMEDIATE").execute(&mut connection).await.unwrap();
            Self::Sqlite(connection)
        } else {
            let mut connection = PgConnection::connect(url).await.unwrap();
            sqlx::raw_sql("BEGIN; LOCK TABLE jobs IN EXCLUSIVE MODE").execute(&mut connection).await.unwrap();
            Self::Postgres(connection)
        }
    }

    async fn release(self) {
        match self {
            Self::Sqlite(mut connection) => {
                sqlx::raw_sql("ROLLBACK").execute(&mut connection).await.unwrap();
            }
            Self::Postgres(mut connection) => {
                sqlx::raw_sql("ROLLBACK").execute(&mut connection).await.unwrap();
            }
        }
    }
}

/// Done once all transactions that waited have ended: writers wait in line, and these come last.
async fn all_have_ended(home: &Home, store: &Arc<dyn Store>) {
    store.forget(&ann(), JobId::new()).await.unwrap();
    WriteLock::on(home).await.release().await;
}

/// A clock that somebody sets.
fn clock() -> (Arc<AtomicI64>, WallClock) {
    let millis = Arc::<AtomicI64>::default();
    let shown = Arc::clone(&millis);
    (millis, WallClock::new(move || at(shown.load(Ordering::SeqCst))))
}

/// Three jobs: one waits, one runs, and one has ended and its caller is still to be told.
async fn three(store: &Arc<dyn Store>) -> [Job; 3] {
    let running = submitted(store, job()).await.id;
    claimed(store, 0).await;
    let url = Some("https://example.org".to_owned());
    let ended = submitted(store, NewJob { callback_url: url, ..job() }).await.id;
    let claim = claimed(store, 0).await.claim;
    assert!(store.finish(claim, &End::Succeeded("{}".parse().unwrap()), at(1)).await.unwrap());
    let queued = submitted(store, job()).await.id;
    [seen(store, queued).await, seen(store, running).await, seen(store, ended).await]
}

pub(crate) async fn a_call_that_timed_out_has_changed_nothing(home: &Home) {
    let store = home.store().await;
    let before = three(&store).await;
    let [queued, running, ended] = before.each_ref().map(|job| job.id);
    let claim = Claim { id: running, fence: 1 };
    let (owner, new, end) = (ann(), [job()], End::Succeeded("{}".parse().unwrap()));
    let lock = WriteLock::on(home).await;
    let clock = at(50).into();
    let failed = tokio::join!(
        async { store.claim(&clock).await.is_err() },
        async { store.submit(&new, at(50)).await.is_err() },
        async { store.renew(claim, &clock).await.is_err() },
        async { store.note(claim, Incumbent { cost: Cost::new(2), lower_bound: Cost::new(1) }, at(50)).await.is_err() },
        async { store.finish(claim, &end, at(50)).await.is_err() },
        async { store.hand_back(claim, at(50)).await.is_err() },
        async { store.cancel(&owner, queued, at(50)).await.is_err() },
        async { store.forget(&owner, ended).await.is_err() },
        async { store.sweep(at(5000)).await.is_err() },
        async { store.take_callback(LEASE, &clock).await.is_err() },
    );
    assert_eq!(failed, (true, true, true, true, true, true, true, true, true, true));
    lock.release().await;
    all_have_ended(home, &store).await;
    for job in before {
        assert_eq!(seen(&store, job.id).await, job);
    }
    assert_eq!(store.get(&owner, new[0].id).await.unwrap(), None);
    // The lease was not made longer, and nobody was told of the end.
    assert_eq!(store.sweep(at(100)).await.unwrap(), Swept { requeued: vec![running], ..Swept::default() });
    assert_eq!(store.take_callback(LEASE, &at(100).into()).await.unwrap().unwrap().attempt, 1);
}

/// Begins a call and waits for its answer no longer.
async fn begin_and_go(call: impl Future) {
    let call = core::pin::pin!(call);
    drop(select(call, ready(())).await);
}

/// What it says, once it says something.
async fn once<T>(ask: impl AsyncFn() -> Option<T>) -> T {
    let begin = Instant::now();
    loop {
        if let Some(answer) = ask().await {
            return answer;
        }
        assert!(begin.elapsed() < PATIENCE, "in vain");
        sleep(Duration::from_millis(5)).await;
    }
}

pub(crate) async fn a_claim_whose_caller_left_is_handed_back(home: &Home) {
    let store = home.store().await;
    let id = submitted(&store, job()).await.id;
    begin_and_go(store.claim(&at(1).into())).await;
    let back = once(async || Some(seen(&store, id).await).filter(|job| job.events.len() == 3)).await;
    let kinds: Vec<EventKind> = back.events.iter().map(|event| event.kind).collect();
    assert_eq!(kinds, [EventKind::Queued, EventKind::Running, EventKind::Queued]);
    assert_eq!((back.state, back.attempts, back.started_at), (JobState::Queued, 0, None));
    assert_eq!(claimed(&store, 2).await.attempt, 1);
}

pub(crate) async fn a_callback_whose_caller_left_is_due_at_once(home: &Home) {
    let store = home.store().await;
    let url = Some("https://example.org".to_owned());
    submitted(&store, NewJob { callback_url: url, ..job() }).await;
    let claim = claimed(&store, 1).await.claim;
    assert!(store.finish(claim, &End::Succeeded("{}".parse().unwrap()), at(2)).await.unwrap());
    begin_and_go(store.take_callback(LEASE, &at(3).into())).await;
    let callback = once(async || store.take_callback(LEASE, &at(4).into()).await.unwrap()).await;
    assert_eq!(callback.attempt, 1);
    store.settle_callback(callback.job.id, 1, Delivery::Over).await.unwrap();
}

/// What the call answers that waits for the lock until the clock shows this.
async fn held_up<T>(home: &Home, (clock, until): (&AtomicI64, i64), call: impl Future<Output = T>) -> T {
    let lock = WriteLock::on(home).await;
    let release = async {
        // Enough for the call to come to the lock. One that comes later passes as well.
        sleep(Duration::from_millis(50)).await;
        clock.store(until, Ordering::SeqCst);
        lock.release().await;
    };
    tokio::join!(call, release).0
}

pub(crate) async fn a_lease_begins_when_the_store_can_write(home: &Home) {
    let store = home.store().await;
    let id = submitted(&store, job()).await.id;
    let (millis, clock) = clock();
    let work = held_up(home, (&millis, 50), store.claim(&clock)).await.unwrap().unwrap();
    assert_eq!(seen(&store, id).await.started_at, Some(at(50)));
    assert_eq!(store.sweep(at(149)).await.unwrap(), Swept::default());
    let renewal = held_up(home, (&millis, 90), store.renew(work.claim, &clock)).await.unwrap();
    assert_eq!(renewal, Renewal::Held);
    assert_eq!(store.sweep(at(189)).await.unwrap(), Swept::default());
    assert_eq!(store.sweep(at(190)).await.unwrap(), Swept { requeued: vec![id], ..Swept::default() });
}
