//! Each bad input with its pointer, and each answer with its fields.

use core::time::Duration;

use nalgebra::Point2;
use serde_json::{Value, json};

use super::*;
use crate::plan::{
    Answer, Deadlock, Grasp, LowerBound, Objective, Plan, Relocation, Statistics, Unplanned, Verdict, VerdictName,
};
use crate::scene::ObjectIndex;

fn scene() -> Value {
    json!({
        "scene_id": "cell-4/17",
        "table": {"x_min": 0, "y_min": 0, "x_max": 1.2, "y_max": 0.7},
        "gripper": {"fingers": 3.0, "finger_width": 0.02, "clearance": 0.05},
        "objects": [
            {"id": "a", "x": 0.3, "y": 0.2, "radius": 0.075},
            {"id": "b", "x": 0.6, "y": 0.2, "radius": 0.075},
            {"id": "vase", "x": 0.9, "y": 0.5, "radius": 0.05, "fixed": true}
        ],
        "target": "a"
    })
}

/// The scene with one place replaced; the place is made where it is missing.
fn with(pointer: &str, value: Value) -> Value {
    let mut body = scene();
    let (parent, name) = pointer.rsplit_once('/').unwrap();
    let parent = body.pointer_mut(parent).unwrap();
    match parent {
        Value::Array(items) => items[name.parse::<usize>().unwrap()] = value,
        _ => parent[name] = value,
    }
    body
}

fn without(pointer: &str) -> Value {
    let mut body = scene();
    let (parent, name) = pointer.rsplit_once('/').unwrap();
    body.pointer_mut(parent).unwrap().as_object_mut().unwrap().remove(name);
    body
}

fn read(body: &str) -> Result<PlanRequest, Problem> {
    read_scene(body.as_bytes(), &RequestLimits::default())
}

fn places(problem: &Problem) -> Vec<(&str, &str)> {
    problem.errors().iter().map(|error| (error.code, error.pointer.as_str())).collect()
}

#[track_caller]
fn refuses(body: &str, expected: &[(&str, &str)]) {
    let problem = read(body).expect_err("the body is faulty");
    assert_eq!(places(&problem), expected, "{body}");
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
    for pointer in ["/colour", "/table/z", "/gripper/force", "/objects/1/shape"] {
        refuses(&with(pointer, json!("x")).to_string(), &[("unknown_field", pointer)]);
    }
    refuses(&with("/settings", json!({"a/b~c": 1})).to_string(), &[("unknown_field", "/settings/a~1b~0c")]);
}

