//! The pool as a whole.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::channel;
use std::time::{Duration, Instant};

use super::{Pool, PoolOutcome, Refused};
use singulate_planner::budget::Budget;

const ANYBODY: &str = "anybody";

const LONG: Duration = Duration::from_secs(600);

/// A computation that runs until its budget ends.
fn endless(budget: &Budget<'_>) {
    while budget.check().is_ok() {
        std::thread::sleep(Duration::from_millis(1));
    }
}

fn wait_until(mut condition: impl FnMut() -> bool) {
    let start = Instant::now();
    while !condition() {
        assert!(start.elapsed() < Duration::from_secs(60), "waited in vain");
        std::thread::sleep(Duration::from_millis(1));
    }
}

#[tokio::test]
async fn a_computation_delivers() {
    let pool = Pool::new(2, 0).unwrap();
    let pending = pool.submit(ANYBODY, Instant::now(), LONG, |_| 7).unwrap();
    assert_eq!(pending.outcome().await, PoolOutcome::Done(7));
}

#[tokio::test]
async fn a_panic_is_told_and_the_thread_lives_on() {
    let pool = Pool::new(1, 1).unwrap();
    let pending = pool.submit(ANYBODY, Instant::now(), LONG, |_| -> u8 { panic!("on purpose") }).unwrap();
    assert_eq!(pending.outcome().await, PoolOutcome::Panicked);
    let pending = pool.submit(ANYBODY, Instant::now(), LONG, |_| 7).unwrap();
    assert_eq!(pending.outcome().await, PoolOutcome::Done(7));
    assert!(pool.ready());
}

#[tokio::test]
async fn a_full_pool_refuses_until_a_caller_hangs_up() {
    let pool = Pool::new(1, 1).unwrap();
    let running = pool.submit(ANYBODY, Instant::now(), LONG, endless).unwrap();
    wait_until(|| pool.idle() == 0);
    let waiting = pool.submit(ANYBODY, Instant::now(), LONG, endless).unwrap();
    assert_eq!(pool.submit(ANYBODY, Instant::now(), LONG, endless).unwrap_err(), Refused::Full);
    drop(waiting);
    let waiting = pool.submit(ANYBODY, Instant::now(), LONG, |_| 7).unwrap();
    drop(running);
    assert_eq!(waiting.outcome().await, PoolOutcome::Done(7));
}

#[tokio::test]
async fn a_computation_that_waits_past_its_deadline_never_starts() {
    let pool = Pool::new(1, 1).unwrap();
    let running = pool.submit(ANYBODY, Instant::now(), LONG, endless).unwrap();
    wait_until(|| pool.idle() == 0);
    let began = Arc::new(AtomicBool::new(false));
    let mark = Arc::clone(&began);
    let computation = move |_: &Budget<'_>| mark.store(true, Ordering::Relaxed);
    let waiting = pool.submit(ANYBODY, Instant::now(), Duration::from_millis(5), computation).unwrap();
    assert_eq!(waiting.outcome().await, PoolOutcome::TimedOut);
    drop(running);
    wait_until(|| pool.idle() == 1);
    assert!(!began.load(Ordering::Relaxed));
}

#[tokio::test]
async fn a_computation_that_ignores_its_budget_is_not_waited_for() {
    let pool = Pool::new(1, 1).unwrap();
    let (release, held) = std::sync::mpsc::channel::<()>();
    let computation = move |_: &Budget<'_>| held.recv().is_ok();
    let pending = pool.submit(ANYBODY, Instant::now(), Duration::from_millis(5), computation).unwrap();
    assert_eq!(pending.outcome().await, PoolOutcome::TimedOut);
    drop(release);
}

#[tokio::test]
async fn a_closed_pool_finishes_what_it_has() {
    let pool = Pool::new(1, 1).unwrap();
    let first = pool.submit(ANYBODY, Instant::now(), Duration::from_millis(20), endless).unwrap();
    wait_until(|| pool.idle() == 0);
    let second = pool.submit(ANYBODY, Instant::now(), LONG, |_| 7).unwrap();
    pool.join();
    assert!(!pool.ready());
    assert_eq!(pool.submit(ANYBODY, Instant::now(), LONG, |_| 7).unwrap_err(), Refused::Closed);
    assert_eq!((first.outcome().await, second.outcome().await), (PoolOutcome::Done(()), PoolOutcome::Done(7)));
}

/// A computation that runs until the sender is dropped.
fn held(pool: &Pool) -> (std::sync::mpsc::Sender<()>, super::Pending<bool>) {
    let (release, held) = channel::<()>();
    let pending = pool.submit(ANYBODY, Instant::now(), LONG, move |_| held.recv().is_ok()).unwrap();
    wait_until(|| pool.idle() == 0);
    (release, pending)
}

/// Recent computations have taken this long.
fn have_taken(pool: &Pool, time: Duration) {
    (0..1000).for_each(|_| pool.shared.lock().forecast.note(time));
}

