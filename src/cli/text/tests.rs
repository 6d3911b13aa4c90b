//! The texts, word for word.

mod goals;
mod shapes;

use nalgebra::Point2;

use super::*;
use crate::wire::{RequestLimits, read_scene};
use singulate_planner::check::{Fault, FaultCode, Report};
use singulate_planner::cost::Cost;
use singulate_planner::scene::ObjectIndex;
use singulate_planner::statement::{Deadlock, PickDrop, PickPlace, StatedGrasp, StatedPose, Step};

fn request() -> PlanRequest {
    let scene = r#"{"scene_id": "cell-4/17", "table": {"x_min": 0, "y_min": 0, "x_max": 2, "y_max": 1},
        "gripper": {"fingers": 3, "finger_width": 0.02, "clearance": 0.05},
        "objects": [{"id": "cup", "x": 0.5, "y": 0.5, "radius": 0.05}, {"id": "plate-2", "x": 0.62, "y": 0.5, "radius": 0.05},
                    {"id": "b\u001b[2J", "x": 0.38, "y": 0.5, "radius": 0.05},
                    {"id": "vase", "x": 0.5, "y": 0.7, "radius": 0.05, "fixed": true}],
        "target": "cup"}"#;
    read_scene(scene.as_bytes(), &RequestLimits::default()).unwrap()
}

fn ids(positions: &[usize]) -> Vec<String> {
    positions.iter().map(|&at| request().scene.objects()[at].id().to_owned()).collect()
}

fn text(statement: Statement) -> String {
    let statistics = Statistics { knowledge: Duration::from_micros(40), ..Statistics::default() };
    answer(&request(), &Answer { statement, statistics }.into())
}

const GRASP: StatedGrasp = StatedGrasp { at: None, yaw: 0.5, slack: Some(0.1) };
const TIMES: &str = "0.04 ms in all: knowledge 0.04 ms, search 0.00 ms, placement 0.00 ms, check 0.00 ms\n";

fn plan(bound: u64, landmarks: &[&[usize]]) -> Statement {
    let step = |object: usize| {
        let request = request();
        let object = &request.scene.objects()[object];
        Step::PickPlace(PickPlace {
            object: object.id().to_owned(),
            from: Some(object.footprint().at().into()),
            to: Point2::new(1.5, 0.25).into(),
            grasp: GRASP,
            release: GRASP,
            turn: None,
            gap: Some(0.0312),
        })
    };
    Statement {
        verdict: Some(Verdict::Relocate),
        relocations: Some(vec![step(1), step(2)]),
        target_grasp: Some(GRASP),
        cost: Some(Cost::new(2)),
        lower_bound: Some(Cost::new(bound)),
        optimal: Some(bound == 2),
        landmarks: Some(landmarks.iter().map(|set| ids(set)).collect()),
        ..Statement::default()
    }
}

#[test]
fn a_plan_shows_its_steps_and_why_none_is_shorter() {
    let expected = format!(
        "relocate 2 objects (proven least)\n\
         target: cup in scene cell-4/17\n\
         \n\
         #  object          from (m)           to (m)    grasp yaw  release yaw      gap\n\
         1  plate-2     0.620, 0.500  →  1.500, 0.250  28.6° ±5.7°  28.6° ±5.7°  31.2 mm\n\
         2  b\\u{{1b}}[2J  0.380, 0.500  →  1.500, 0.250  28.6° ±5.7°  28.6° ±5.7°  31.2 mm\n\
         \n\
         Then grasp cup at yaw 28.6° ±5.7°.\n\
         \n\
         Every plan moves: plate-2, b\\u{{1b}}[2J\n\
         So 2 is the least.\n\
         \n\
         {TIMES}"
    );
    assert_eq!(text(plan(2, &[&[1], &[2]])), expected);
}

#[test]
fn sets_of_several_objects_follow_those_that_every_plan_moves() {
    let text = text(plan(2, &[&[1, 2], &[2, 3], &[1]]));
    let expected = "Every plan moves: plate-2\n\
                    Every plan moves at least one of: plate-2, b\\u{1b}[2J\n\
                    Every plan moves at least one of: b\\u{1b}[2J, vase\n\
                    No fewer than 2 objects satisfy all of these.\n\
                    So 2 is the least.\n";
    assert!(text.contains(expected), "{text}");
}

#[test]
fn a_plan_above_its_bound_says_so() {
    let text = text(plan(1, &[&[1, 2]]));
    assert!(text.starts_with("relocate 2 objects (at least 1 relocation is needed)\n"), "{text}");
    assert!(
        text.contains(
            "of: plate-2, b\\u{1b}[2J\nSo 1 or more are needed; whether fewer than 2 suffice is not known.\n"
        ),
        "{text}"
    );
}

