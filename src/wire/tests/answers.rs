//! Answers, written and read again.

use core::time::Duration;

use nalgebra::Point2;
use serde_json::{Value, json};
use utoipa::PartialSchema;

use super::wanted::wanting;
use super::{has_faults, read, scene, with};
use crate::wire::*;
use singulate_planner::budget::Budget;
use singulate_planner::check::{FaultCode, Terms, check};
use singulate_planner::cost::Cost;
use singulate_planner::paper::{Judged, plan_by};
use singulate_planner::plan::{Answer, Statistics};
use singulate_planner::search::SILENT;
use singulate_planner::statement::{Deadlock, PickDrop, PickPlace, StatedGrasp, StatedPose, Statement, Step, Verdict};

fn pose(x: f64, y: f64, yaw: Option<f64>) -> StatedPose {
    StatedPose { at: Point2::new(x, y), yaw }
}

fn grasp() -> StatedGrasp {
    StatedGrasp { at: Some(Point2::new(0.6, 0.2)), yaw: 0.5, slack: Some(0.2) }
}

/// A step of a disc; with a turn that of an object with listed grasps.
fn pick_place(turn: Option<f64>) -> Step {
    Step::PickPlace(PickPlace {
        object: "b".to_owned(),
        from: Some(pose(0.6, 0.2, turn.map(|_| 0.25))),
        to: pose(1.1, 0.6, turn.map(|turn| 0.25 + turn)),
        grasp: grasp(),
        release: StatedGrasp { at: Some(Point2::new(1.1, 0.6)), ..grasp() },
        turn,
        gap: Some(0.031),
    })
}

fn statements() -> Vec<Statement> {
    let (b, grasp, step) = (vec!["b".to_owned()], grasp(), pick_place(None));
    let (one, stated) = (Some(Cost::new(1)), Statement::timed_out());
    let bounded = Statement { lower_bound: one, landmarks: Some(vec![b.clone()]), ..stated.clone() };
    let deadlock = Some(Deadlock { blocked: vec!["a".to_owned(), "b".to_owned()], core: vec!["a".to_owned()] });
    vec![
        Statement {
            verdict: Some(Verdict::Graspable),
            target_grasp: Some(grasp),
            cost: Some(Cost::ZERO),
            optimal: Some(true),
            ..stated
        },
        Statement {
            verdict: Some(Verdict::Relocate),
            relocations: Some(vec![step]),
            target_grasp: Some(grasp),
            cost: one,
            optimal: Some(true),
            ..bounded.clone()
        },
        Statement { verdict: Some(Verdict::Deadlock), relocations: Some(Vec::new()), deadlock, ..Statement::default() },
        Statement { verdict: Some(Verdict::NoSpace), needed: Some(b.clone()), ..bounded.clone() },
        Statement { needed: Some(b), ..bounded },
    ]
}

fn judged(statement: Statement) -> Judged {
    let statistics = Statistics { knowledge: Duration::from_micros(40), ..Statistics::default() };
    Answer { statement, statistics }.into()
}

fn bodies() -> Vec<Value> {
    let request = read(&scene().to_string()).unwrap();
    let body = |statement| serde_json::to_value(AnswerBody::new(&request, &judged(statement))).unwrap();
    statements().into_iter().map(body).collect()
}

