//! Answers, written and read again.

use core::time::Duration;

use nalgebra::Point2;
use serde_json::{Value, json};

use super::{has_faults, read, scene, with};
use crate::wire::*;
use singulate_planner::plan::{
    Answer, Deadlock, Grasp, LowerBound, Plan, Relocation, Statistics, Unplanned, Verdict, VerdictName,
};
use singulate_planner::scene::ObjectIndex;

fn verdicts() -> Vec<Verdict> {
    let (b, grasp) = (ObjectIndex::new(1), Grasp { yaw: 0.5, slack: 0.2 });
    let bound = LowerBound { cost: 1, landmarks: vec![vec![b]] };
    let (from, to) = (Point2::new(0.6, 0.2), Point2::new(1.1, 0.6));
    let step = Relocation { object: b, from, to, grasp, release: grasp, gap: 0.031 };
    let unplanned = Unplanned { bound: Some(bound.clone()), needed: Some(vec![b]) };
    vec![
        Verdict::Graspable(grasp),
        Verdict::Relocate(Plan { relocations: vec![step], target_grasp: grasp, bound: Some(bound) }),
        Verdict::Deadlock(Some(Deadlock { blocked: vec![ObjectIndex::new(0), b], core: vec![ObjectIndex::new(0)] })),
        Verdict::NoSpace(unplanned.clone()),
        Verdict::TimedOut(unplanned),
    ]
}

fn bodies() -> Vec<Value> {
    let request = read(&scene().to_string()).unwrap();
    let statistics = Statistics { knowledge: Duration::from_micros(40), ..Statistics::default() };
    let answers = verdicts().into_iter().map(|verdict| Answer { verdict, warnings: Vec::new(), statistics });
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
    let request = read(&scene().to_string()).unwrap();
    for (body, name) in bodies().into_iter().zip(names) {
        let claim = read_plan(body.to_string().as_bytes(), &request.scene).unwrap();
        assert_eq!(claim.verdict, Some(name));
        let both = json!({"scene": scene(), "plan": body}).to_string();
        assert_eq!(read_verify(both.as_bytes(), &RequestLimits::default()).unwrap().claim, claim);
    }
    let short = read_plan(br#"{"relocations": [], "target_grasp": {"yaw": 1}}"#, &request.scene).unwrap();
    assert_eq!((short.verdict, short.cost, short.target_grasp.unwrap().yaw), (None, None, 1.0));
}

#[track_caller]
fn refuses_plan(pointer: &str, value: Value, code: &str) {
    let mut plan = bodies().swap_remove(1);
    let (parent, name) = pointer.rsplit_once('/').unwrap();
    plan.pointer_mut(parent).unwrap()[name] = value;
    let both = json!({"scene": scene(), "plan": plan}).to_string();
    let problem = read_verify(both.as_bytes(), &RequestLimits::default()).unwrap_err();
    has_faults(&problem, &[(code, format!("/plan{pointer}").as_str())]);
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
    has_faults(&problem, &[("unknown_target", "/scene/target"), ("missing", "/plan/target_grasp")]);
}
