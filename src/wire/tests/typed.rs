//! Both ways to read a body give the same request.

use proptest::prelude::*;
use proptest::sample::{select, subsequence};
use serde_json::{Value, json};

use super::edits::{EDITS, SOUND};
use super::{scene, with};
use crate::wire::{RequestLimits, job_request, request, statement, typed};

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
    assert!(typed::scene(SOUND.as_bytes(), &limits).is_some(), "every shape");
    let job = with("/priority", json!(-100));
    assert!(typed::job(job.to_string().as_bytes(), &limits).is_some());
    let verification = json!({"scene": scene(), "plan": 5}).to_string();
    assert!(typed::verification(verification.as_bytes(), &limits).is_some());
}
