//! What is accepted, how often, and how much of it.

use serde_json::{Value, json};
use singulate::api::ServerSettings;
use singulate::jobs::JobSettings;

use super::{crowded, ended, path, submit, submit_with_key};
use crate::host::{Host, endless, scene};

/// A host whose only worker is held by a job without end.
async fn busy(max_queued: usize) -> (Host, Value) {
    let jobs = JobSettings { threads: 1, max_queued, ..JobSettings::default() };
    let host = Host::with(ServerSettings { jobs, ..ServerSettings::default() }, endless()).await;
    let holder = submit(&host, &scene(60_000)).await;
    while host.get(&path(&holder)).await.json()["state"] != "running" {}
    (host, holder)
}

#[tokio::test]
async fn a_job_is_planned_as_the_same_scene_is_at_once() {
    let host = Host::start().await;
    let reply = host.post("/v1/jobs", &crowded()).await;
    let job = reply.json();
    assert_eq!((reply.status, reply.header("location")), (202, path(&job).as_str()));
    assert_eq!((reply.header("retry-after"), reply.header("content-type")), ("1", "application/json"));
    assert_eq!((&job["state"], &job["scene_id"]), (&json!("queued"), &json!("crowded")));
    assert!(job["result"].is_null() && job["finished_at"].is_null() && job["problem"].is_null());
    let job = ended(&host, &job).await;
    assert_eq!(
        (&job["state"], &job["attempts"], &job["queue_position"]),
        (&json!("succeeded"), &json!(1), &Value::Null)
    );
    let answer = host.post("/v1/plans", &crowded()).await.json();
    let mut result = job["result"].clone();
    result["statistics"] = answer["statistics"].clone();
    assert_eq!(result, answer);
    assert_eq!(job["incumbent"], json!({"cost": answer["cost"], "lower_bound": answer["lower_bound"]}));
    let times =
        ["created_at", "started_at", "finished_at", "expires_at"].map(|name| job[name].as_str().unwrap().to_owned());
    assert!(times.is_sorted() && times.iter().all(|time| time.len() == 24 && time.ends_with('Z')), "{times:?}");
    assert_eq!(job["version"], env!("CARGO_PKG_VERSION"));
}

#[tokio::test]
async fn a_faulty_scene_is_refused_before_it_is_a_job() {
    let host = Host::start().await;
    let mut body = crowded();
    body["objects"][1]["radius"] = json!(-1);
    body["priority"] = json!(101);
    body["callback_url"] = json!(7);
    body["colour"] = json!("red");
    let reply = host.post("/v1/jobs", &body).await;
    reply.is_problem(422, "invalid_request");
    let mut pointers = reply.pointers();
    pointers.sort_unstable();
    assert_eq!(pointers, ["/callback_url", "/colour", "/objects/1/radius", "/priority"]);
    assert_eq!(host.get("/v1/jobs").await.json()["jobs"], json!([]));
    // What jobs have besides is nothing for a plan.
    let mut body = crowded();
    body["priority"] = json!(1);
    host.post("/v1/plans", &body).await.is_problem(422, "invalid_request");
}

#[tokio::test]
async fn a_key_and_its_body_are_one_job_as_long_as_it_is_kept() {
    let host = Host::start().await;
    let first = submit_with_key(&host, "cell-4", &crowded()).await.json();
    let again = submit_with_key(&host, "cell-4", &crowded()).await;
    assert_eq!((again.status, &again.json()["id"]), (202, &first["id"]));
    submit_with_key(&host, "cell-4", &scene(1000)).await.is_problem(422, "key_reused");
    assert_ne!(submit_with_key(&host, "cell-5", &crowded()).await.json()["id"], first["id"]);
    ended(&host, &first).await;
    assert_eq!(submit_with_key(&host, "cell-4", &crowded()).await.json()["state"], "succeeded");
    let gone = host.client.delete(host.url(&path(&first))).send().await.unwrap();
    assert_eq!(gone.status(), 204);
    assert_ne!(submit_with_key(&host, "cell-4", &scene(1000)).await.json()["id"], first["id"]);
    for key in ["", &"k".repeat(256)] {
        submit_with_key(&host, key, &crowded()).await.is_problem(422, "invalid_request");
    }
}

