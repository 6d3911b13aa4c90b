//! Planning requests.

use core::time::Duration;

use serde_json::{Value, json};

use super::{has_faults, read, scene, with, without};
use crate::wire::*;
use singulate_planner::plan::Objective;

#[track_caller]
fn refuses(body: &str, expected: &[(&str, &str)]) {
    let problem = read(body).expect_err("the body is faulty");
    has_faults(&problem, expected);
    assert_eq!(problem.status(), 422);
}

#[test]
fn a_sound_scene_is_read_with_its_defaults() {
    let request = read(&scene().to_string()).unwrap();
    assert_eq!(request.scene.gripper().fingers(), 3);
    assert_eq!(request.scene_id.as_deref(), Some("cell-4/17"));
    assert_eq!(request.settings.objective, Objective::FarFromTarget);
    assert_eq!(request.time_limit, Duration::from_millis(1000));
    assert_eq!(request.warnings, []);
}

#[test]
fn settings_are_read() {
    let settings = json!({"grasp_model": "swept_finger", "search": "landmarks", "placement": "exact",
        "objective": "short_moves", "time_limit_ms": 20.0});
    let request = read(&with("/settings", settings).to_string()).unwrap();
    assert_eq!(request.settings.objective, Objective::ShortMoves);
    assert_eq!(request.time_limit, Duration::from_millis(20));
}

#[test]
fn an_optional_field_that_is_null_counts_as_absent() {
    for pointer in ["/scene_id", "/settings", "/table/keep_out", "/gripper/margin", "/objects/0/fixed"] {
        assert!(read(&with(pointer, Value::Null).to_string()).is_ok(), "{pointer}");
    }
}

#[test]
fn a_missing_field_is_told_at_its_place() {
    for pointer in [
        "/table",
        "/gripper",
        "/objects",
        "/target",
        "/table/x_min",
        "/table/y_max",
        "/gripper/fingers",
        "/gripper/finger_width",
        "/gripper/clearance",
        "/objects/1/x",
        "/objects/1/radius",
        "/objects/1/id",
    ] {
        refuses(&without(pointer).to_string(), &[("missing", pointer)]);
    }
}

#[test]
fn a_field_of_the_wrong_type_is_told_at_its_place() {
    for (pointer, value) in [
        ("/scene_id", json!(7)),
        ("/table", json!([])),
        ("/table/x_min", json!("0")),
        ("/table/keep_out", json!({})),
        ("/gripper/fingers", json!(null)),
        ("/gripper/margin", json!("none")),
        ("/objects", json!("all")),
        ("/objects/1", json!(5)),
        ("/objects/1/x", json!([])),
        ("/objects/1/id", json!(1)),
        ("/objects/1/fixed", json!("yes")),
        ("/target", json!(false)),
        ("/settings", json!(3)),
    ] {
        refuses(&with(pointer, value).to_string(), &[("wrong_type", pointer)]);
    }
    refuses("[]", &[("wrong_type", "")]);
}

#[test]
fn a_field_that_nobody_knows_is_told_at_its_place() {
    for pointer in ["/colour", "/table/z", "/gripper/force", "/objects/1/depth"] {
        refuses(&with(pointer, json!("x")).to_string(), &[("unknown_field", pointer)]);
    }
    refuses(&with("/settings", json!({"a/b~c": 1})).to_string(), &[("unknown_field", "/settings/a~1b~0c")]);
}

#[test]
fn a_number_out_of_its_range_is_told_at_its_place() {
    for (pointer, value) in [
        ("/table/x_max", json!(2e5)),
        ("/gripper/fingers", json!(1)),
        ("/gripper/fingers", json!(13)),
        ("/gripper/finger_width", json!(0)),
        ("/gripper/clearance", json!(-0.05)),
        ("/gripper/margin", json!(-1e-9)),
        ("/gripper/yaw_tolerance", json!(3.2)),
        ("/objects/1/radius", json!(0)),
        ("/objects/1/radius", json!(-1)),
        ("/objects/1/x", json!(1e300)),
    ] {
        refuses(&with(pointer, value).to_string(), &[("out_of_range", pointer)]);
    }
}

#[test]
fn a_number_beyond_every_double_is_out_of_range() {
    let body = with("/objects/1/radius", json!("HERE")).to_string().replace("\"HERE\"", "1e999");
    refuses(&body, &[("out_of_range", "/objects/1/radius")]);
}

#[test]
fn settings_that_can_not_be_served_are_told_at_their_place() {
    for (name, value, code) in [
        ("grasp_model", json!("cone"), "unknown_value"),
        ("search", json!("dijkstra"), "unknown_value"),
        ("placement", json!("grid"), "unknown_value"),
        ("objective", json!("fastest"), "unknown_value"),
        ("objective", json!(1), "wrong_type"),
        ("time_limit_ms", json!(0), "out_of_range"),
        ("time_limit_ms", json!(-3), "out_of_range"),
        ("time_limit_ms", json!(60001), "out_of_range"),
        ("time_limit_ms", json!(1e30), "out_of_range"),
        ("time_limit_ms", json!(1.5), "not_whole"),
    ] {
        let body = with("/settings", json!({name: value})).to_string();
        refuses(&body, &[(code, &format!("/settings/{name}"))]);
    }
}

#[test]
fn a_table_too_large_for_a_raster_is_told_at_the_placement() {
    let mut body = with("/settings", json!({"placement": "raster"}));
    assert!(read(&body.to_string()).is_ok());
    body["table"]["x_max"] = json!(1000);
    body["table"]["y_max"] = json!(1000);
    refuses(&body.to_string(), &[("too_fine", "/settings/placement")]);
}