#[test]
fn a_deadlock_names_those_that_lock_each_other() {
    let deadlock = Some(Deadlock { blocked: ids(&[0, 1, 2, 3]), core: ids(&[0, 1, 3]) });
    let expected = format!(
        "deadlock: 3 objects hold each other, no pick-and-place can free the target\n\
         target: cup in scene cell-4/17\n\
         \n\
         These objects lock each other: at every yaw of each that can be moved, another of them is in the way.\n\
         \n\
         object\n\
         cup      the target\n\
         plate-2\n\
         vase     fixed\n\
         \n\
         Also locked: b\\u{{1b}}[2J\n\
         \n\
         {TIMES}"
    );
    assert_eq!(text(Statement { verdict: Some(Verdict::Deadlock), deadlock, ..Statement::default() }), expected);
}

#[test]
fn without_a_plan_the_bound_and_the_needed_order_are_told() {
    let known = Statement {
        verdict: Some(Verdict::NoSpace),
        lower_bound: Some(Cost::new(1)),
        landmarks: Some(vec![ids(&[1, 2])]),
        needed: Some(ids(&[2, 1])),
        ..Statement::timed_out()
    };
    let expected = format!(
        "no space: no place found for what has to move (at least 1 relocation is needed)\n\
         target: cup in scene cell-4/17\n\
         \n\
         Would free the target, moved in this order: b\\u{{1b}}[2J, plate-2\n\
         \n\
         Every plan moves at least one of: plate-2, b\\u{{1b}}[2J\n\
         So at least 1 must move.\n\
         \n\
         This is not a proof: only the places that were tried do not suffice.\n\
         \n\
         {TIMES}"
    );
    assert_eq!(text(known), expected);
    let nothing = text(Statement::timed_out());
    assert_eq!(nothing, format!("timed out: nothing is proven yet\ntarget: cup in scene cell-4/17\n\n{TIMES}"));
}

#[test]
fn a_survey_is_one_line_an_object() {
    let entry = |object: usize, verdict, lower_bound, optimal| SurveyEntry {
        object: ObjectIndex::new(object),
        verdict,
        lower_bound,
        optimal,
    };
    let entries = [
        entry(0, SurveyVerdict::Relocate, Some(Cost::new(2)), Some(true)),
        entry(1, SurveyVerdict::Deadlock, None, None),
        entry(2, SurveyVerdict::TimedOut, Some(Cost::new(1)), Some(false)),
    ];
    let text = survey(&request().scene, &entries);
    let expected = "object      verdict    relocations\n\
                    cup         relocate   2\n\
                    plate-2     deadlock\n\
                    b\\u{1b}[2J  timed out  at least 1\n";
    assert!(text.starts_with(expected), "{text}");
}

#[test]
fn a_verification_lists_its_faults_with_steps_counted_from_one() {
    let fault = Fault {
        code: FaultCode::GraspBlocked,
        step: Some(0),
        object: Some("plate-2".to_owned()),
        detail: "finger 1 is 3 mm inside 'vase'".to_owned(),
    };
    let text = |faults| verification(&request().scene, &VerificationBody::new(&Report { faults, ..Report::default() }));
    let expected = "not valid: 1 fault\n  step 1, plate-2: finger 1 is 3 mm inside 'vase' (grasp_blocked)\n";
    assert_eq!(text(vec![fault]), expected);
    assert_eq!(text(Vec::new()), "valid: all that it states holds\n");
}

#[test]
fn a_verification_says_when_to_plan_again() {
    let fault = |code| Fault { code, step: None, object: None, detail: "why".to_owned() };
    let text = |first_failing_step, code| {
        let report = Report { faults: vec![fault(code)], first_failing_step, ..Report::default() };
        verification(&request().scene, &VerificationBody::new(&report))
    };
    let fails = "Plan again: step 3 fails. The grasp of the target counts as the last step.\n";
    assert_eq!(text(Some(2), FaultCode::TargetBlocked), format!("not valid: 1 fault\n  why (target_blocked)\n{fails}"));
    assert!(
        text(None, FaultCode::ReplayUnconfirmed)
            .ends_with("Plan again: time ran out before all steps were replayed.\n")
    );
    assert!(!text(None, FaultCode::BoundUnproven).contains("Plan again"));
}

#[test]
fn an_id_neither_forges_a_line_nor_turns_it_round() {
    assert_eq!(plain("a\u{1b}b\u{202e}c\u{2028}d é"), "a\\u{1b}b\\u{202e}c\\u{2028}d é");
}
