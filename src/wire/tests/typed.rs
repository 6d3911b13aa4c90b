//! Both ways to read a body give the same request.

use proptest::prelude::*;
use proptest::sample::{select, subsequence};
use serde_json::{Value, json};

use super::{scene, with};
use crate::wire::{RequestLimits, job_request, request, statement, typed};

pub(super) const SOUND: &str = r#"{"scene_id": "cell", "table": {"x_min": 0, "y_min": 0, "x_max": 1.2, "y_max": 0.7,
 "keep_out": [{"x_min": 0, "y_min": 0, "x_max": 0.2, "y_max": 0.1}]},
 "gripper": {"fingers": 3, "finger_width": 0.02, "clearance": 0.05, "margin": 0, "yaw_tolerance": 0.01,
 "max_opening": 0.16, "opening": "fit"},
 "objects": [{"id": "a", "x": 0.3, "y": 0.2, "radius": 0.075}, {"id": "b", "x": 0.6, "y": 0.2, "radius": 0.075, "fixed": true}],
 "target": "a", "drop_offs": [{"id": "tray", "capacity": 4, "accepts": ["a", "gone"]}, {"id": "bin"}],
 "settings": {"objective": "short_moves", "destination": "drop_off", "time_limit_ms": 20, "overlap_tolerance": 0.002}}"#;

