//! Time limits, overload, clients that hang up, planners that fail: with stand-ins for the planner.

use core::time::Duration;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use serde_json::json;
use singulate::api::{Engine, ServerSettings};
use singulate::wire::PlanRequest;
use singulate_planner::budget::Budget;
use singulate_planner::check::Report;
use singulate_planner::paper::Judged;
use singulate_planner::plan::{Answer, PlanError, Statistics};
use singulate_planner::search::Progress;
use singulate_planner::statement::Statement;

use crate::host::{Host, PATIENCE, raw_plan, scene, wait_until};

const ONE_THREAD: fn(usize) -> ServerSettings =
    |queue| ServerSettings { threads: 1, queue, ..ServerSettings::default() };

pub(crate) fn timed_out() -> Judged {
    Answer { statement: Statement::timed_out(), statistics: Statistics::default() }.into()
}

/// Runs until the budget ends, and counts itself in `running` meanwhile.
pub(crate) fn wait_for_the_end(running: &AtomicUsize, budget: &Budget<'_>) -> Result<Judged, PlanError> {
    running.fetch_add(1, Ordering::SeqCst);
    while budget.check().is_ok() {
        std::thread::sleep(Duration::from_millis(1));
    }
    running.fetch_sub(1, Ordering::SeqCst);
    Ok(timed_out())
}

/// A planner that runs until its budget ends, with a counter of its own.
macro_rules! endless {
    ($running:ident) => {{
        fn plan(
            _: &singulate::wire::PlanRequest,
            budget: &Budget<'_>,
            _: singulate_planner::search::Progress<'_>,
        ) -> Result<Judged, PlanError> {
            wait_for_the_end(&$running, budget)
        }
        Engine { plan, ..Engine::default() }
    }};
}
pub(crate) use endless;

#[tokio::test]
async fn a_full_service_says_when_to_come_again() {
    static RUNNING: AtomicUsize = AtomicUsize::new(0);
    let host = Host::with(ONE_THREAD(0), endless!(RUNNING)).await;
    let _busy = host.raw(&raw_plan(&scene(60_000)));
    wait_until(|| RUNNING.load(Ordering::SeqCst) == 1).await;
    let reply = host.post("/v1/plans", &scene(1000)).await;
    reply.is_problem(503, "overloaded");
    assert_eq!(reply.header("retry-after"), "1");
    assert_eq!(host.get("/livez").await.status, 200);
}

#[tokio::test]
async fn a_full_service_refuses_without_reading_the_body() {
    static RUNNING: AtomicUsize = AtomicUsize::new(0);
    let host = Host::with(ONE_THREAD(0), endless!(RUNNING)).await;
    let faulty = json!({"settings": {"time_limit_ms": 1000}});
    host.post("/v1/plans", &faulty).await.is_problem(422, "invalid_request");
    let _busy = host.raw(&raw_plan(&scene(60_000)));
    wait_until(|| RUNNING.load(Ordering::SeqCst) == 1).await;
    host.post("/v1/plans", &faulty).await.is_problem(503, "overloaded");
}

#[tokio::test]
async fn a_client_that_hangs_up_frees_its_thread() {
    static RUNNING: AtomicUsize = AtomicUsize::new(0);
    let host = Host::with(ONE_THREAD(0), endless!(RUNNING)).await;
    let started = Instant::now();
    let client = host.raw(&raw_plan(&scene(60_000)));
    wait_until(|| RUNNING.load(Ordering::SeqCst) == 1).await;
    drop(client);
    wait_until(|| RUNNING.load(Ordering::SeqCst) == 0).await;
    assert!(started.elapsed() < PATIENCE, "the time limit ended it, not the hang-up");
}

