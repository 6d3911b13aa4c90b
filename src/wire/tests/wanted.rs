//! What is wanted, and what can't be: what is read, and what is refused with which pointer.

use serde_json::{Value, json};

use super::{has_faults, read, scene, with, without};
use crate::wire::*;
use singulate_planner::scene::{Destination, Goal, Opening};

/// A tray that takes anything.
pub(super) fn tray() -> Value {
    json!([{"id": "tray"}])
}

/// The scene with this goal in place of its target, and a tray.
pub(super) fn wanting(goal: Value) -> Value {
    let mut body = without("/target");
    body["goal"] = goal;
    body["drop_offs"] = tray();
    body
}

/// The scene with a hand that opens so far.
fn opening(mut body: Value, max_opening: f64) -> Value {
    body["gripper"]["max_opening"] = json!(max_opening);
    body
}

#[track_caller]
pub(super) fn refuses(body: &Value, expected: &[(&str, &str)]) {
    let problem = read(&body.to_string()).expect_err("the body is faulty");
    has_faults(&problem, expected);
    assert_eq!(problem.status(), 422);
}

/// The codes and pointers of a sound body's warnings.
#[track_caller]
pub(super) fn warnings(body: &Value) -> Vec<(String, String)> {
    let items = read(&body.to_string()).unwrap().warnings;
    items.into_iter().map(|item| (item.code, item.pointer)).collect()
}

pub(super) fn pair(code: &str, pointer: &str) -> (String, String) {
    (code.to_owned(), pointer.to_owned())
}

#[test]
fn goals_drop_offs_and_openings_are_read() {
    let read = |body: &Value| read(&body.to_string()).unwrap().scene;
    let plain = read(&scene());
    assert_eq!((plain.destination(), plain.gripper().opening()), (Destination::Table, Opening::Fit));
    let ids = |objects: &[_], scene: &singulate_planner::scene::Scene| -> Vec<String> {
        objects.iter().map(|&object| scene.object(object).id().to_owned()).collect()
    };
    let any = read(&wanting(json!({"any_of": ["b", "a"]})));
    assert!(matches!(any.goal(), Goal::AnyOf(_)) && ids(any.goal().candidates(), &any) == ["a", "b"]);
    let all = read(&wanting(json!({"all_of": ["b"]})));
    assert!(matches!(all.goal(), Goal::AllOf(_)) && ids(all.goal().wanted_away(), &all) == ["b"]);
    assert_eq!(all.destination(), Destination::TableThenDropOff);
    let mut body = opening(wanting(json!({"clear": true})), 0.2);
    body["gripper"]["opening"] = json!("full");
    body["drop_offs"] = json!([{"id": "tray", "capacity": 4.0, "accepts": ["a"]}, {"id": "bin"}]);
    body["settings"] = json!({"destination": "drop_off"});
    let clear = read(&body);
    assert_eq!((clear.goal(), clear.destination()), (&Goal::Clear, Destination::DropOff));
    assert_eq!((clear.gripper().opening(), clear.gripper().max_opening()), (Opening::Full, Some(0.2)));
    let [tray, bin] = clear.drop_offs() else { panic!("two drop-offs") };
    assert_eq!((tray.id(), tray.capacity(), tray.accepts().map(<[_]>::len)), ("tray", Some(4), Some(1)));
    assert_eq!((bin.id(), bin.capacity(), bin.accepts()), ("bin", None, None));
}

#[test]
fn null_stands_for_a_field_that_is_absent() {
    let read = |body: &Value| format!("{:?}", read(&body.to_string()).unwrap().scene);
    for pointer in ["/goal", "/drop_offs", "/gripper/max_opening", "/gripper/opening"] {
        assert_eq!(read(&with(pointer, Value::Null)), read(&scene()), "{pointer}");
    }
    let settings = json!({"destination": null});
    assert_eq!(read(&with("/settings", settings)), read(&scene()));
    let nulls = with("/drop_offs", json!([{"id": "tray", "capacity": null, "accepts": null}]));
    assert_eq!(read(&nulls), read(&with("/drop_offs", tray())));
    let mut body = wanting(json!({"any_of": ["a"], "all_of": null, "clear": null}));
    body["target"] = Value::Null;
    assert_eq!(read(&body), read(&wanting(json!({"any_of": ["a"]}))));
}

#[test]
fn either_a_target_or_a_goal_is_there() {
    refuses(&without("/target"), &[("missing", "/target")]);
    refuses(&with("/target", Value::Null), &[("wrong_type", "/target")]);
    for goal in [json!({"any_of": ["a"]}), json!({"all_of": ["a"]}), json!({"clear": true})] {
        let mut both = wanting(goal);
        assert!(read(&both.to_string()).is_ok());
        both["target"] = json!("a");
        refuses(&both, &[("conflicting_fields", "/goal")]);
    }
}

#[test]
fn a_goal_has_one_kind() {
    for (goal, expected) in [
        (json!({}), &[("missing", "/goal")][..]),
        (json!({"any_of": null}), &[("missing", "/goal")]),
        (json!({"any_of": ["a"], "all_of": ["a"]}), &[("conflicting_fields", "/goal")]),
        (json!({"any_of": ["a"], "clear": true}), &[("conflicting_fields", "/goal")]),
        (json!({"some_of": ["a"]}), &[("unknown_field", "/goal/some_of"), ("missing", "/goal")]),
        (json!({"clear": true, "keep": ["a"]}), &[("unknown_field", "/goal/keep")]),
        (json!({"clear": false}), &[("unknown_value", "/goal/clear")]),
        (json!({"clear": 1}), &[("wrong_type", "/goal/clear")]),
        (json!({"any_of": "a"}), &[("wrong_type", "/goal/any_of")]),
        (json!({"all_of": ["a", 1, null]}), &[("wrong_type", "/goal/all_of/1"), ("wrong_type", "/goal/all_of/2")]),
        (json!(["a"]), &[("wrong_type", "/goal")]),
        (json!("clear"), &[("wrong_type", "/goal")]),
    ] {
        refuses(&wanting(goal), expected);
    }
}