#[test]
fn every_verdict_is_written_with_every_field() {
    let grasp = json!({"x": 0.6, "y": 0.2, "yaw": 0.5, "slack": 0.2});
    let release = json!({"x": 1.1, "y": 0.6, "yaw": 0.5, "slack": 0.2});
    let step = json!({"action": "pick_place", "object": "b", "from": {"x": 0.6, "y": 0.2}, "to": {"x": 1.1, "y": 0.6},
        "grasp": grasp, "release": release, "gap": 0.031});
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

/// So what the checker has seen is what is served, field by field.
#[test]
fn an_answer_as_served_reads_as_the_statement_that_was_checked() {
    let request = read(&scene().to_string()).unwrap();
    for statement in statements() {
        let body = serde_json::to_value(AnswerBody::new(&request, &judged(statement.clone()))).unwrap();
        assert_eq!(read_plan(body.to_string().as_bytes(), &request.scene, false).unwrap(), statement);
        let both = json!({"scene": scene(), "plan": body}).to_string();
        assert_eq!(read_verify(both.as_bytes(), &RequestLimits::default()).unwrap().statement, statement);
    }
    let short = read_plan(br#"{"relocations": [], "target_grasp": {"yaw": 1}}"#, &request.scene, false).unwrap();
    assert_eq!((short.verdict, short.cost, short.target_grasp.unwrap().yaw), (None, None, 1.0));
}

#[test]
fn a_step_that_turns_an_object_is_written_with_its_poses_and_read_again() {
    let turned = |turn: Option<f64>| {
        let relocations = Some(vec![pick_place(turn)]);
        Statement { relocations, ..statements().swap_remove(1) }
    };
    let request = read(&scene().to_string()).unwrap();
    let body = |statement| serde_json::to_value(AnswerBody::new(&request, &judged(statement))).unwrap();
    let stated = |body: &Value| read_plan(body.to_string().as_bytes(), &request.scene, false).unwrap();
    let written = body(turned(Some(-1.0)));
    let grasp = json!({"x": 0.6, "y": 0.2, "yaw": 0.5, "slack": 0.2});
    let release = json!({"x": 1.1, "y": 0.6, "yaw": 0.5, "slack": 0.2});
    let step = json!({"action": "pick_place", "object": "b", "from": {"x": 0.6, "y": 0.2, "yaw": 0.25},
        "to": {"x": 1.1, "y": 0.6, "yaw": -0.75}, "grasp": grasp, "release": release, "turn": -1.0, "gap": 0.031});
    assert_eq!(written["relocations"][0].to_string(), step.to_string());
    assert_eq!(stated(&written), turned(Some(-1.0)));
    // A plan of before: no axes, no turn.
    let mut before = body(turned(None));
    for name in ["grasp", "release"] {
        before["relocations"][0][name] = json!({"yaw": 0.5, "slack": 0.2});
    }
    let step = stated(&before).steps()[0].pick_place().unwrap().clone();
    assert_eq!((step.grasp.at, step.release.at, step.to.yaw, step.turn), (None, None, None, None));
}

/// A goal, and what may be stated of it.
fn of_goals() -> [(Value, Statement); 4] {
    let from = Some(pose(0.3, 0.2, None));
    let drop = Step::PickDrop(PickDrop { object: "a".to_owned(), from, grasp: grasp(), drop_off: "tray".to_owned() });
    let mut statements = statements();
    let relocate = statements.swap_remove(1);
    let stuck = Some(Deadlock { blocked: vec!["b".to_owned(), "vase".to_owned()], core: vec!["b".to_owned()] });
    let cleared = Statement {
        verdict: Some(Verdict::PartlyCleared),
        relocations: Some(vec![drop.clone()]),
        cost: Some(Cost::new(1)),
        left: Some(vec!["b".to_owned()]),
        proven: Some(false),
        ..Statement::default()
    };
    [
        (json!({"any_of": ["a", "b"]}), Statement { target: Some("b".to_owned()), ..relocate.clone() }),
        (json!({"all_of": ["a"]}), Statement { relocations: Some(vec![drop]), target_grasp: None, ..relocate }),
        (json!({"clear": true}), Statement { stuck, ..cleared.clone() }),
        (json!({"clear": true}), Statement { left: Some(Vec::new()), ..cleared }),
    ]
}

#[test]
fn an_answer_to_a_goal_as_served_reads_as_the_statement_that_was_checked() {
    for (goal, statement) in of_goals() {
        let scene = wanting(goal.clone());
        let request = read(&scene.to_string()).unwrap();
        let body = serde_json::to_value(AnswerBody::new(&request, &judged(statement.clone()))).unwrap();
        assert_eq!(body["target"], json!(statement.target), "{body}");
        let clears = goal["clear"] == true;
        assert!(["stuck", "left", "proven"].iter().all(|name| body.get(name).is_some() == clears), "{body}");
        assert_eq!(read_plan(body.to_string().as_bytes(), &request.scene, false).unwrap(), statement);
        let both = json!({"scene": scene, "plan": body}).to_string();
        assert_eq!(read_verify(both.as_bytes(), &RequestLimits::default()).unwrap().statement, statement);
    }
    let clear = read(&wanting(json!({"clear": true})).to_string()).unwrap().scene;
    assert!(read_plan(br#"{"relocations": []}"#, &clear, false).is_ok(), "nothing is grasped in the end");
    let any = read(&wanting(json!({"any_of": ["a"]})).to_string()).unwrap().scene;
    has_faults(&read_plan(br#"{"relocations": []}"#, &any, false).unwrap_err(), &[("missing", "/target_grasp")]);
}

#[test]
fn an_answer_that_is_served_with_from_and_to_swapped_fails_its_check() {
    let pressed = json!([{"id": "a", "x": 0.3, "y": 0.3, "radius": 0.06}, {"id": "b", "x": 0.43, "y": 0.3, "radius": 0.06},
        {"id": "c", "x": 0.17, "y": 0.3, "radius": 0.06}, {"id": "d", "x": 0.3, "y": 0.43, "radius": 0.06},
        {"id": "e", "x": 0.3, "y": 0.17, "radius": 0.06}]);
    let request = read(&with("/objects", pressed).to_string()).unwrap();
    let budget = Budget::unlimited();
    let planned = plan_by(&request.methods, &request.scene, &request.settings, &budget, SILENT).unwrap();
    assert!(check(&request.scene, planned.statement(), &budget).faults.is_empty());
    let mut swapped = planned;
    for step in swapped.answer.statement.relocations.iter_mut().flatten().filter_map(Step::pick_place_mut) {
        let from = step.from.replace(step.to).unwrap();
        step.to = from;
    }
    assert!(!swapped.statement().steps().is_empty());
    let served = serde_json::to_string(&AnswerBody::new(&request, &swapped)).unwrap();
    for stated in [swapped.statement(), &read_plan(served.as_bytes(), &request.scene, false).unwrap()] {
        assert!(check(&request.scene, stated, &budget).has(FaultCode::WrongFrom));
    }
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
    refuses_plan("/relocations/0/grasp/x", json!(1e6), "out_of_range");
    refuses_plan("/relocations/0/release/y", json!("0.6"), "wrong_type");
    refuses_plan("/relocations/0/grasp/x", Value::Null, "missing");
    refuses_plan("/target_grasp/y", Value::Null, "missing");
    refuses_plan("/relocations/0/to/yaw", json!("0.3"), "wrong_type");
    refuses_plan("/relocations/0/turn", json!("0.3"), "wrong_type");
}

#[test]
fn a_faulty_scene_in_a_verification_is_told_below_its_place() {
    let both = json!({"scene": with("/target", json!("nobody")), "plan": {"relocations": []}}).to_string();
    let problem = read_verify(both.as_bytes(), &RequestLimits::default()).unwrap_err();
    has_faults(&problem, &[("unknown_target", "/scene/target"), ("missing", "/plan/target_grasp")]);
}

#[test]
fn the_verdicts_of_the_document_are_those_that_are_served() {
    let schema = serde_json::to_value(VerdictWord::schema()).unwrap();
    assert_eq!(schema["enum"], json!(Verdict::ALL.map(Verdict::as_str)));
}

#[test]
fn the_terms_of_a_verification_are_read_and_refused_at_their_place() {
    let limits = RequestLimits::default();
    let body = |terms: &Value, plan: &Value| {
        let mut body = json!({"scene": scene(), "plan": plan});
        body.as_object_mut().unwrap().extend(terms.as_object().unwrap().clone());
        body.to_string().into_bytes()
    };
    let (whole, next) = (bodies().swap_remove(1), json!({"relocations": []}));
    let read = |terms: Value, plan: &Value| read_verify(&body(&terms, plan), &limits);
    let terms = |position_tolerance, partial| Terms { position_tolerance, partial };
    assert_eq!(read(json!({}), &whole).unwrap().terms, Terms::default());
    assert_eq!(read(json!({"position_tolerance": null, "partial": null}), &whole).unwrap().terms, Terms::default());
    let both = json!({"position_tolerance": 0.002, "partial": true});
    assert_eq!(read(both, &next).unwrap().terms, terms(0.002, true));
    for (stated, code, pointer) in [
        (json!({"position_tolerance": -0.001}), "out_of_range", "/position_tolerance"),
        (json!({"position_tolerance": 2}), "out_of_range", "/position_tolerance"),
        (json!({"position_tolerance": "2 mm"}), "wrong_type", "/position_tolerance"),
        (json!({"partial": 1}), "wrong_type", "/partial"),
        (json!({"tolerance": 1}), "unknown_field", "/tolerance"),
    ] {
        has_faults(&read(stated, &whole).unwrap_err(), &[(code, pointer)]);
    }
    // A whole plan needs its final grasp.
    has_faults(&read(json!({"partial": false}), &next).unwrap_err(), &[("missing", "/plan/target_grasp")]);
}