#[test]
fn a_scene_that_does_not_hold_is_told_at_its_place() {
    let far = json!({"id": "b", "x": 3, "y": 0.2, "radius": 0.075});
    let near = json!({"id": "b", "x": 0.32, "y": 0.2, "radius": 0.075});
    let keep_out = json!([{"x_min": 0.2, "y_min": 0, "x_max": 0.1, "y_max": 0.1}]);
    for (pointer, value, code, place) in [
        ("/gripper/fingers", json!(2.5), "not_whole", "/gripper/fingers"),
        ("/table/x_max", json!(-1), "empty_rectangle", "/table/x_max"),
        ("/table/keep_out", keep_out, "empty_rectangle", "/table/keep_out/0/x_max"),
        ("/objects/1/id", json!(""), "id_length", "/objects/1/id"),
        ("/objects/1/id", json!("x".repeat(129)), "id_length", "/objects/1/id"),
        ("/objects/1/id", json!("a"), "duplicate_id", "/objects/1/id"),
        ("/objects/1", far, "off_table", "/objects/1"),
        ("/objects/1", near, "overlap", "/objects/1"),
        ("/target", json!("nobody"), "unknown_target", "/target"),
        ("/target", json!("x".repeat(129)), "id_length", "/target"),
        ("/target", json!("vase"), "fixed_target", "/target"),
        ("/scene_id", json!("x".repeat(257)), "id_length", "/scene_id"),
    ] {
        refuses(&with(pointer, value).to_string(), &[(code, place)]);
    }
}

#[test]
fn the_configured_limits_hold() {
    let mut limits = RequestLimits::default();
    limits.scene.max_objects = 2;
    let problem = read_scene(scene().to_string().as_bytes(), &limits).unwrap_err();
    has_faults(&problem, &[("too_many_objects", "/objects")]);
    limits.scene.max_objects = 3;
    limits.scene.max_neighbours = 0;
    let near = json!({"id": "b", "x": 0.46, "y": 0.2, "radius": 0.075});
    let problem = read_scene(with("/objects/1", near).to_string().as_bytes(), &limits).unwrap_err();
    has_faults(&problem, &[("too_many_neighbours", "/objects/0"), ("too_many_neighbours", "/objects/1")]);
}

#[test]
fn every_fault_is_told_at_once() {
    let mut body = with("/objects/1/radius", json!(-1));
    body["colour"] = json!("red");
    body["gripper"]["fingers"] = json!("three");
    body["target"] = json!("nobody");
    refuses(
        &body.to_string(),
        &[
            ("unknown_field", "/colour"),
            ("wrong_type", "/gripper/fingers"),
            ("out_of_range", "/objects/1/radius"),
            ("unknown_target", "/target"),
        ],
    );
}

#[test]
fn the_list_of_faults_ends_at_a_thousand() {
    let objects: Vec<Value> = (0..2000).map(|_| json!({})).collect();
    let problem = read(&with("/objects", json!(objects)).to_string()).unwrap_err();
    assert_eq!(problem.errors().len(), path::MAX_ERRORS);
}

#[test]
fn malformed_json_is_told_with_its_line_and_column() {
    let problem = read("{\n \"table\": }").unwrap_err();
    assert_eq!((problem.status(), problem.kind()), (400, ProblemKind::MalformedJson));
    assert!(problem.detail().contains("line 2 column 11"), "{}", problem.detail());
    for body in ["", "\u{feff}{}", "{} {}", "nul", &"[".repeat(1000)] {
        assert_eq!(read(body).unwrap_err().status(), 400, "{body}");
    }
    assert_eq!(read_scene(b"\"\xff\"", &RequestLimits::default()).unwrap_err().status(), 400);
}

#[test]
fn shallow_overlaps_and_overlapping_fingers_are_warnings() {
    let near = json!({"id": "b", "x": 0.4495, "y": 0.2, "radius": 0.075});
    let mut body = with("/objects/1", near);
    body["gripper"]["finger_width"] = json!(0.3);
    let request = read(&body.to_string()).unwrap();
    let warnings: Vec<_> = request.warnings.iter().map(|item| (item.code.as_str(), item.pointer.as_str())).collect();
    assert_eq!(
        warnings,
        [("overlap", "/objects/1"), ("fingers_overlap", "/objects/0"), ("fingers_overlap", "/objects/1")]
    );
}

#[test]
fn an_overlap_of_just_the_tolerance_is_a_warning() {
    // 0.075 + 0.01 - (0.3 - 0.216) comes out above 0.001.
    let near = json!({"id": "b", "x": 0.216, "y": 0.2, "radius": 0.01});
    let request = read(&with("/objects/1", near).to_string()).unwrap();
    assert_eq!(request.warnings[0].code, "overlap");
    let nearer = json!({"id": "b", "x": 0.216_001, "y": 0.2, "radius": 0.01});
    assert_eq!(read(&with("/objects/1", nearer).to_string()).unwrap_err().errors()[0].code, ErrorCode::Overlap);
}

#[test]
fn a_written_scene_reads_as_the_same_scene() {
    let request =
        read(&with("/table/keep_out", json!([{"x_min": 0, "y_min": 0, "x_max": 0.2, "y_max": 0.1}])).to_string());
    let written = serde_json::to_string(&SceneBody::new(&request.unwrap().scene, Some("again"))).unwrap();
    let again = read(&written).unwrap();
    assert_eq!(again.scene_id.as_deref(), Some("again"));
    assert_eq!(serde_json::to_string(&SceneBody::new(&again.scene, Some("again"))).unwrap(), written);
}
