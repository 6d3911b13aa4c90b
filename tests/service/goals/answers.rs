//! The answer to each goal: its form, and that it can be stated as it was served.

use serde_json::{Value, json};

use super::{clearing, example, tray, wanting};
use crate::document::COMMITTED;
use crate::host::Host;
use crate::jobs::crowded;
use crate::schema::faults;

const VALID: &str = r#"{"valid":true,"faults":[],"first_failing_step":null,"replan":false}"#;

/// What a deadlock does not have, a target apart.
const LOCKED: [&str; 6] = ["target_grasp", "cost", "lower_bound", "optimal", "landmarks", "needed"];
/// What a clearing does not have.
const CLEARED: [&str; 7] = ["target", "target_grasp", "lower_bound", "optimal", "landmarks", "deadlock", "needed"];

/// A scene with the verdict and the nulls of its answer.
struct Case {
    scene: Value,
    verdict: &'static str,
    nulls: Vec<&'static str>,
}

fn case(scene: Value, verdict: &'static str, nulls: &[&[&'static str]]) -> Case {
    let mut nulls = nulls.concat();
    nulls.sort_unstable();
    Case { scene, verdict, nulls }
}

/// Each kind of goal with each of its verdicts but `timed_out`.
fn cases() -> Vec<Case> {
    let any = |ids: &[&str]| json!({"any_of": ids});
    let all = |ids: &[&str]| json!({"all_of": ids});
    let one = json!([{"id": "tray", "capacity": 1}]);
    let mut dropped = crowded();
    dropped["drop_offs"] = tray();
    dropped["settings"] = json!({"destination": "drop_off"});
    let mut short = dropped.clone();
    short["drop_offs"] = one.clone();
    let mut full = example("no-space");
    full["drop_offs"] = tray();
    let no_space = wanting(example("no-space"), any(&[full["target"].as_str().unwrap()]), Value::Null);
    let no_places = ["target_grasp", "cost", "optimal", "deadlock"];
    let mut wide = clearing();
    wide["gripper"]["max_opening"] = json!(0.1);
    let mut stuck = wanting(example("deadlock"), json!({"clear": true}), tray());
    let far = json!({"id": "far", "x": stuck["table"]["x_max"], "y": stuck["table"]["y_max"], "radius": 0.01});
    stuck["objects"].as_array_mut().unwrap().push(far);
    let mut empty = clearing();
    empty["objects"] = json!([]);
    let only_cups = json!([{"id": "sink", "accepts": ["cup"]}]);
    vec![
        case(dropped, "relocate", &[&["deadlock", "needed"]]),
        case(short, "no_space", &[&no_places]),
        case(full, "relocate", &[&["deadlock", "needed"]]),
        case(wanting(crowded(), any(&["cup", "plate-3"]), Value::Null), "graspable", &[&["deadlock", "needed"]]),
        case(wanting(crowded(), any(&["cup", "plate-1"]), Value::Null), "relocate", &[&["deadlock", "needed"]]),
        case(wanting(example("deadlock"), any(&["cup", "plate-1"]), tray()), "deadlock", &[&LOCKED, &["target"]]),
        case(no_space, "no_space", &[&no_places]),
        case(
            wanting(crowded(), all(&["cup", "plate-1"]), tray()),
            "relocate",
            &[&["target", "target_grasp", "deadlock", "needed"]],
        ),
        case(wanting(example("deadlock"), all(&["plate-1"]), tray()), "deadlock", &[&LOCKED, &["target"]]),
        case(wanting(crowded(), all(&["cup", "plate-1"]), one.clone()), "no_space", &[&no_places, &["target"]]),
        case(clearing(), "cleared", &[&CLEARED, &["stuck"]]),
        case(empty, "cleared", &[&CLEARED, &["stuck"]]),
        case(wanting(crowded(), json!({"clear": true}), one), "partly_cleared", &[&CLEARED, &["stuck"]]),
        case(wanting(crowded(), json!({"clear": true}), only_cups), "partly_cleared", &[&CLEARED]),
        case(wide, "partly_cleared", &[&CLEARED]),
        case(stuck, "partly_cleared", &[&CLEARED]),
        case(unproven(), "partly_cleared", &[&CLEARED, &["stuck"]]),
    ]
}

/// So many objects that not every order is tried, and a small drop-off that the wrong one fills.
fn unproven() -> Value {
    let mut scene = crowded();
    scene["table"]["x_max"] = json!(4);
    let objects = scene["objects"].as_array_mut().unwrap();
    objects.push(json!({"id": "first", "x": 0.03, "y": 0.03, "radius": 0.02}));
    objects.extend(
        (0..20).map(|n| json!({"id": format!("d{n}"), "x": 1.0 + 0.14 * f64::from(n), "y": 0.2, "radius": 0.02})),
    );
    let ids = objects.iter().map(|object| object["id"].clone()).filter(|id| id != "plate-2" && id != "first");
    let bin = json!({"id": "bin", "accepts": ids.collect::<Vec<_>>()});
    let small = json!({"id": "small", "capacity": 1, "accepts": ["plate-2", "first"]});
    wanting(scene, json!({"clear": true}), json!([bin, small]))
}

async fn verified(host: &Host, scene: &Value, plan: &Value) -> String {
    host.post("/v1/plans/verify", &json!({"scene": scene, "plan": plan})).await.text
}