#[test]
fn a_list_of_the_goal_names_movable_objects_once_each() {
    for kind in ["any_of", "all_of"] {
        let at = |index: usize| format!("/goal/{kind}/{index}");
        for (ids, code, pointer) in [
            (json!([]), "empty_list", format!("/goal/{kind}")),
            (json!(["a", "nobody"]), "unknown_target", at(1)),
            (json!(["a", "b", "a"]), "duplicate_id", at(2)),
            (json!(["vase", "a"]), "fixed_target", at(0)),
            (json!(["a", "x".repeat(129)]), "id_length", at(1)),
        ] {
            refuses(&wanting(json!({kind: ids})), &[(code, &pointer)]);
        }
        let all = json!({kind: ["vase", "nobody"]});
        refuses(&wanting(all), &[("fixed_target", &at(0)), ("unknown_target", &at(1))]);
    }
}

#[test]
fn what_is_taken_away_needs_a_drop_off_that_accepts_it() {
    for goal in [json!({"all_of": ["a"]}), json!({"clear": true})] {
        let mut body = wanting(goal);
        for none in [Value::Null, json!([])] {
            body["drop_offs"] = none;
            refuses(&body, &[("missing", "/drop_offs")]);
        }
    }
    let mut any = wanting(json!({"any_of": ["a"]}));
    any["drop_offs"] = Value::Null;
    assert_eq!(warnings(&any), []);
    let mut body = wanting(json!({"all_of": ["b", "a"]}));
    body["drop_offs"] = json!([{"id": "tray", "accepts": ["b"]}, {"id": "bin", "accepts": []}]);
    refuses(&body, &[("not_accepted", "/goal/all_of/1")]);
    body["goal"] = json!({"clear": true});
    assert_eq!(warnings(&body), [], "it stays, and the answer says so");
    body["goal"] = json!({"any_of": ["b", "a"]});
    assert_eq!(warnings(&body), [], "it is only grasped");
}

#[test]
fn what_is_too_wide_is_as_if_fixed_and_no_goal() {
    let wide = |object: usize| pair("too_wide", &format!("/objects/{object}"));
    let mut narrow = opening(scene(), 0.14);
    narrow["objects"][0]["radius"] = json!(0.07);
    assert_eq!(warnings(&narrow), [wide(1)], "as wide as the opening still fits, and a fixed one is never grasped");
    let narrow = |goal: Value| {
        let mut body = opening(wanting(goal), 0.14);
        body["objects"][0]["radius"] = json!(0.07);
        body
    };
    assert_eq!(warnings(&narrow(json!({"clear": true}))), [wide(1)]);
    assert_eq!(warnings(&narrow(json!({"any_of": ["a", "b"]}))), [wide(1)]);
    let request = read(&narrow(json!({"any_of": ["a", "b"]})).to_string()).unwrap();
    assert_eq!(request.scene.goal().candidates().len(), 1);
    refuses(&narrow(json!({"all_of": ["a", "b"]})), &[("too_wide", "/goal/all_of/1")]);
    refuses(&narrow(json!({"any_of": ["b"]})), &[("too_wide", "/goal/any_of")]);
    refuses(&opening(scene(), 0.14), &[("too_wide", "/target")]);
}

#[test]
fn the_plan_of_another_goal_is_a_mismatch() {
    let mismatch = |goal: Value, target: &str| {
        let plan = json!({"relocations": [], "verdict": "relocate", "target": target});
        let both = json!({"scene": wanting(goal), "plan": plan}).to_string();
        read_verify(both.as_bytes(), &RequestLimits::default())
    };
    for (goal, target) in [
        (json!({"any_of": ["a"]}), "b"),
        (json!({"any_of": ["a", "b"]}), "vase"),
        (json!({"all_of": ["a"]}), "a"),
        (json!({"clear": true}), "a"),
    ] {
        has_faults(&mismatch(goal, target).unwrap_err(), &[("target_mismatch", "/plan/target")]);
    }
    let stated = mismatch(json!({"any_of": ["a", "b"]}), "b").unwrap().statement;
    assert_eq!(stated.target.as_deref(), Some("b"));
}

#[test]
fn a_written_scene_reads_as_the_same_scene_whatever_is_wanted() {
    for goal in [json!({"any_of": ["b", "a"]}), json!({"all_of": ["b"]}), json!({"clear": true}), Value::Null] {
        for destination in [None, Some("table"), Some("drop_off"), Some("table_then_drop_off")] {
            let mut body = opening(wanting(goal.clone()), 0.2);
            if goal.is_null() {
                body["target"] = json!("a");
            }
            body["gripper"]["opening"] = json!("full");
            body["drop_offs"] = json!([{"id": "tray", "capacity": 7, "accepts": ["b", "a"]}, {"id": "bin"}]);
            body["settings"] = json!({"destination": destination});
            let request = read(&body.to_string()).unwrap();
            let written = serde_json::to_string(&SceneBody::new(&request.scene, Some("again"))).unwrap();
            let again = read(&written).unwrap();
            assert_eq!(format!("{:?}", again.scene), format!("{:?}", request.scene), "{written}");
        }
    }
}
