//! Every golden scene over HTTP: its verdict, the form of its answer, and the service's own check of it.

use serde::Deserialize;
use serde_json::value::RawValue;
use serde_json::{Value, json};

use crate::host::{Host, Reply};

#[derive(Deserialize)]
struct Case<'a> {
    name: String,
    #[serde(borrow)]
    scene: &'a RawValue,
    expected: Expected,
}

#[derive(Deserialize)]
struct Expected {
    verdict: String,
    relocations: Option<u64>,
}

fn cases() -> Vec<Case<'static>> {
    serde_json::from_str(include_str!("../golden/scenes.json")).unwrap()
}

/// The scene with a time limit that no machine exhausts.
fn unhurried(case: &Case<'_>) -> String {
    let mut scene: Value = serde_json::from_str(case.scene.get()).unwrap();
    scene["settings"] = json!({"time_limit_ms": 60_000});
    scene.to_string()
}

async fn post(host: &Host, path: &str, accept: &str, body: String) -> Reply {
    host.post_with(path, &[("content-type", "application/json"), ("accept", accept)], body).await
}

/// The names of an object's fields, in order.
fn names(value: &Value) -> Vec<&str> {
    value.as_object().unwrap_or_else(|| panic!("{value} is no object")).keys().map(String::as_str).collect()
}

/// The answer's fields that are null.
fn nulls(answer: &Value) -> Vec<&str> {
    names(answer).into_iter().filter(|name| answer[name].is_null()).collect()
}

const ANSWER: [&str; 13] = [
    "verdict",
    "scene_id",
    "target",
    "relocations",
    "target_grasp",
    "cost",
    "lower_bound",
    "optimal",
    "landmarks",
    "deadlock",
    "needed",
    "warnings",
    "statistics",
];

fn check_grasp(grasp: &Value, fingers: f64) {
    assert_eq!(names(grasp), ["x", "y", "yaw", "slack"]);
    let (yaw, slack) = (grasp["yaw"].as_f64().unwrap(), grasp["slack"].as_f64().unwrap());
    let half = core::f64::consts::PI / fingers;
    assert!((0.0..2.0 * half).contains(&yaw) && slack > 0.0 && slack <= half + 1e-12, "{grasp}");
}

fn check_step(step: &Value, fingers: f64) {
    assert_eq!(names(step), ["action", "object", "from", "to", "grasp", "release", "gap"]);
    assert_eq!(step["action"], "pick_place");
    for end in ["from", "to"] {
        assert_eq!(names(&step[end]), ["x", "y"]);
        assert!(step[end]["x"].is_f64() && step[end]["y"].is_f64(), "{step}");
    }
    check_grasp(&step["grasp"], fingers);
    check_grasp(&step["release"], fingers);
    assert!(step["gap"].as_f64().unwrap() >= 0.0, "{step}");
}

/// Names, order, types and nulls, as the interface promises them for the verdict.
fn check_form(answer: &Value, fingers: f64) {
    assert_eq!(names(answer), ANSWER);
    assert_eq!(names(&answer["statistics"]), ["knowledge_ms", "search_ms", "placement_ms", "check_ms"]);
    assert!(answer["target"].is_string() && answer["warnings"].is_array());
    let absent: &[&str] = match answer["verdict"].as_str().unwrap() {
        "graspable" | "relocate" => &["scene_id", "deadlock", "needed"],
        "deadlock" => &["scene_id", "target_grasp", "cost", "lower_bound", "optimal", "landmarks", "needed"],
        "no_space" => &["scene_id", "target_grasp", "cost", "optimal", "deadlock"],
        other => panic!("{other} in {answer}"),
    };
    assert_eq!(nulls(answer), absent, "{answer}");
    let steps = answer["relocations"].as_array().unwrap();
    assert_eq!(answer["verdict"] == "relocate", !steps.is_empty());
    steps.iter().for_each(|step| check_step(step, fingers));
    if !answer["target_grasp"].is_null() {
        assert_eq!(answer["cost"], steps.len());
        check_grasp(&answer["target_grasp"], fingers);
    }
    if !answer["deadlock"].is_null() {
        assert_eq!(names(&answer["deadlock"]), ["blocked", "core"]);
        assert!(answer["deadlock"]["core"].as_array().unwrap().contains(&answer["target"]));
    }
}

