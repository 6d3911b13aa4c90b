//! How jobs end.

use serde_json::{Value, json};
use singulate::api::{Engine, ServerSettings};
use singulate::jobs::JobSettings;
use singulate::wire::PlanRequest;
use singulate_planner::budget::Budget;
use singulate_planner::paper::Judged;
use singulate_planner::plan::PlanError;
use singulate_planner::search::Progress;

use super::{crowded, ended, path, submit};
use crate::host::{Host, PATIENCE, endless, scene};

async fn one_worker(engine: Engine) -> Host {
    let jobs = JobSettings { threads: 1, ..JobSettings::default() };
    Host::with(ServerSettings { jobs, ..ServerSettings::default() }, engine).await
}

async fn running(host: &Host, job: &Value) {
    let started = std::time::Instant::now();
    while host.get(&path(job)).await.json()["state"] != "running" {
        assert!(started.elapsed() < PATIENCE);
    }
}

#[tokio::test]
async fn a_deadlock_is_a_success() {
    let host = Host::start().await;
    let mut body = crowded();
    // The vase and the table's edge hold everything.
    for object in body["objects"].as_array_mut().unwrap().iter_mut().skip(1) {
        object["fixed"] = json!(true);
    }
    let job = submit(&host, &body).await;
    let job = ended(&host, &job).await;
    assert_eq!((&job["state"], &job["result"]["verdict"]), (&json!("succeeded"), &json!("deadlock")));
}

#[tokio::test]
async fn a_queued_job_is_cancelled_at_once_and_a_running_one_with_its_best() {
    let host = one_worker(endless()).await;
    let first = submit(&host, &scene(60_000)).await;
    running(&host, &first).await;
    let second = submit(&host, &scene(60_000)).await;
    let reply = host.post(&format!("{}/cancel", path(&second)), &Value::Null).await;
    assert_eq!((reply.status, &reply.json()["state"]), (202, &json!("cancelled")));
    assert!(ended(&host, &second).await["result"].is_null());
    let reply = host.post(&format!("{}/cancel", path(&first)), &Value::Null).await;
    assert_eq!(reply.status, 202);
    let job = ended(&host, &first).await;
    assert_eq!((&job["state"], &job["result"]["verdict"]), (&json!("cancelled"), &json!("timed_out")));
    host.post(&format!("{}/cancel", path(&first)), &Value::Null).await.is_problem(409, "job_finished");
    // The worker is free again.
    let third = submit(&host, &scene(1)).await;
    assert_eq!(ended(&host, &third).await["state"], "succeeded");
}

#[tokio::test]
async fn a_panic_is_one_failed_job_and_its_worker_lives_on() {
    fn plan(request: &PlanRequest, budget: &Budget<'_>, progress: Progress<'_>) -> Result<Judged, PlanError> {
        assert!(request.scene.objects().len() > 2, "on purpose");
        (Engine::default().plan)(request, budget, progress)
    }
    let host = one_worker(Engine { plan, ..Engine::default() }).await;
    for _ in 0..3 {
        let job = submit(&host, &scene(60_000)).await;
        let job = ended(&host, &job).await;
        assert_eq!((&job["state"], &job["result"]), (&json!("failed"), &Value::Null));
        assert_eq!(job["problem"]["type"], "urn:singulate:problem:internal");
    }
    let job = submit(&host, &crowded()).await;
    assert_eq!(ended(&host, &job).await["state"], "succeeded");
    assert_eq!(host.get("/readyz").await.status, 200);
}

#[tokio::test]
async fn only_ended_jobs_are_deleted() {
    let host = one_worker(endless()).await;
    let job = submit(&host, &scene(60_000)).await;
    let delete = || async { host.client.delete(host.url(&path(&job))).send().await.unwrap().status().as_u16() };
    assert_eq!(delete().await, 409);
    host.post(&format!("{}/cancel", path(&job)), &Value::Null).await;
    ended(&host, &job).await;
    assert_eq!((delete().await, delete().await), (204, 404));
    host.get(&path(&job)).await.is_problem(404, "not_found");
}

#[tokio::test]
async fn a_job_that_waited_too_long_has_expired() {
    let jobs = JobSettings { threads: 1, ttl: core::time::Duration::from_millis(300), ..JobSettings::default() };
    let host = Host::with(ServerSettings { jobs, ..ServerSettings::default() }, endless()).await;
    let holder = submit(&host, &scene(60_000)).await;
    running(&host, &holder).await;
    let waiting = submit(&host, &scene(1000)).await;
    let job = ended(&host, &waiting).await;
    assert_eq!((&job["state"], &job["attempts"], &job["result"]), (&json!("expired"), &json!(0), &Value::Null));
}