#[tokio::test]
async fn the_answer_to_every_goal_has_its_form_and_can_be_stated_as_it_was_served() {
    let host = Host::start().await;
    let document: Value = serde_json::from_str(COMMITTED).unwrap();
    let schema = |name: &str| &document["components"]["schemas"][name];
    for Case { scene, verdict, nulls } in cases() {
        let reply = host.post("/v1/plans", &scene).await;
        let answer = reply.json();
        assert_eq!((reply.status, &answer["verdict"]), (200, &json!(verdict)), "{scene}: {answer}");
        let fields = answer.as_object().unwrap();
        let mut absent: Vec<&str> = fields.keys().filter(|name| answer[*name].is_null()).map(String::as_str).collect();
        absent.sort_unstable();
        assert_eq!(absent, nulls, "{answer}");
        let clears = scene["goal"]["clear"] == true;
        assert!(["stuck", "left", "proven"].iter().all(|name| fields.contains_key(*name) == clears), "{answer}");
        let stated = json!({"scene": scene, "plan": answer});
        assert_eq!(faults(&document, schema("SceneBody"), &scene, "scene"), [""; 0]);
        assert_eq!(faults(&document, schema("AnswerBody"), &answer, "answer"), [""; 0]);
        assert_eq!(faults(&document, schema("VerifyBody"), &stated, ""), [""; 0]);
        assert_eq!(verified(&host, &scene, &answer).await, VALID, "{answer}");
        // Null stands for absent, and the other way round.
        let mut short = answer.clone();
        short.as_object_mut().unwrap().retain(|_, value| !value.is_null());
        assert_eq!(verified(&host, &scene, &short).await, VALID, "{short}");
        let mut long = answer.clone();
        for name in ["stuck", "left", "proven"] {
            long.as_object_mut().unwrap().entry(name).or_insert(Value::Null);
        }
        assert_eq!(verified(&host, &scene, &long).await, VALID, "{long}");
    }
}

#[tokio::test]
async fn every_goal_is_drawn() {
    let host = Host::start().await;
    let headers = [("content-type", "application/json"), ("accept", "image/svg+xml")];
    for Case { scene, .. } in cases() {
        let reply = host.post_with("/v1/plans", &headers, scene.to_string()).await;
        assert_eq!((reply.status, reply.header("content-type")), (200, "image/svg+xml"), "{reply:?}");
        assert!(reply.text.starts_with("<svg") && reply.text.trim_end().ends_with("</svg>"));
    }
}

#[tokio::test]
async fn the_cheapest_of_several_is_the_target() {
    let host = Host::start().await;
    let costs = [("cup", 2), ("plate-1", 1), ("plate-3", 0)];
    for (id, cost) in costs {
        let mut scene = crowded();
        scene["target"] = json!(id);
        let alone = host.post("/v1/plans", &scene).await.json();
        assert_eq!(alone["cost"], cost, "{id}");
        let cheaper: Vec<&str> = costs.iter().filter(|(_, other)| *other >= cost).map(|(id, _)| *id).collect();
        let any = host.post("/v1/plans", &wanting(crowded(), json!({"any_of": cheaper}), Value::Null)).await.json();
        assert_eq!((&any["target"], &any["cost"], &any["optimal"]), (&json!(id), &json!(cost), &json!(true)), "{any}");
        // What is stated of another target is not taken for it.
        let stated = json!({"relocations": any["relocations"], "target_grasp": any["target_grasp"], "target": id});
        let wanted = wanting(crowded(), json!({"any_of": cheaper}), Value::Null);
        assert_eq!(verified(&host, &wanted, &stated).await, VALID);
    }
}

#[tokio::test]
async fn a_deadlock_of_several_holds_all_of_them() {
    let host = Host::start().await;
    let any = wanting(example("deadlock"), json!({"any_of": ["plate-4", "cup"]}), Value::Null);
    let deadlock = &host.post("/v1/plans", &any).await.json()["deadlock"];
    for lock in ["blocked", "core"] {
        let ids = deadlock[lock].as_array().unwrap();
        assert!(ids.contains(&json!("cup")) && ids.contains(&json!("plate-4")), "{deadlock}");
    }
}

#[tokio::test]
async fn a_clearing_says_what_stays_and_whether_more_could_go() {
    let host = Host::start().await;
    let said = async |scene: &Value| {
        let answer = host.post("/v1/plans", scene).await.json();
        let dropped = answer["relocations"].as_array().unwrap().iter().map(|step| {
            assert_eq!(step["action"], "pick_drop");
            (step["object"].as_str().unwrap().to_owned(), step["drop_off"].as_str().unwrap().to_owned())
        });
        let dropped: Vec<_> = dropped.collect();
        assert_eq!(answer["cost"], dropped.len(), "{answer}");
        (dropped, answer["left"].clone(), answer["proven"].clone())
    };
    let (dropped, left, proven) = said(&clearing()).await;
    assert!(dropped.len() == 4 && dropped.iter().all(|(_, at)| at == "tray"), "{dropped:?}");
    assert_eq!((left, proven), (json!([]), json!(true)), "what is fixed is not named");
    let two = json!([{"id": "tray", "capacity": 1, "accepts": ["plate-2"]}, {"id": "bin", "capacity": 1}]);
    let (dropped, left, proven) = said(&wanting(crowded(), json!({"clear": true}), two)).await;
    assert!(dropped.len() == 2 && dropped.contains(&("plate-2".to_owned(), "tray".to_owned())), "{dropped:?}");
    assert_eq!((left.as_array().unwrap().len(), proven), (2, json!(true)));
    let (dropped, left, proven) = said(&unproven()).await;
    assert_eq!(dropped.first(), Some(&("first".to_owned(), "small".to_owned())));
    assert_eq!((left, proven), (json!(["cup", "plate-1", "plate-2"]), json!(false)));
}