fn check_verdict(answer: &Value, expected: &Expected) {
    if answer["verdict"] == "no_space" {
        assert_eq!(expected.verdict, "relocate");
        assert!(answer["needed"].as_array().is_some_and(|needed| !needed.is_empty()), "{answer}");
    } else {
        assert_eq!(answer["verdict"], expected.verdict, "{answer}");
    }
    match expected.relocations.filter(|_| expected.verdict == "relocate") {
        Some(count) => assert_eq!(answer["lower_bound"], count, "{answer}"),
        None => assert!(answer["lower_bound"].is_null() || answer["lower_bound"] == 0, "{answer}"),
    }
    if answer["verdict"] == "relocate" {
        assert_eq!((&answer["cost"], &answer["optimal"]), (&json!(expected.relocations), &json!(true)), "{answer}");
    }
}

/// The text without what differs from run to run.
fn timeless(text: &str) -> &str {
    text.split_once("\"statistics\":").unwrap().0
}

#[tokio::test]
async fn every_golden_scene_is_answered_in_form_and_the_answer_holds() {
    let host = Host::start().await;
    for case in &cases() {
        eprintln!("{}", case.name);
        let body = unhurried(case);
        let reply = post(&host, "/v1/plans", "application/json", body.clone()).await;
        assert_eq!((reply.status, reply.header("content-type")), (200, "application/json"), "{reply:?}");
        let (answer, scene) = (reply.json(), serde_json::from_str::<Value>(&body).unwrap());
        assert_eq!(answer["target"], scene["target"]);
        check_form(&answer, scene["gripper"]["fingers"].as_f64().unwrap());
        check_verdict(&answer, &case.expected);
        let again = post(&host, "/v1/plans", "application/json", body.clone()).await;
        assert_eq!(timeless(&again.text), timeless(&reply.text));
        // As served, to the byte.
        let question = format!("{{\"scene\":{body},\"plan\":{}}}", reply.text);
        let verification = post(&host, "/v1/plans/verify", "application/json", question).await;
        assert_eq!(verification.text, r#"{"valid":true,"faults":[],"first_failing_step":null,"replan":false}"#);
    }
}

#[tokio::test]
async fn every_golden_scene_is_drawn() {
    let host = Host::start().await;
    for case in &cases() {
        let reply = post(&host, "/v1/plans", "image/svg+xml", unhurried(case)).await;
        assert_eq!((reply.status, reply.header("content-type")), (200, "image/svg+xml"), "{}", case.name);
        let objects = case.scene.get().matches("\"radius\"").count();
        assert!(reply.text.starts_with("<svg") && reply.text.trim_end().ends_with("</svg>"), "{}", case.name);
        assert!(reply.text.matches("<circle").count() >= objects, "{}", case.name);
    }
}

#[tokio::test]
async fn a_golden_scene_is_surveyed_in_order() {
    let host = Host::start().await;
    for case in cases().iter().take(10) {
        let scene: Value = serde_json::from_str(case.scene.get()).unwrap();
        let survey = post(&host, "/v1/survey", "*/*", unhurried(case)).await.json();
        assert_eq!(names(&survey), ["objects"]);
        let entries = survey["objects"].as_array().unwrap();
        let movable = scene["objects"].as_array().unwrap().iter().filter(|object| object["fixed"] != true);
        assert!(entries.iter().map(|entry| &entry["id"]).eq(movable.map(|object| &object["id"])), "{}", case.name);
        for entry in entries {
            assert_eq!(names(entry), ["id", "verdict", "lower_bound", "optimal"]);
            assert_eq!(entry["verdict"] == "deadlock", entry["lower_bound"].is_null() && entry["optimal"].is_null());
        }
        let target = entries.iter().find(|entry| entry["id"] == scene["target"]).unwrap();
        assert_eq!(target["verdict"], case.expected.verdict, "{}", case.name);
    }
}