#[tokio::test]
async fn many_clients_with_one_key_get_one_job() {
    let host = Host::start().await;
    let calls = (0..32).map(|_| async { submit_with_key(&host, "all", &crowded()).await.json()["id"].clone() });
    let ids = futures_util::future::join_all(calls).await;
    assert!(ids.iter().all(|id| *id == ids[0]), "{ids:?}");
    assert_eq!(host.get("/v1/jobs").await.json()["jobs"].as_array().unwrap().len(), 1);
}

#[tokio::test]
async fn a_batch_is_accepted_as_a_whole_or_not_at_all() {
    let host = Host::start().await;
    let mut faulty = crowded();
    faulty["target"] = json!("nobody");
    let reply = host.post("/v1/jobs/batch", &json!({"scenes": [crowded(), faulty]})).await;
    reply.is_problem(422, "invalid_request");
    assert_eq!(reply.pointers(), ["/scenes/1/target"]);
    for scenes in [json!([]), json!(vec![scene(1000); 101]), json!(7)] {
        let reply = host.post("/v1/jobs/batch", &json!({"scenes": scenes})).await;
        reply.is_problem(422, "invalid_request");
        assert_eq!(reply.pointers(), ["/scenes"]);
    }
    assert_eq!(host.get("/v1/jobs").await.json()["jobs"], json!([]));
    let batch = json!({"scenes": [crowded(), scene(1000)]});
    let headers = [("content-type", "application/json"), ("idempotency-key", "both")];
    let reply = host.post_with("/v1/jobs/batch", &headers, batch.to_string()).await;
    let jobs = reply.json()["jobs"].clone();
    assert_eq!((reply.status, jobs.as_array().unwrap().len()), (202, 2));
    assert_eq!((&jobs[0]["scene_id"], &jobs[1]["scene_id"]), (&json!("crowded"), &json!("cell-4/17")));
    let again = host.post_with("/v1/jobs/batch", &headers, batch.to_string()).await.json()["jobs"].clone();
    assert_eq!((&again[0]["id"], &again[1]["id"]), (&jobs[0]["id"], &jobs[1]["id"]));
    for (job, verdict) in [(&jobs[0], "relocate"), (&jobs[1], "graspable")] {
        assert_eq!(ended(&host, job).await["result"]["verdict"], verdict);
    }
}

#[tokio::test]
async fn a_full_queue_says_when_to_come_again() {
    let (host, holder) = busy(1).await;
    let waiting = submit_with_key(&host, "waiting", &crowded()).await.json();
    let reply = host.post("/v1/jobs", &crowded()).await;
    reply.is_problem(503, "overloaded");
    assert_eq!(reply.header("retry-after"), "1");
    // What was accepted can still be asked for with its key.
    assert_eq!(submit_with_key(&host, "waiting", &crowded()).await.json()["id"], waiting["id"]);
    host.post(&format!("{}/cancel", path(&holder)), &Value::Null).await;
    assert_eq!(ended(&host, &waiting).await["result"]["verdict"], "timed_out");
}

#[tokio::test]
async fn a_greater_priority_goes_first() {
    let (host, _holder) = busy(10).await;
    let mut bodies = [crowded(), crowded(), crowded()];
    bodies[2]["priority"] = json!(1);
    let mut jobs = Vec::new();
    for body in &bodies {
        jobs.push(submit(&host, body).await);
    }
    for (job, position) in jobs.iter().zip([2, 3, 1]) {
        assert_eq!(host.get(&path(job)).await.json()["queue_position"], position);
    }
}
