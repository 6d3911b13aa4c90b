//! What is refused on every path, and what makes no difference.

use serde_json::{Value, json};

use super::{clearing, tray, wanting};
use crate::document::COMMITTED;
use crate::host::Host;
use crate::jobs::crowded;
use crate::schema::faults;

#[tokio::test]
async fn a_faulty_goal_is_told_at_its_place_on_every_path() {
    let host = Host::start().await;
    let faulty = wanting(crowded(), json!({"all_of": ["cup", "nobody"]}), json!([{"id": "tray", "capacity": 0}]));
    let expected = ["/drop_offs/0/capacity", "/goal/all_of/1"];
    for path in ["/v1/plans", "/v1/survey", "/v1/knowledge", "/v1/jobs"] {
        let reply = host.post(path, &faulty).await;
        reply.is_problem(422, "invalid_request");
        assert_eq!(reply.pointers(), expected, "{path}");
    }
    let below = |parent: &str| expected.map(|pointer| format!("{parent}{pointer}"));
    let verify = json!({"scene": faulty, "plan": {"relocations": []}});
    assert_eq!(host.post("/v1/plans/verify", &verify).await.pointers()[..2], below("/scene"));
    let batch = json!({"scenes": [crowded(), faulty]});
    assert_eq!(host.post("/v1/jobs/batch", &batch).await.pointers(), below("/scenes/1"));
}

#[tokio::test]
async fn the_document_and_the_service_are_of_one_opinion_of_a_goal() {
    let host = Host::start().await;
    let document: Value = serde_json::from_str(COMMITTED).unwrap();
    let schema = &document["components"]["schemas"]["GoalBody"];
    for (goal, sound) in [
        (json!({"any_of": ["cup"]}), true),
        (json!({"all_of": ["cup", "plate-1"]}), true),
        (json!({"clear": true}), true),
        (json!({}), false),
        (json!({"any_of": []}), false),
        (json!({"any_of": ["cup"], "clear": true}), false),
        (json!({"some_of": ["cup"]}), false),
        (json!({"clear": "all"}), false),
    ] {
        assert_eq!(faults(&document, schema, &goal, "goal").is_empty(), sound, "{goal}");
        let status = host.post("/v1/plans", &wanting(crowded(), goal.clone(), tray())).await.status;
        assert_eq!(status, if sound { 200 } else { 422 }, "{goal}");
    }
}

#[tokio::test]
async fn survey_and_knowledge_are_the_same_for_every_goal() {
    let host = Host::start().await;
    let mut plain = crowded();
    plain["drop_offs"] = tray();
    for path in ["/v1/survey", "/v1/knowledge"] {
        let expected = host.post(path, &plain).await;
        assert_eq!(expected.status, 200, "{expected:?}");
        for goal in [json!({"any_of": ["cup", "plate-3"]}), json!({"all_of": ["plate-2"]}), json!({"clear": true})] {
            let reply = host.post(path, &wanting(crowded(), goal.clone(), tray())).await;
            assert_eq!(reply.text, expected.text, "{path} {goal}");
        }
    }
}

#[tokio::test]
async fn a_survey_leaves_out_what_can_not_be_grasped() {
    let host = Host::start().await;
    let surveyed = async |scene: &Value| {
        let objects = host.post("/v1/survey", scene).await.json()["objects"].as_array().unwrap().clone();
        objects.into_iter().map(|entry| (entry["id"].clone(), entry["verdict"].clone())).collect::<Vec<_>>()
    };
    let all = surveyed(&clearing()).await;
    assert_eq!(all.iter().map(|(id, _)| id).collect::<Vec<_>>(), ["cup", "plate-1", "plate-2", "plate-3"]);
    let mut narrow = clearing();
    narrow["gripper"]["max_opening"] = json!(0.119);
    // The plates are too wide, so they stay where they are.
    assert_eq!(surveyed(&narrow).await, [(json!("cup"), json!("deadlock"))]);
}