/// What may stand in place of something else: unusual and sound, or faulty.
pub(super) const EDITS: [(&str, &str); 99] = [
    ("0.3", "-0.0"),
    ("0.3", "-0"),
    ("0.3", "0.30000000000000004441"),
    ("0.3", "3E-1"),
    ("0.3", "1e999"),
    ("0.3", "1e-999"),
    ("0.3", "null"),
    ("0.3", "\"0.3\""),
    ("0.3", "NaN"),
    ("0.3", r#"{"$serde_json::private::Number": "0.3"}"#),
    ("0.3", r#"{"$serde_json::private::RawValue": "0.3"}"#),
    ("\"a\"", r#"{"$serde_json::private::RawValue": "\"a\""}"#),
    ("{\"objective\"", r#"{"$serde_json::private::RawValue": "{}", "objective""#),
    ("1.2", "9007199254740993"),
    ("1.2", "18446744073709551617"),
    ("1.2", "99999.99999999999999"),
    ("1.2", "1"),
    ("\"a\"", "\"\""),
    ("\"a\"", r#""\ud83d\ude00""#),
    ("\"a\"", r#""\ud83d""#),
    ("\"a\"", r#""\u0000\/""#),
    ("\"a\"", "5"),
    ("\"cell\"", "null"),
    ("\"cell\"", "[]"),
    ("\"fixed\": true", "\"fixed\": null"),
    ("\"fixed\": true", "\"fixed\": 1"),
    ("\"fixed\": true", "\"fixed\": false, \"fixed\": true"),
    ("\"fixed\": true", "\"shape\": null"),
    (r#"{"id": "a", "x": 0.3, "y": 0.2, "radius": 0.075}"#, r#"["a", 0.3, 0.2, 0.075, null]"#),
    (r#"{"x_min": 0, "y_min": 0, "x_max": 0.2, "y_max": 0.1}"#, "[0, 0, 0.2, 0.1]"),
    (r#"{"x_min": 0, "y_min": 0, "x_max": 0.2, "y_max": 0.1}"#, "null"),
    ("\"fingers\": 3", "\"fingers\": 3.0"),
    ("\"fingers\": 3", "\"fingers\": 3.5"),
    ("\"fingers\": 3", "\"fingers\": true"),
    ("\"margin\": 0", "\"margin\": null"),
    ("\"margin\": 0", "\"margin\": -1"),
    ("\"margin\": 0", "\"margins\": 0"),
    ("\"margin\": 0, ", ""),
    ("\"x\": 0.6, ", ""),
    ("\"target\": \"a\", ", ""),
    ("\"target\": \"a\", ", "\"target\": \"a\", \"target\": \"b\", "),
    ("\"target\": \"a\", ", r#""target": "a", "\u0074arget": "b", "#),
    ("\"target\": \"a\", ", "\"target\": \"a\", \"priority\": 3, \"callback_url\": null, "),
    ("\"target\": \"a\", ", "\"target\": \"a\", \"priority\": 101, \"callback_url\": \"http://a\", "),
    ("\"short_moves\"", "{\"short_moves\": null}"),
    ("20", "20.0"),
    ("20", "0"),
    ("0.002", "0.5"),
    (r#""target": "a", "#, r#""goal": {"any_of": ["a"]}, "#),
    (r#""target": "a", "#, r#""goal": {"all_of": ["a"]}, "target": null, "#),
    (r#""target": "a", "#, r#""goal": {"clear": true}, "#),
    (r#""target": "a", "#, r#""goal": {"clear": false}, "#),
    (r#""target": "a", "#, r#""goal": {"clear": 1}, "#),
    (r#""target": "a", "#, r#""goal": {}, "#),
    (r#""target": "a", "#, r#""goal": null, "#),
    (r#""target": "a", "#, r#""goal": [["a"]], "#),
    (r#""target": "a", "#, r#""goal": {"any_of": ["a"], "clear": null}, "#),
    (r#""target": "a", "#, r#""goal": {"any_of": ["a"], "all_of": ["a"]}, "#),
    (r#""target": "a", "#, r#""goal": {"any_of": ["a"], "any_of": ["a"]}, "#),
    (r#""target": "a", "#, r#""goal": {"any_of": ["a", "a"]}, "#),
    (r#""target": "a", "#, r#""goal": {"any_of": ["a", null]}, "#),
    (r#""target": "a", "#, r#""goal": {"any_of": []}, "#),
    (r#""target": "a", "#, r#""goal": {"all_of": ["b", "gone"]}, "#),
    (r#""target": "a", "#, r#""goal": {"some_of": ["a"]}, "#),
    (r#""target": "a", "#, r#""goal": {"$serde_json::private::RawValue": "{\"clear\": true}"}, "#),
    (r#""target": "a", "#, r#""target": "a", "goal": {"clear": true}, "#),
    (r#""target": "a", "#, r#""target": "a", "goal": null, "#),
    (r#""capacity": 4"#, r#""capacity": 4.0"#),
    (r#""capacity": 4"#, r#""capacity": 4.5"#),
    (r#""capacity": 4"#, r#""capacity": 0"#),
    (r#""capacity": 4"#, r#""capacity": 1e10"#),
    (r#""capacity": 4"#, r#""capacity": "4""#),
    (r#""capacity": 4"#, r#""capacity": null"#),
    (r#""capacity": 4"#, r#""capacity": 4, "capacity": 5"#),
    (r#"["a", "gone"]"#, "null"),
    (r#"["a", "gone"]"#, "[]"),
    (r#"["a", "gone"]"#, r#"["a", "a"]"#),
    (r#"["a", "gone"]"#, r#"["a", null]"#),
    (r#"["a", "gone"]"#, r#""a""#),
    (r#"{"id": "bin"}"#, r#"{"id": "tray"}"#),
    (r#"{"id": "bin"}"#, r#"{"id": ""}"#),
    (r#"{"id": "bin"}"#, "{}"),
    (r#"{"id": "bin"}"#, r#"["bin", 4, null]"#),
    (r#"{"id": "bin"}"#, r#"{"id": "bin", "depth": 1}"#),
    (r#"[{"id": "tray", "capacity": 4, "accepts": ["a", "gone"]}, {"id": "bin"}]"#, "null"),
    (r#"[{"id": "tray", "capacity": 4, "accepts": ["a", "gone"]}, {"id": "bin"}]"#, "[]"),
    (r#""max_opening": 0.16"#, r#""max_opening": null"#),
    (r#""max_opening": 0.16"#, r#""max_opening": 0.1"#),
    (r#""max_opening": 0.16"#, r#""max_opening": 0"#),
    (r#""max_opening": 0.16, "opening": "fit""#, r#""opening": "full""#),
    (r#""fit""#, r#""full""#),
    (r#""fit""#, r#""wide""#),
    (r#""fit""#, "null"),
    (r#""fit""#, r#"{"fit": null}"#),
    (r#""drop_off""#, r#""table_then_drop_off""#),
    (r#""drop_off""#, r#""tray""#),
    (r#""drop_off""#, "null"),
    (r#""objective""#, r#""search": "lobs", "objective""#),
    ("}}", "}} x"),
];

fn agree<T: core::fmt::Debug, E: core::fmt::Debug>(quick: Option<T>, walked: Result<T, E>, body: &str) {
    if let Some(quick) = quick {
        assert_eq!(format!("{quick:?}"), format!("{:?}", walked.expect("sound")), "{body}");
    }
}

fn compare(scene: &str) {
    let limits = RequestLimits::default();
    agree(request::sound(scene.as_bytes(), &limits), request::walked(scene.as_bytes(), &limits), scene);
    agree(job_request::sound(scene.as_bytes(), &limits), job_request::walked(scene.as_bytes(), &limits), scene);
    let body =
        format!(r#"{{"plan": {{"relocations": [], "target_grasp": {{"yaw": 1}}, "target": "a"}}, "scene": {scene}}}"#);
    agree(statement::sound(body.as_bytes(), &limits), statement::walked(body.as_bytes(), &limits), &body);
}

proptest! {
    #[test]
    fn typed_reading_and_the_walk_agree_on_edited_bodies(edits in subsequence(&EDITS[..], 0..=3)) {
        let mut body = SOUND.to_owned();
        for (old, new) in edits {
            body = body.replacen(old, new, 1);
        }
        compare(&body);
    }

    #[test]
    fn typed_reading_and_the_walk_agree_on_damaged_bodies(at in 0..SOUND.len(), byte in select(&b"{}[]\":,.eE-+0123456789 \\unl"[..]), lose: bool) {
        let mut body = SOUND.as_bytes().to_vec();
        if lose { body.remove(at); } else { body[at] = byte; }
        compare(&String::from_utf8(body).expect("ASCII"));
    }

}

#[test]
fn each_edit_alone() {
    compare(SOUND);
    for (old, new) in EDITS {
        assert!(SOUND.contains(old), "{old}");
        compare(&SOUND.replacen(old, new, 1));
    }
}

#[test]
fn a_plan_is_nested_as_deep_as_its_body_may_be() {
    for deep in 120..135 {
        let nested = format!("{}{}", "[".repeat(deep), "]".repeat(deep));
        let plan = format!(r#"{{"relocations": [], "target_grasp": {{"yaw": 1}}, "statistics": {{"\"[": {nested}}}}}"#);
        let body = format!(r#"{{"plan": {plan}, "scene": {SOUND}}}"#);
        let limits = RequestLimits::default();
        let (quick, walked) = (statement::sound(body.as_bytes(), &limits), statement::walked(body.as_bytes(), &limits));
        assert_eq!(quick.is_some(), walked.is_ok(), "{deep}");
    }
}

#[test]
fn the_terms_of_a_verification_are_read_alike() {
    let limits = RequestLimits::default();
    for (terms, sound) in [
        (r#""position_tolerance": 0.002, "partial": true, "#, true),
        (r#""position_tolerance": null, "partial": true, "#, true),
        (r#""position_tolerance": 1, "partial": true, "#, true),
        (r#""position_tolerance": -0.0, "partial": true, "#, true),
        (r#""position_tolerance": 1.0000001, "partial": true, "#, false),
        (r#""position_tolerance": -1e-9, "partial": true, "#, false),
        (r#""position_tolerance": 1e999, "partial": true, "#, false),
        (r#""position_tolerance": NaN, "partial": true, "#, false),
        (r#""position_tolerance": 0, "partial": 1, "#, false),
        (r#""partial": true, "partial": true, "#, false),
        (r#""partial": false, "#, false),
        (r#""partial": null, "#, false),
        ("", false),
    ] {
        let body = format!(r#"{{{terms}"plan": {{"relocations": []}}, "scene": {SOUND}}}"#);
        let (quick, walked) = (statement::sound(body.as_bytes(), &limits), statement::walked(body.as_bytes(), &limits));
        assert_eq!((quick.is_some(), walked.is_ok()), (sound, sound), "{terms}");
        agree(quick, walked, &body);
    }
}

/// Else all would be read the long way, and no test would tell.
#[test]
fn valid_bodies_are_read_into_types_directly() {
    let limits = RequestLimits::default();
    let with_settings = with("/settings", json!({"search": "lobs", "placement": "raster", "time_limit_ms": 20.0}));
    for body in [scene(), with_settings, with("/settings", Value::Null), with("/table/keep_out", Value::Null)] {
        assert!(typed::scene(body.to_string().as_bytes(), &limits).is_some(), "{body}");
    }
    let tray =
        json!([{"id": "tray", "capacity": 4.0, "accepts": ["a"]}, {"id": "bin", "capacity": null, "accepts": null}]);
    for goal in
        [json!({"any_of": ["a", "b"]}), json!({"all_of": ["a"], "clear": null}), json!({"clear": true}), Value::Null]
    {
        let mut body = with("/goal", goal.clone());
        body["drop_offs"] = tray.clone();
        body["gripper"]["max_opening"] = json!(0.16);
        body["gripper"]["opening"] = json!("full");
        body["settings"] = json!({"destination": "drop_off"});
        if !goal.is_null() {
            body["target"] = Value::Null;
        }
        assert!(typed::scene(body.to_string().as_bytes(), &limits).is_some(), "{body}");
    }
    let job = with("/priority", json!(-100));
    assert!(typed::job(job.to_string().as_bytes(), &limits).is_some());
    let verification = json!({"scene": scene(), "plan": 5}).to_string();
    assert!(typed::verification(verification.as_bytes(), &limits).is_some());
}