#[test]
fn the_reserved_name_says_that_it_is_reserved() {
    let problem = read(&with("/objects/0/shape", json!("disc")).to_string()).unwrap_err();
    assert!(problem.errors()[0].detail.contains("reserved"));
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
        ("grasp_model", json!("sector"), "unknown_value"),
        ("search", json!("lobs"), "unknown_value"),
        ("placement", json!("raster"), "unknown_value"),
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
    assert_eq!(places(&problem), [("too_many_objects", "/objects")]);
    limits.scene.max_objects = 3;
    limits.scene.max_neighbours = 0;
    let near = json!({"id": "b", "x": 0.46, "y": 0.2, "radius": 0.075});
    let problem = read_scene(with("/objects/1", near).to_string().as_bytes(), &limits).unwrap_err();
    assert_eq!(places(&problem), [("too_many_neighbours", "/objects/0"), ("too_many_neighbours", "/objects/1")]);
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
    assert_eq!(problem.errors().len(), reader::MAX_FAULTS);
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
    let warnings: Vec<_> = request.warnings.iter().map(|item| (item.code, item.pointer.as_str())).collect();
    assert_eq!(
        warnings,
        [("overlap", "/objects/1"), ("fingers_overlap", "/objects/0"), ("fingers_overlap", "/objects/1")]
    );
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

fn verdicts() -> Vec<Verdict> {
    let (b, grasp) = (ObjectIndex::new(1), Grasp { yaw: 0.5, slack: 0.2 });
    let bound = LowerBound { cost: 1, landmarks: vec![vec![b]] };
    let (from, to) = (Point2::new(0.6, 0.2), Point2::new(1.1, 0.6));
    let step = Relocation { object: b, from, to, grasp, release: grasp, gap: 0.031 };
    let unplanned = Unplanned { bound: bound.clone(), needed: Some(vec![b]) };
    vec![
        Verdict::Graspable(grasp),
        Verdict::Relocate(Plan { relocations: vec![step], target_grasp: grasp, bound }),
        Verdict::Deadlock(Deadlock { blocked: vec![ObjectIndex::new(0), b], core: vec![ObjectIndex::new(0)] }),
        Verdict::NoSpace(unplanned.clone()),
        Verdict::TimedOut(unplanned),
    ]
}

fn bodies() -> Vec<Value> {
    let request = read(&scene().to_string()).unwrap();
    let statistics = Statistics { knowledge: Duration::from_micros(40), ..Statistics::default() };
    let answers = verdicts().into_iter().map(|verdict| Answer { verdict, statistics });
    answers.map(|answer| serde_json::to_value(AnswerBody::new(&request, &answer)).unwrap()).collect()
}

#[test]
fn every_verdict_is_written_with_every_field() {
    let grasp = json!({"yaw": 0.5, "slack": 0.2});
    let step = json!({"action": "pick_place", "object": "b", "from": {"x": 0.6, "y": 0.2}, "to": {"x": 1.1, "y": 0.6},
        "grasp": grasp, "release": grasp, "gap": 0.031});
    let lock = json!({"blocked": ["a", "b"], "core": ["a"]});
    let rows = [
        json!(["graspable", [], grasp, 0, 0, true, [], null, null]),
        json!(["relocate", [step], grasp, 1, 1, true, [["b"]], null, null]),
        json!(["deadlock", [], null, null, null, null, null, lock, null]),
        json!(["no_space", [], null, null, 1, null, [["b"]], null, ["b"]]),
        json!(["timed_out", [], null, null, 1, null, [["b"]], null, ["b"]]),
    ];
    for (body, row) in bodies().iter().zip(rows) {
        let expected = json!({"verdict": row[0], "scene_id": "cell-4/17", "target": "a", "relocations": row[1],
            "target_grasp": row[2], "cost": row[3], "lower_bound": row[4], "optimal": row[5], "landmarks": row[6],
            "deadlock": row[7], "needed": row[8], "warnings": [],
            "statistics": {"knowledge_ms": 0.04, "search_ms": 0.0, "placement_ms": 0.0, "check_ms": 0.0}});
        assert_eq!(body.to_string(), expected.to_string());
    }
}

#[test]
fn an_answer_as_served_reads_as_a_claim() {
    let names = [
        VerdictName::Graspable,
        VerdictName::Relocate,
        VerdictName::Deadlock,
        VerdictName::NoSpace,
        VerdictName::TimedOut,
    ];
    for (body, name) in bodies().into_iter().zip(names) {
        let claim = read_plan(body.to_string().as_bytes()).unwrap();
        assert_eq!(claim.verdict, Some(name));
        let both = json!({"scene": scene(), "plan": body}).to_string();
        assert_eq!(read_verify(both.as_bytes(), &RequestLimits::default()).unwrap().claim, claim);
    }
    let short = read_plan(br#"{"relocations": [], "target_grasp": {"yaw": 1}}"#).unwrap();
    assert_eq!((short.verdict, short.cost, short.target_grasp.unwrap().yaw), (None, None, 1.0));
}

#[track_caller]
fn refuses_plan(pointer: &str, value: Value, code: &str) {
    let mut plan = bodies().swap_remove(1);
    let (parent, name) = pointer.rsplit_once('/').unwrap();
    plan.pointer_mut(parent).unwrap()[name] = value;
    let both = json!({"scene": scene(), "plan": plan}).to_string();
    let problem = read_verify(both.as_bytes(), &RequestLimits::default()).unwrap_err();
    assert_eq!(places(&problem), [(code, format!("/plan{pointer}").as_str())]);
}

#[test]
fn a_faulty_plan_is_told_at_its_place() {
    refuses_plan("/verdict", json!("maybe"), "unknown_value");
    refuses_plan("/target", json!("b"), "target_mismatch");
    refuses_plan("/cost", json!(-1), "out_of_range");
    refuses_plan("/cost", json!(0.5), "not_whole");
    refuses_plan("/optimal", json!("yes"), "wrong_type");
    refuses_plan("/landmarks", json!(7), "wrong_type");
    refuses_plan("/colour", json!(1), "unknown_field");
    refuses_plan("/relocations/0/action", json!("push"), "unknown_value");
    refuses_plan("/relocations/0/to/x", json!(1e6), "out_of_range");
    refuses_plan("/relocations/0/grasp", json!(1), "wrong_type");
}

#[test]
fn a_faulty_scene_in_a_verification_is_told_below_its_place() {
    let both = json!({"scene": with("/target", json!("nobody")), "plan": {"relocations": []}}).to_string();
    let problem = read_verify(both.as_bytes(), &RequestLimits::default()).unwrap_err();
    assert_eq!(places(&problem), [("unknown_target", "/scene/target"), ("missing", "/plan/target_grasp")]);
}
