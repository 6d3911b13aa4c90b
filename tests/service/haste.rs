//! The real planner in a hurry, and clients that leave it.

use core::time::Duration;
use std::time::Instant;

use serde_json::{Value, json};
use singulate::api::{Engine, ServerSettings};
use singulate::experiments::{Recipe, generate};
use singulate::wire::SceneBody;
use singulate_planner::scene::{Scene, SceneDraft, SceneLimits};

use crate::hard::hard;
use crate::host::{Host, PATIENCE, raw_post};

fn body(draft: SceneDraft, time_limit_ms: u64) -> Value {
    let (scene, _) = Scene::new(draft, &SceneLimits::default()).unwrap();
    let mut body = serde_json::to_value(SceneBody::new(&scene, Some("hard"))).unwrap();
    body["settings"] = json!({"time_limit_ms": time_limit_ms});
    body
}

/// Too many objects to be read where they arrive.
fn many(time_limit_ms: u64) -> Value {
    let recipe = Recipe { objects: 8000, table: (30.0, 15.0), ..Recipe::default() };
    body(generate(&recipe, 0).unwrap(), time_limit_ms)
}

#[tokio::test]
async fn a_scene_too_large_to_be_read_in_its_time_is_told_so_on_every_path() {
    // Somebody holds the only thread, so that the reading is late on any machine.
    let settings = ServerSettings { threads: 1, ..ServerSettings::default() };
    let host = Host::with(settings, Engine::default()).await;
    let holder = host.raw(&raw_post("/v1/survey", &hard(60_000)));
    tokio::time::sleep(Duration::from_millis(300)).await;
    let scene = many(1);
    let plan = host.post("/v1/plans", &scene).await;
    let answer = plan.json();
    assert_eq!((plan.status, &answer["verdict"]), (200, &json!("timed_out")), "{plan:?}");
    assert_eq!((&answer["scene_id"], &answer["target"]), (&json!("hard"), &scene["target"]));
    assert_eq!((&answer["lower_bound"], &answer["landmarks"]), (&json!(0), &json!([])));
    assert!(answer["needed"].is_null() && answer["cost"].is_null());
    let claim = json!({"relocations": [], "target_grasp": {"yaw": 0}});
    let verification = host.post("/v1/plans/verify", &json!({"scene": scene, "plan": claim})).await;
    assert_eq!(verification.json()["faults"][0]["code"], "interrupted");
    // Nothing can be said of objects that are not known.
    host.post("/v1/survey", &scene).await.is_problem(503, "overloaded");
    drop(holder);
}

#[tokio::test]
async fn a_large_scene_is_answered_like_a_small_one() {
    let host = Host::start().await;
    let mut scene = many(60_000);
    let reply = host.post("/v1/plans", &scene).await;
    assert_eq!(reply.status, 200);
    assert_ne!(reply.json()["verdict"], "timed_out");
    let question = json!({"scene": scene, "plan": reply.json()});
    assert_eq!(
        host.post("/v1/plans/verify", &question).await.text,
        r#"{"valid":true,"faults":[],"first_failing_step":null,"replan":false}"#
    );
    scene["objects"][7999]["radius"] = json!(-1);
    let reply = host.post("/v1/plans", &scene).await;
    reply.is_problem(422, "invalid_request");
    assert_eq!(reply.pointers(), ["/objects/7999/radius"]);
}

#[tokio::test]
async fn many_clients_that_hang_up_leave_nothing_behind() {
    let settings = ServerSettings { threads: 1, queue: 2, ..ServerSettings::default() };
    let host = Host::with(settings, Engine::default()).await;
    let request = raw_post("/v1/survey", &hard(60_000));
    let started = Instant::now();
    for _ in 0..50 {
        drop(host.raw(&request));
    }
    // One that has come so far that it computes.
    let running = host.raw(&request);
    tokio::time::sleep(Duration::from_millis(300)).await;
    drop(running);
    // Each of them would hold the only thread or a place in the queue.
    let mut easy = crate::host::scene(10_000);
    easy["scene_id"] = json!("after");
    while host.post("/v1/plans", &easy).await.status == 503 {
        assert!(started.elapsed() < PATIENCE, "the service is full of requests that nobody waits for");
        tokio::time::sleep(Duration::from_millis(1)).await;
    }
    assert_eq!(host.post("/v1/plans", &easy).await.json()["verdict"], "graspable");
    assert!(started.elapsed() < PATIENCE / 2, "a time limit ended them, not the hang-ups");
}
