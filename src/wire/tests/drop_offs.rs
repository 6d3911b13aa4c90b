//! Drop-offs and openings: what is refused with which pointer, and what is only warned of.

use serde_json::{Value, json};

use super::wanted::{pair, refuses, tray, wanting, warnings};
use super::{has_faults, read, with};
use crate::wire::*;

/// The scene with these drop-offs.
fn dropping(drop_offs: Value) -> Value {
    with("/drop_offs", drop_offs)
}

/// Puts the value in its place; a goal takes that of the target.
fn set(body: &mut Value, pointer: &str, value: Value) {
    let (parent, field) = pointer.rsplit_once('/').unwrap();
    if field == "goal" && !value.is_null() {
        body.as_object_mut().unwrap().remove("target");
    }
    body.pointer_mut(parent).unwrap()[field] = value;
}

#[test]
fn a_drop_off_is_told_at_its_place() {
    let many: Vec<Value> = (0..1001).map(|n| json!({"id": format!("tray-{n}")})).collect();
    assert!(read(&dropping(json!(many[..1000])).to_string()).is_ok());
    for (drop_offs, code, pointer) in [
        (json!(many), "too_many_drop_offs", "/drop_offs"),
        (json!({}), "wrong_type", "/drop_offs"),
        (json!([5]), "wrong_type", "/drop_offs/0"),
        (json!([{}]), "missing", "/drop_offs/0/id"),
        (json!([{"id": 5}]), "wrong_type", "/drop_offs/0/id"),
        (json!([{"id": ""}]), "id_length", "/drop_offs/0/id"),
        (json!([{"id": "x".repeat(129)}]), "id_length", "/drop_offs/0/id"),
        (json!([{"id": "tray"}, {"id": "bin"}, {"id": "tray"}]), "duplicate_id", "/drop_offs/2/id"),
        (json!([{"id": "tray", "depth": 1}]), "unknown_field", "/drop_offs/0/depth"),
        (json!([{"id": "tray", "capacity": 0}]), "out_of_range", "/drop_offs/0/capacity"),
        (json!([{"id": "tray", "capacity": -1}]), "out_of_range", "/drop_offs/0/capacity"),
        (json!([{"id": "tray", "capacity": 1.5}]), "not_whole", "/drop_offs/0/capacity"),
        (json!([{"id": "tray", "capacity": 1e10}]), "out_of_range", "/drop_offs/0/capacity"),
        (json!([{"id": "tray", "capacity": "4"}]), "wrong_type", "/drop_offs/0/capacity"),
        (json!([{"id": "tray", "accepts": "a"}]), "wrong_type", "/drop_offs/0/accepts"),
        (json!([{"id": "tray", "accepts": ["a", null]}]), "wrong_type", "/drop_offs/0/accepts/1"),
    ] {
        refuses(&dropping(drop_offs), &[(code, pointer)]);
    }
    // An object and a drop-off are no two objects.
    assert_eq!(warnings(&dropping(json!([{"id": "a", "capacity": 1e9}]))), []);
}

#[test]
fn what_a_drop_off_accepts_may_be_gone() {
    let gone = dropping(json!([{"id": "tray", "accepts": ["a", "gone", "a", "vase"]}]));
    assert_eq!(warnings(&gone), [pair("unknown_object", "/drop_offs/0/accepts/1")]);
    let long = dropping(json!([{"id": "tray", "accepts": ["x".repeat(129)]}]));
    assert_eq!(warnings(&long), [pair("id_length", "/drop_offs/0/accepts/0")]);
    let nowhere = with("/settings", json!({"destination": "drop_off"}));
    assert_eq!(warnings(&nowhere), [pair("no_drop_off", "/settings/destination")]);
}

#[test]
fn an_opening_is_told_at_its_place() {
    let with_opening = |max_opening: Value, word: Value| {
        let mut body = with("/gripper/max_opening", max_opening);
        body["gripper"]["opening"] = word;
        body
    };
    for (max_opening, word, code, pointer) in [
        (Value::Null, json!("full"), "missing", "/gripper/max_opening"),
        (json!(0), Value::Null, "out_of_range", "/gripper/max_opening"),
        (json!(1001), json!("full"), "out_of_range", "/gripper/max_opening"),
        (json!("wide"), Value::Null, "wrong_type", "/gripper/max_opening"),
        (json!(0.2), json!("wide"), "unknown_value", "/gripper/opening"),
        (json!(0.2), json!(true), "wrong_type", "/gripper/opening"),
    ] {
        refuses(&with_opening(max_opening, word), &[(code, pointer)]);
    }
    assert!(read(&with_opening(json!(0.2), json!("full")).to_string()).is_ok());
    refuses(&with("/settings", json!({"destination": "floor"})), &[("unknown_value", "/settings/destination")]);
}

#[test]
fn the_papers_methods_know_none_of_it() {
    let fields = [
        ("/goal", json!({"any_of": ["a"]})),
        ("/drop_offs", json!([])),
        ("/drop_offs", tray()),
        ("/gripper/max_opening", json!(0.2)),
        ("/gripper/opening", json!("fit")),
        ("/settings/destination", json!("table")),
    ];
    for (name, word) in
        [("grasp_model", "sector"), ("search", "lobs"), ("search", "forward_astar"), ("placement", "raster")]
    {
        let paper = with("/settings", json!({name: word}));
        let (mut absent, mut all) = (paper.clone(), paper.clone());
        for (pointer, value) in &fields {
            set(&mut absent, pointer, Value::Null);
            set(&mut all, pointer, value.clone());
            let mut body = paper.clone();
            set(&mut body, pointer, value.clone());
            refuses(&body, &[("discs_only", pointer)]);
        }
        assert_eq!(warnings(&absent), []);
        let pointers = ["/goal", "/drop_offs", "/gripper/max_opening", "/gripper/opening", "/settings/destination"];
        refuses(&all, &pointers.map(|pointer| ("discs_only", pointer)));
    }
}

#[test]
fn steps_to_drop_offs_are_read_and_told_at_their_place() {
    let read = |step: Value| {
        let plan = json!({"relocations": [step]});
        read_verify(
            json!({"scene": wanting(json!({"clear": true})), "plan": plan}).to_string().as_bytes(),
            &RequestLimits::default(),
        )
    };
    let step = json!({"action": "pick_drop", "object": "a", "from": {"x": 0.3, "y": 0.2}, "grasp": {"yaw": 1}, "drop_off": "tray"});
    let stated = read(step.clone()).unwrap().statement;
    assert_eq!((stated.steps()[0].object(), stated.steps()[0].rests_at()), ("a", None));
    for (name, value, faults) in [
        ("from", Value::Null, &[][..]),
        ("drop_off", json!(5), &[("wrong_type", "/plan/relocations/0/drop_off")]),
        ("to", json!({"x": 0, "y": 0}), &[("unknown_field", "/plan/relocations/0/to")]),
        ("gap", json!(0.1), &[("unknown_field", "/plan/relocations/0/gap")]),
    ] {
        let mut step = step.clone();
        step[name] = value;
        match read(step) {
            Ok(_) => assert!(faults.is_empty(), "{name}"),
            Err(problem) => has_faults(&problem, faults),
        }
    }
    for name in ["object", "grasp", "drop_off"] {
        let mut step = step.clone();
        step.as_object_mut().unwrap().remove(name);
        has_faults(&read(step).unwrap_err(), &[("missing", &format!("/plan/relocations/0/{name}"))]);
    }
}
