//! Shapes, yaws, heights, listed grasps and palms: what is refused with which pointer.

use serde_json::{Value, json};

use super::shapes::{boxed, shaped, table};
use super::wanted::{pair, refuses, wanting, warnings};
use super::with;

/// The fields below this place, each with its code.
#[track_caller]
fn refuses_below(body: &Value, place: &str, faults: &[(&str, &str)]) {
    let faults: Vec<_> = faults.iter().map(|(code, at)| (*code, format!("{place}{at}"))).collect();
    refuses(body, &faults.iter().map(|(code, pointer)| (*code, pointer.as_str())).collect::<Vec<_>>());
}

#[test]
fn a_shape_is_told_at_its_place() {
    let many: Vec<Value> = (0..33).map(|n| json!({"x": f64::from(n) * 0.01, "y": f64::from(n * n) * 0.001})).collect();
    let line = json!([{"x": 0, "y": 0}, {"x": 0.1, "y": 0.1}, {"x": 0.2, "y": 0.2}]);
    let two = json!([{"x": 0, "y": 0}, {"x": 0.1, "y": 0.1}]);
    let bad = json!([{"x": 0, "y": 0}, {"x": "0.1", "y": 0}, {"x": 0.1, "y": 1001}, {"y": 0.1}, 5]);
    for (shape, faults) in [
        (json!("disc"), &[("wrong_type", "")][..]),
        (json!({}), &[("missing", "/kind")]),
        (json!({"kind": "ellipse", "length": 0.1, "width": 0.2}), &[("unknown_value", "/kind")]),
        (json!({"kind": 5, "depth": 1}), &[("unknown_field", "/depth"), ("wrong_type", "/kind")]),
        (json!({"kind": "disc"}), &[("missing", "/radius")]),
        (
            json!({"kind": "disc", "radius": 0, "length": 1}),
            &[("unknown_field", "/length"), ("out_of_range", "/radius")],
        ),
        (json!({"kind": "capsule", "radius": 0.01}), &[("missing", "/length")]),
        (json!({"kind": "capsule", "length": 0.019, "radius": 0.01}), &[("out_of_range", "/length")]),
        (json!({"kind": "rectangle", "length": 0.1}), &[("missing", "/width")]),
        (
            json!({"kind": "rectangle", "length": 0, "width": -1}),
            &[("out_of_range", "/length"), ("out_of_range", "/width")],
        ),
        (
            json!({"kind": "rectangle", "length": 0.1, "width": 0.06, "corner_radius": 0.031}),
            &[("out_of_range", "/corner_radius")],
        ),
        (
            json!({"kind": "rectangle", "length": 0.1, "width": 0.06, "corner_radius": "0"}),
            &[("wrong_type", "/corner_radius")],
        ),
        (json!({"kind": "polygon"}), &[("missing", "/points")]),
        (json!({"kind": "polygon", "points": {}}), &[("wrong_type", "/points")]),
        (json!({"kind": "polygon", "points": many}), &[("too_many_points", "/points")]),
        (json!({"kind": "polygon", "points": line}), &[("no_area", "/points")]),
        (json!({"kind": "polygon", "points": two}), &[("no_area", "/points")]),
        (json!({"kind": "polygon", "points": []}), &[("no_area", "/points")]),
        (
            json!({"kind": "polygon", "points": bad}),
            &[
                ("wrong_type", "/points/1/x"),
                ("missing", "/points/3/x"),
                ("wrong_type", "/points/4"),
                ("out_of_range", "/points/2/y"),
            ],
        ),
    ] {
        refuses_below(&shaped(shape), "/objects/1/shape", faults);
    }
}

#[test]
fn yaws_heights_and_grasps_are_told_at_their_place() {
    let many: Vec<Value> = (0..65).map(|_| json!({"yaw": 0})).collect();
    for (name, value, faults) in [
        ("yaw", json!("0.3"), &[("wrong_type", "")][..]),
        ("yaw", json!(-1001), &[("out_of_range", "")]),
        ("height", json!(0), &[("out_of_range", "")]),
        ("height", json!([]), &[("wrong_type", "")]),
        ("grasps", json!({"yaw": 1}), &[("wrong_type", "")]),
        ("grasps", json!(many), &[("too_many_grasps", "")]),
        ("grasps", json!([{"yaw": 0}, 5, {}]), &[("wrong_type", "/1"), ("missing", "/2/yaw")]),
        ("grasps", json!([{"yaw": 0, "slack": 0.1}]), &[("unknown_field", "/0/slack")]),
        (
            "grasps",
            json!([{"yaw": 0, "x": "0", "tolerance": -1}]),
            &[("wrong_type", "/0/x"), ("out_of_range", "/0/tolerance")],
        ),
        (
            "grasps",
            json!([{"yaw": 2e3, "x": 2e3, "y": -2e3}]),
            &[("out_of_range", "/0/x"), ("out_of_range", "/0/y"), ("out_of_range", "/0/yaw")],
        ),
        // π/3 for three fingers.
        ("grasps", json!([{"yaw": 0, "tolerance": core::f64::consts::FRAC_PI_3}]), &[("out_of_range", "/0/tolerance")]),
    ] {
        refuses_below(&boxed(name, value), &format!("/objects/1/{name}"), faults);
    }
    assert_eq!(warnings(&boxed("grasps", json!([{"yaw": 0, "tolerance": 1.047}]))), []);
}