#[tokio::test]
async fn waiting_for_a_thread_counts_towards_the_time_limit() {
    static RUNNING: AtomicUsize = AtomicUsize::new(0);
    let host = Host::with(ONE_THREAD(4), endless!(RUNNING)).await;
    let _busy = host.raw(&raw_plan(&scene(60_000)));
    wait_until(|| RUNNING.load(Ordering::SeqCst) == 1).await;
    let started = Instant::now();
    let reply = host.post("/v1/plans", &scene(50)).await;
    assert!(started.elapsed() >= Duration::from_millis(50));
    let body = reply.json();
    assert_eq!((reply.status, &body["verdict"], &body["lower_bound"]), (200, &json!("timed_out"), &json!(0)));
    let survey = host.post("/v1/survey", &scene(50)).await.json();
    let undecided = json!({"id": "plate-1", "verdict": "timed_out", "lower_bound": 0, "optimal": false});
    assert_eq!(survey, json!({"objects": [undecided]}));
    let plan = json!({"relocations": [], "target_grasp": {"yaw": 0}});
    let verification = host.post("/v1/plans/verify", &json!({"scene": scene(50), "plan": plan})).await.json();
    assert_eq!((&verification["valid"], &verification["faults"][0]["code"]), (&json!(false), &json!("interrupted")));
    assert_eq!((&verification["first_failing_step"], &verification["replan"]), (&json!(null), &json!(true)));
}

#[tokio::test]
async fn a_planner_that_forgets_the_time_is_not_waited_for() {
    fn plan(_: &PlanRequest, budget: &Budget<'_>, _: Progress<'_>) -> Result<Judged, PlanError> {
        // Far past the deadline, until the handler gives up and cancels.
        while budget.elapsed() < Duration::from_secs(2) {
            std::thread::sleep(Duration::from_millis(1));
        }
        panic!("nobody hears this");
    }
    let host = Host::with(ONE_THREAD(0), Engine { plan, ..Engine::default() }).await;
    let reply = host.post("/v1/plans", &scene(10)).await;
    assert_eq!((reply.status, &reply.json()["verdict"]), (200, &json!("timed_out")));
}

#[tokio::test]
async fn a_planner_that_panics_is_a_500_and_the_service_lives_on() {
    fn plan(_: &PlanRequest, _: &Budget<'_>, _: Progress<'_>) -> Result<Judged, PlanError> {
        panic!("on purpose");
    }
    let host = Host::with(ONE_THREAD(1), Engine { plan, ..Engine::default() }).await;
    for _ in 0..3 {
        host.post("/v1/plans", &scene(60_000)).await.is_problem(500, "internal");
    }
    assert_eq!(host.get("/readyz").await.status, 200);
}

#[tokio::test]
async fn an_answer_that_fails_its_check_is_withheld() {
    fn plan(_: &PlanRequest, _: &Budget<'_>, _: Progress<'_>) -> Result<Judged, PlanError> {
        Err(PlanError::Refused(Report::default()))
    }
    let host = Host::with(ONE_THREAD(1), Engine { plan, ..Engine::default() }).await;
    host.post("/v1/plans", &scene(60_000)).await.is_problem(500, "check_failed");
}

#[tokio::test]
async fn a_plan_that_would_come_too_late_gets_a_503_with_retry_after() {
    static RUNNING: AtomicUsize = AtomicUsize::new(0);
    let host = Host::with(ONE_THREAD(4), endless!(RUNNING)).await;
    // Now it is known that a computation takes some 60 ms.
    for _ in 0..50 {
        assert_eq!(host.post("/v1/plans", &scene(60)).await.status, 200);
    }
    let busy = host.raw(&raw_plan(&scene(60_000)));
    wait_until(|| RUNNING.load(Ordering::SeqCst) == 1).await;
    let reply = host.post("/v1/plans", &scene(20)).await;
    reply.is_problem(503, "overloaded");
    let seconds: u64 = reply.header("retry-after").parse().unwrap();
    assert!((1..=60).contains(&seconds), "{seconds}");
    // Who has more time waits for its turn, and has it once the thread is free.
    let patient = host.raw(&raw_plan(&scene(60_000)));
    drop(busy);
    wait_until(|| RUNNING.load(Ordering::SeqCst) == 1).await;
    drop(patient);
}
