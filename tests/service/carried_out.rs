//! A plan that is being carried out: what is left of it is verified after each move, on the table as it is seen then.

use serde_json::{Value, json};

use crate::document::COMMITTED;
use crate::host::Host;
use crate::schema::faults;

/// What is left of an answer after so many of its steps.
fn left(answer: &Value, done: usize) -> Value {
    let mut left = answer.clone();
    left["relocations"].as_array_mut().unwrap().drain(..done);
    left
}

/// The scene after so many steps of the plan. Each object is seen up to `off` m beside its place, this way and that.
fn seen(scene: &Value, answer: &Value, done: usize, off: f64) -> Value {
    let mut seen = scene.clone();
    for step in &answer["relocations"].as_array().unwrap()[..done] {
        let object = object(&mut seen, step["object"].as_str().unwrap());
        (object["x"], object["y"]) = (step["to"]["x"].clone(), step["to"]["y"].clone());
    }
    for (number, object) in seen["objects"].as_array_mut().unwrap().iter_mut().enumerate() {
        let sign = if number.is_multiple_of(2) { 1.0 } else { -1.0 };
        object["x"] = json!(object["x"].as_f64().unwrap() + sign * off);
    }
    seen
}

fn object<'a>(scene: &'a mut Value, id: &str) -> &'a mut Value {
    scene["objects"].as_array_mut().unwrap().iter_mut().find(|object| object["id"] == id).unwrap()
}

/// A scene that takes several moves, and the answer to it.
async fn planned(host: &Host) -> (Value, Value) {
    let scene: Value = serde_json::from_str(include_str!("../../client-examples/scenes/mixed-sizes.json")).unwrap();
    let answer = host.post("/v1/plans", &scene).await.json();
    assert!(answer["cost"].as_u64().unwrap() >= 2, "{answer}");
    (scene, answer)
}

async fn verified(host: &Host, question: &Value) -> Value {
    let document = serde_json::from_str(COMMITTED).unwrap();
    assert_eq!(faults(&document, &json!({"$ref": "#/components/schemas/VerifyBody"}), question, ""), [""; 0]);
    let reply = host.post("/v1/plans/verify", question).await;
    assert_eq!(reply.status, 200, "{reply:?}");
    reply.json()
}

fn holds() -> Value {
    json!({"valid": true, "faults": [], "first_failing_step": null, "replan": false})
}

#[tokio::test]
async fn an_answer_is_verified_without_the_steps_that_were_carried_out() {
    let host = Host::start().await;
    let (scene, answer) = planned(&host).await;
    for done in 0..=answer["relocations"].as_array().unwrap().len() {
        let question = |off, terms: &Value| {
            let mut question = json!({"scene": seen(&scene, &answer, done, off), "plan": left(&answer, done)});
            question.as_object_mut().unwrap().extend(terms.as_object().unwrap().clone());
            question
        };
        let partial = json!({"partial": true});
        assert_eq!(verified(&host, &question(0.0, &partial)).await, holds(), "after {done} steps");
        let tolerant = json!({"partial": true, "position_tolerance": 0.001});
        assert_eq!(verified(&host, &question(5e-4, &tolerant)).await, holds(), "after {done} steps");
        let whole = verified(&host, &question(0.0, &json!({}))).await;
        assert_eq!(whole["valid"], done == 0, "cost and bound are those of the whole plan: {whole}");
        assert_eq!((&whole["first_failing_step"], &whole["replan"]), (&json!(null), &json!(false)), "{whole}");
    }
}

#[tokio::test]
async fn the_first_step_that_fails_is_told() {
    let host = Host::start().await;
    let (scene, answer) = planned(&host).await;
    let steps = answer["relocations"].as_array().unwrap().len();
    let terms = |scene: &Value, plan: &Value| json!({"scene": scene, "plan": plan, "partial": true, "position_tolerance": 0.002});
    // The object of the last step was pushed farther than the tolerance.
    let mut pushed = scene.clone();
    let last = &answer["relocations"][steps - 1];
    let there = object(&mut pushed, last["object"].as_str().unwrap());
    there["x"] = json!(there["x"].as_f64().unwrap() + 0.004);
    let report = verified(&host, &terms(&pushed, &answer)).await;
    let fault = report["faults"].as_array().unwrap().iter().find(|fault| fault["code"] == "wrong_from").unwrap();
    assert_eq!((&fault["step"], &fault["object"]), (&json!(steps - 1), &last["object"]));
    assert_eq!(report["replan"], true);
    // Nothing was moved, so the target is still blocked.
    let report = verified(&host, &terms(&scene, &left(&answer, steps))).await;
    assert_eq!((&report["first_failing_step"], &report["replan"]), (&json!(0), &json!(true)), "{report}");
    assert_eq!(report["faults"][0]["code"], "target_blocked");
}