#[test]
fn what_can_not_be_read_makes_no_other_fault() {
    // Without its yaw it would lie across `a`, and so would its corner if it were sharp.
    let slab = json!({"kind": "rectangle", "length": 0.1, "width": 0.3});
    let slab = json!({"id": "b", "x": 0.3, "y": 0.38, "yaw": "1.5708", "shape": slab});
    refuses(&with("/objects/1", slab), &[("wrong_type", "/objects/1/yaw")]);
    let rounded = json!({"kind": "rectangle", "length": 0.1, "width": 0.1, "corner_radius": "0.05"});
    let rounded = json!({"id": "b", "x": 0.3995, "y": 0.2995, "shape": rounded});
    refuses(&with("/objects/1", rounded), &[("wrong_type", "/objects/1/shape/corner_radius")]);
    // With the grasps of its shape it could not be the target.
    let mut body = boxed("grasps", json!(5));
    body["target"] = json!("b");
    refuses(&body, &[("wrong_type", "/objects/1/grasps")]);
    for half in ["finger_length", "palm_radius"] {
        let mut body = with(&format!("/gripper/{half}"), json!("long"));
        let other = if half == "palm_radius" { "finger_length" } else { "palm_radius" };
        body["gripper"][other] = json!(0.05);
        refuses(&body, &[("wrong_type", &format!("/gripper/{half}"))]);
    }
}

#[test]
fn a_palm_is_told_at_its_place() {
    for (name, value, code, pointer) in [
        ("finger_length", json!(0.1), "missing", "/gripper/palm_radius"),
        ("palm_radius", json!(0.1), "missing", "/gripper/finger_length"),
        ("tip_height", json!(-0.1), "out_of_range", "/gripper/tip_height"),
        ("tip_height", json!(1001), "out_of_range", "/gripper/tip_height"),
        ("tip_height", json!("0"), "wrong_type", "/gripper/tip_height"),
    ] {
        refuses(&with(&format!("/gripper/{name}"), value), &[(code, pointer)]);
    }
    let mut body = with("/gripper/finger_length", json!(0));
    body["gripper"]["palm_radius"] = json!(0);
    refuses(&body, &[("out_of_range", "/gripper/finger_length"), ("out_of_range", "/gripper/palm_radius")]);
    for name in ["finger_length", "palm_radius", "tip_height"] {
        assert_eq!(warnings(&with(&format!("/gripper/{name}"), Value::Null)), []);
    }
}

#[test]
fn what_has_no_grasp_is_no_goal() {
    let without = |goal: Value| {
        let mut body = wanting(goal);
        body["objects"][1]["grasps"] = json!([]);
        body
    };
    refuses(&without(json!({"all_of": ["a", "b"]})), &[("no_grasp", "/goal/all_of/1")]);
    refuses(&without(json!({"any_of": ["b"]})), &[("no_grasp", "/goal/any_of")]);
    assert_eq!(warnings(&without(json!({"any_of": ["a", "b"]}))), [pair("no_grasp", "/objects/1")]);
    let mut target = boxed("grasps", json!([]));
    target["target"] = json!("b");
    refuses(&target, &[("no_grasp", "/target")]);
}

#[test]
fn the_papers_methods_know_discs_only() {
    for (name, word) in
        [("grasp_model", "sector"), ("search", "lobs"), ("search", "forward_astar"), ("placement", "raster")]
    {
        let paper = |mut body: Value| {
            body["settings"] = json!({name: word});
            body
        };
        let rectangle = json!({"kind": "rectangle", "length": 0.1, "width": 0.06});
        for (field, value) in [("yaw", json!(0)), ("height", json!(0.1)), ("grasps", json!([{"yaw": 0}]))] {
            let pointer = format!("/objects/1/{field}");
            refuses(&paper(with(&pointer, value)), &[("discs_only", &pointer)]);
            assert_eq!(warnings(&paper(with(&pointer, Value::Null))), []);
        }
        for shape in [rectangle, json!({"kind": "disc", "radius": 0.075})] {
            refuses(&paper(shaped(shape)), &[("discs_only", "/objects/1/shape")]);
        }
        let gripper = ["/gripper/finger_length", "/gripper/palm_radius", "/gripper/tip_height"];
        // Each at the first object that has it.
        let objects = ["/objects/2/yaw", "/objects/2/shape", "/objects/2/height", "/objects/3/grasps"];
        let all: Vec<_> = gripper.into_iter().chain(objects).map(|pointer| ("discs_only", pointer)).collect();
        refuses(&paper(table()), &all);
    }
}