#[tokio::test]
async fn owners_take_turns_at_the_thread() {
    let pool = Pool::new(1, 10).unwrap();
    let (release, _running) = held(&pool);
    let (order, served) = channel();
    let pending: Vec<_> = ["a", "a", "a", "b", "b", "c"]
        .iter()
        .map(|owner| {
            let order = order.clone();
            pool.submit(owner, Instant::now(), LONG, move |_| order.send(*owner).is_ok()).unwrap()
        })
        .collect();
    drop(release);
    for pending in pending {
        assert_eq!(pending.outcome().await, PoolOutcome::Done(true));
    }
    assert_eq!(served.try_iter().collect::<String>(), "abcaba");
}

#[tokio::test]
async fn a_computation_that_can_not_start_in_time_is_refused_at_once() {
    let pool = Pool::new(1, 10).unwrap();
    let minute = Duration::from_secs(60);
    let ask = |pool: &Pool, limit| pool.submit(ANYBODY, Instant::now(), limit, |_| 7);
    let (release, _running) = held(&pool);
    // Nothing has ended yet, so there is no forecast.
    let hopeful = ask(&pool, Duration::from_secs(1)).unwrap();
    have_taken(&pool, minute);
    let Err(Refused::TooLate { retry_after }) = ask(&pool, Duration::from_secs(30)) else { panic!("taken") };
    // A minute for the running one, and at most its own second for the queued one.
    assert!(retry_after > minute && retry_after <= minute + Duration::from_secs(1), "{retry_after:?}");
    assert!(matches!(pool.room(ANYBODY, Duration::from_secs(30)), Err(Refused::TooLate { .. })));
    assert_eq!(pool.room(ANYBODY, LONG), Ok(()), "to ask takes no room");
    let patient = ask(&pool, LONG).unwrap();
    let Err(Refused::TooLate { retry_after }) = ask(&pool, minute) else { panic!("taken") };
    assert!(retry_after > 2 * minute, "{retry_after:?}");
    drop(release);
    assert_eq!(patient.outcome().await, PoolOutcome::Done(7));
    wait_until(|| pool.idle() == 1);
    // Whatever the forecast, an idle thread begins at once.
    assert!(ask(&pool, Duration::from_secs(30)).is_ok());
    drop(hopeful);
}

#[tokio::test]
async fn an_owner_with_a_shorter_queue_is_accepted_when_another_is_refused() {
    let pool = Pool::new(1, 10).unwrap();
    let limit = Duration::from_secs(150);
    let (_release, _running) = held(&pool);
    have_taken(&pool, Duration::from_secs(60));
    let ask = |owner| pool.submit(owner, Instant::now(), limit, |_| 7);
    let _waiting = (ask("a").unwrap(), ask("a").unwrap());
    assert!(matches!(ask("a"), Err(Refused::TooLate { .. })));
    assert!(ask("b").is_ok());
}

#[tokio::test]
async fn a_recalled_computation_delivers_its_best_so_far() {
    let pool = Pool::new(1, 1).unwrap();
    let (told, began) = channel();
    let best_so_far = move |budget: &Budget<'_>| {
        told.send(()).unwrap();
        endless(budget);
        7
    };
    let running = pool.submit(ANYBODY, Instant::now(), LONG, best_so_far).unwrap();
    wait_until(|| began.try_recv().is_ok());
    let began = Arc::new(AtomicBool::new(false));
    let mark = Arc::clone(&began);
    let waiting = pool.submit(ANYBODY, Instant::now(), LONG, move |_| mark.store(true, Ordering::Relaxed)).unwrap();
    let recalls = [running.recall(), waiting.recall()];
    let outcomes = tokio::spawn(async { (waiting.outcome().await, running.outcome().await) });
    for recall in &recalls {
        recall.clone().finish_soon();
        recall.finish_soon();
    }
    assert_eq!(outcomes.await.unwrap(), (PoolOutcome::TimedOut, PoolOutcome::Done(7)));
    wait_until(|| pool.idle() == 1);
    assert!(!began.load(Ordering::Relaxed), "it began though it was recalled");
}

#[tokio::test]
async fn a_pool_calls_everything_to_its_end() {
    let pool = Pool::new(2, 1).unwrap();
    let submit = || pool.submit(ANYBODY, Instant::now(), LONG, endless).unwrap();
    let running = [submit(), submit()];
    wait_until(|| pool.busy() == 2);
    let waiting = submit();
    pool.finish_soon();
    for pending in running {
        assert_eq!(pending.outcome().await, PoolOutcome::Done(()));
    }
    assert_eq!(waiting.outcome().await, PoolOutcome::TimedOut);
    wait_until(|| pool.busy() == 0);
}

#[tokio::test]
async fn a_late_computation_that_loses_its_place_has_timed_out() {
    let pool = Pool::new(1, 1).unwrap();
    let (release, _running) = held(&pool);
    let late = pool.submit(ANYBODY, Instant::now(), Duration::from_millis(1), |_| 7).unwrap();
    std::thread::sleep(Duration::from_millis(5));
    let next = pool.submit(ANYBODY, Instant::now(), LONG, |_| 7).unwrap();
    assert_eq!(late.outcome().await, PoolOutcome::TimedOut);
    drop(release);
    assert_eq!(next.outcome().await, PoolOutcome::Done(7));
}
