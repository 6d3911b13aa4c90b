//! Jobs for goals, and what is counted of them.

use serde_json::{Value, json};

use super::{clearing, wanting};
use crate::host::{Host, Reply};
use crate::jobs::events::messages;
use crate::jobs::{crowded, ended, path, submit};

/// Without what differs from run to run.
fn steady(mut answer: Value) -> Value {
    answer.as_object_mut().unwrap().remove("statistics").unwrap();
    answer
}

#[tokio::test]
async fn a_job_for_a_clearing_has_no_incumbent_and_the_answer_as_its_result() {
    let host = Host::start().await;
    let job = ended(&host, &submit(&host, &clearing()).await).await;
    assert_eq!((&job["state"], &job["incumbent"]), (&json!("succeeded"), &Value::Null));
    let answer = host.post("/v1/plans", &clearing()).await.json();
    assert_eq!((&answer["verdict"], &answer["left"]), (&json!("cleared"), &json!([])));
    assert_eq!(steady(job["result"].clone()), steady(answer));
    let told = messages(&host.get(&format!("{}/events", path(&job))).await.text);
    assert_eq!(told.iter().map(|(_, name, _)| name.as_str()).collect::<Vec<_>>(), ["queued", "running", "finished"]);
}

#[tokio::test]
async fn a_batch_may_want_something_else_of_each_scene() {
    let host = Host::start().await;
    let goals = [json!({"any_of": ["cup", "plate-1"]}), json!({"all_of": ["cup"]}), json!({"clear": true})];
    let tray = json!([{"id": "tray", "capacity": 3}]);
    let mut scenes: Vec<Value> = goals.map(|goal| wanting(crowded(), goal, tray.clone())).into();
    scenes.push(crowded());
    let reply: Reply = host.post("/v1/jobs/batch", &json!({"scenes": scenes})).await;
    assert_eq!(reply.status, 202, "{reply:?}");
    let jobs = reply.json()["jobs"].as_array().unwrap().clone();
    let mut digests: Vec<&Value> = jobs.iter().map(|job| &job["scene_sha256"]).collect();
    digests.dedup();
    assert_eq!(digests.len(), 4, "no two of them are one scene: {digests:?}");
    let expected =
        [("relocate", json!(1)), ("relocate", json!(3)), ("partly_cleared", json!(3)), ("relocate", json!(2))];
    for (job, (verdict, cost)) in jobs.iter().zip(expected) {
        let result = &ended(&host, job).await["result"];
        assert_eq!((&result["verdict"], &result["cost"]), (&json!(verdict), &cost), "{result}");
    }
}

#[tokio::test]
async fn plans_are_counted_by_the_verdicts_of_clearings_too() {
    let host = Host::start().await;
    let one = json!([{"id": "tray", "capacity": 1}]);
    for (scene, verdict) in
        [(clearing(), "cleared"), (wanting(crowded(), json!({"clear": true}), one), "partly_cleared")]
    {
        assert_eq!(host.post("/v1/plans", &scene).await.json()["verdict"], verdict);
        let text = host.get("/metrics").await.text;
        assert!(text.contains(&format!("singulate_planning_seconds_count{{verdict=\"{verdict}\"}} 1\n")), "{text}");
    }
}
