//! What is answered of a goal when time is up.

use core::time::Duration;

use serde_json::{Value, json};
use singulate::api::{Engine, ServerSettings};
use singulate_planner::plan::{Answer, Statistics, nothing_in_time};

use super::{clearing, tray, wanting};
use crate::hard::hard;
use crate::host::{Host, raw_post};
use crate::jobs::crowded;

/// A service whose planner always comes too late.
async fn late() -> Host {
    let engine = Engine {
        plan: |request, _, _| {
            Ok(Answer { statement: nothing_in_time(&request.scene), statistics: Statistics::default() }.into())
        },
        ..Engine::default()
    };
    Host::with(ServerSettings::default(), engine).await
}

#[tokio::test]
async fn an_answer_that_comes_too_late_can_be_stated_too() {
    let host = late().await;
    let wide = {
        let mut scene = clearing();
        scene["gripper"]["max_opening"] = json!(0.1);
        scene
    };
    for (scene, verdict, left) in [
        (crowded(), "timed_out", None),
        (wanting(crowded(), json!({"any_of": ["cup", "plate-1"]}), Value::Null), "timed_out", None),
        (wanting(crowded(), json!({"all_of": ["cup"]}), tray()), "timed_out", None),
        (clearing(), "partly_cleared", Some(json!(["cup", "plate-1", "plate-2", "plate-3"]))),
        (wide, "partly_cleared", Some(json!(["cup", "plate-1", "plate-2", "plate-3"]))),
    ] {
        let answer = host.post("/v1/plans", &scene).await.json();
        assert_eq!((&answer["verdict"], answer.get("left")), (&json!(verdict), left.as_ref()), "{answer}");
        assert_eq!(answer["target"], scene["target"], "null where the goal has no one target");
        assert_eq!(answer.get("proven"), left.map(|_| json!(false)).as_ref());
        let verification = host.post("/v1/plans/verify", &json!({"scene": scene, "plan": answer})).await.json();
        assert_eq!(verification["valid"], true, "{verification}");
    }
}

#[tokio::test]
async fn a_scene_too_large_to_be_read_has_a_verdict_unless_its_answer_names_what_is_left() {
    // Somebody holds the only thread, so that the reading is late on any machine.
    let settings = ServerSettings { threads: 1, ..ServerSettings::default() };
    let host = Host::with(settings, Engine::default()).await;
    let holder = host.raw(&raw_post("/v1/survey", &hard(60_000)));
    tokio::time::sleep(Duration::from_millis(300)).await;
    for (goal, told) in [
        (json!({"any_of": ["d0", "d1"]}), true),
        (json!({"all_of": ["d0", "d1"]}), true),
        (json!({"clear": true}), false),
    ] {
        let reply = host.post("/v1/plans", &wanting(hard(1), goal.clone(), tray())).await;
        if told {
            let answer = reply.json();
            assert_eq!((reply.status, &answer["verdict"], &answer["target"]), (200, &json!("timed_out"), &Value::Null));
            assert_eq!((&answer["lower_bound"], &answer["landmarks"]), (&json!(0), &json!([])), "{goal}");
        } else {
            reply.is_problem(503, "overloaded");
        }
    }
    let mut narrow = clearing();
    narrow["gripper"]["max_opening"] = json!(0.1);
    narrow["settings"] = json!({"time_limit_ms": 50});
    let survey = host.post("/v1/survey", &narrow).await.json();
    assert_eq!(survey["objects"].as_array().unwrap().len(), 1, "plates are too wide: {survey}");
    assert_eq!((&survey["objects"][0]["id"], &survey["objects"][0]["verdict"]), (&json!("cup"), &json!("timed_out")));
    drop(holder);
}
