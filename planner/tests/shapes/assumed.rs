//! What is assumed of shapes, grasps and heights, and its limits.

use core::f64::consts::TAU;

use singulate_planner::budget::Budget;
use singulate_planner::check::{FaultCode, Terms, check_on};
use singulate_planner::geometry::shadow;
use singulate_planner::plan::{Settings, plan};
use singulate_planner::scene::{
    Flaw, GoalDraft, GraspDraft, GripperDraft, Lack, ObjectDraft, ObjectIndex, RectangleDraft, Scene, SceneDraft,
    SceneLimits, ShapeDraft, TableDraft,
};
use singulate_planner::search::SILENT;
use singulate_planner::statement::{Statement, Step};

use super::random::object;

fn jaws() -> GripperDraft {
    GripperDraft {
        fingers: Some(2.0),
        finger_width: Some(0.02),
        clearance: Some(0.02),
        margin: Some(0.0),
        yaw_tolerance: Some(0.0),
        ..GripperDraft::default()
    }
}

fn draft(gripper: GripperDraft, objects: Vec<ObjectDraft>) -> SceneDraft {
    let area = |[x_min, y_min, x_max, y_max]: [f64; 4]| RectangleDraft {
        x_min: Some(x_min),
        y_min: Some(y_min),
        x_max: Some(x_max),
        y_max: Some(y_max),
    };
    let table = TableDraft { top: area([-1.0, -1.0, 1.0, 1.0]), keep_out: Vec::new() };
    SceneDraft { table, gripper, objects, goal: Some(GoalDraft::Target("t".into())), ..SceneDraft::default() }
}

fn polygon(points: &[[f64; 2]]) -> ShapeDraft {
    ShapeDraft::Polygon { points: points.iter().map(|point| point.map(Some)).collect(), corner_radius: None }
}

fn flaws(draft: SceneDraft) -> Vec<Flaw> {
    match Scene::new(draft, &SceneLimits::default()) {
        Ok((_, warnings)) => warnings.into_iter().map(|finding| finding.flaw).collect(),
        Err(faults) => faults.into_iter().map(|finding| finding.flaw).collect(),
    }
}

#[test]
fn a_polygon_with_more_parallel_edges_than_an_object_has_grasps_is_refused() {
    // Nearly a box: fifteen edges fanned within 2.4° on top, and fifteen below.
    let fan = |n: u32, up: f64| {
        let x = 0.1 - 0.2 * f64::from(n) / 15.0;
        [up * x, up * (0.05 - 0.2 * x * x)]
    };
    let points: Vec<[f64; 2]> = (0..16).map(|n| fan(n, 1.0)).chain((0..16).map(|n| fan(n, -1.0))).collect();
    let found = flaws(draft(jaws(), vec![object("t", [0.0; 3], polygon(&points), None)]));
    assert!(matches!(found[..], [Flaw::TooManyGrasps { max: 64, .. }]), "{found:?}");
}

#[test]
fn grasps_that_take_too_long_together_are_refused() {
    let corner = |n: u32| {
        let angle = TAU * f64::from(n) / 32.0;
        [0.05 * libm::cos(angle), 0.05 * libm::sin(angle)]
    };
    let points: Vec<[f64; 2]> = (0..32).map(corner).collect();
    let grasps: Vec<GraspDraft> =
        (0..64).map(|n| GraspDraft { x: Some(1e-4 * f64::from(n)), yaw: Some(0.0), ..GraspDraft::default() }).collect();
    let hand = GripperDraft { fingers: Some(12.0), yaw_tolerance: Some(3.1), ..jaws() };
    let found = flaws(draft(hand, vec![object("t", [0.0; 3], polygon(&points), Some(grasps))]));
    assert_eq!(found, [Flaw::TooMuchClosing]);
}

#[test]
fn points_that_go_round_twice_are_planned_as_their_hull_and_that_is_said() {
    let star = [0.0, 130.0, 260.0, 30.0, 160.0, 290.0_f64].map(|degrees| {
        let angle = degrees.to_radians();
        [0.1 * libm::cos(angle), 0.1 * libm::sin(angle)]
    });
    let found =
        flaws(draft(jaws(), vec![object("t", [0.0; 3], polygon(&star), Some(vec![super::random::over_the_origin()]))]));
    assert!(matches!(found[..], [Flaw::ConvexHull { .. }]), "{found:?}");
}

#[test]
fn heights_that_are_equal_in_decimals_hinder_nobody() {
    // 0.3 − 0.1 is less than 0.2 in the last digit.
    let hand = GripperDraft { finger_length: Some(0.1), palm_radius: Some(0.2), ..jaws() };
    let tall = |id: &str, x: f64, height: f64| ObjectDraft {
        height: Some(height),
        ..object(id, [x, 0.0, 0.0], ShapeDraft::disc(0.03), None)
    };
    let shadow_of = |height: f64| {
        let objects = vec![tall("t", 0.0, 0.3), tall("o", 0.075, height)];
        let (scene, _) = Scene::new(draft(hand, objects), &SceneLimits::default()).expect("a sound scene");
        shadow(scene.gripper(), scene.placed(ObjectIndex::new(0)), scene.placed(ObjectIndex::new(1)), 0.0)
    };
    assert!(shadow_of(0.2).is_empty(), "the fingers pass over it");
    assert!(!shadow_of(0.2001).is_empty());
    let full = |height: f64| shadow_of(height).yaws().is_some_and(|yaws| yaws.is_full());
    assert!(!full(0.3) && full(0.3001), "the palm passes over what is as high");
}

/// A box between two others, held by one of three grasps, to be moved for the target.
fn three_ways() -> Scene {
    let grasp = |yaw: f64| GraspDraft { yaw: Some(yaw), ..GraspDraft::default() };
    let rectangle = |length: f64, width: f64| ShapeDraft::Rectangle {
        length: Some(length),
        width: Some(width),
        corner_radius: None,
    };
    let objects = vec![
        object("t", [0.0; 3], ShapeDraft::disc(0.03), None),
        object("box", [0.056, 0.0, 0.0], rectangle(0.05, 0.3), Some([1.5, 1.53, 1.57].map(grasp).to_vec())),
        object("left", [-0.09, 0.0, 0.0], rectangle(0.05, 0.3), Some(Vec::new())),
    ];
    let hand = GripperDraft { finger_width: Some(0.07), ..jaws() };
    Scene::new(draft(hand, objects), &SceneLimits::default()).expect("a sound scene").0
}

#[test]
fn a_tolerance_takes_the_nearest_grasp_and_lets_the_hand_turn_as_planned() {
    let scene = three_ways();
    let answer = plan(&scene, &Settings::default(), &Budget::unlimited(), SILENT).expect("an answer").statement;
    let step = |stated: &Statement| stated.steps()[0].pick_place().expect("a pick-and-place").clone();
    assert_eq!(step(&answer).object, "box");
    let codes = |stated: &Statement, position_tolerance: f64| -> Vec<FaultCode> {
        let terms = Terms { position_tolerance, partial: true };
        let report = check_on(&scene, stated, &terms, &Budget::unlimited());
        report.faults.iter().map(|fault| fault.code).collect()
    };
    assert_eq!((codes(&answer, 0.0), codes(&answer, 0.002)), (vec![], vec![]));
    let turned = |by: f64, change: fn(&mut singulate_planner::statement::PickPlace, f64)| {
        let mut stated = answer.clone();
        if let Some(Step::PickPlace(step)) = stated.relocations.as_mut().and_then(|steps| steps.first_mut()) {
            change(step, by);
        }
        stated
    };
    let release = turned(0.01, |step, by| step.release.yaw += by);
    assert!(
        codes(&release, 0.0).contains(&FaultCode::WrongTurn) && codes(&release, 0.002).contains(&FaultCode::WrongTurn)
    );
    let seen = turned(0.01, |step, by| {
        step.from = step.from.map(|mut from| {
            from.yaw = from.yaw.map(|yaw| yaw + by);
            from
        })
    });
    assert!(codes(&seen, 0.0).contains(&FaultCode::WrongFrom));
}

#[test]
fn what_looks_like_a_slip_is_doubted_and_what_is_lacking_is_named() {
    let rectangle = ShapeDraft::Rectangle { length: Some(0.1), width: Some(0.06), corner_radius: None };
    let grasp = |x: f64, yaw: f64| vec![GraspDraft { x: Some(x), yaw: Some(yaw), ..GraspDraft::default() }];
    let of = |hand, grasps| flaws(draft(hand, vec![object("t", [0.0; 3], rectangle.clone(), grasps)]));
    assert_eq!(of(jaws(), Some(grasp(0.05, 1.57))), []);
    assert_eq!(of(jaws(), Some(grasp(0.4, 1.57))), [Flaw::AxisBesideObject("t".into())]);
    assert_eq!(of(jaws(), Some(grasp(0.0, 90.0))), [Flaw::ManyTurns(90.0)]);
    let three = GripperDraft { fingers: Some(3.0), ..jaws() };
    let lack = |why| vec![Flaw::NoGrasp { id: "t".into(), why }];
    assert_eq!(of(three, None), lack(Lack::NotByShape(3)));
    assert_eq!(of(jaws(), Some(Vec::new())), lack(Lack::EmptyList));
    let narrow = of(GripperDraft { max_opening: Some(0.05), ..jaws() }, Some(grasp(0.0, 0.0)));
    assert!(matches!(narrow[..], [Flaw::NeedsOpening { max_opening: 0.05, .. }]), "{narrow:?}");
    let millimetres = GripperDraft { finger_length: Some(100.0), palm_radius: Some(0.05), ..jaws() };
    let found = of(millimetres, Some(grasp(0.0, 1.57)));
    assert!(matches!(found[..], [Flaw::OutOfProportion { length: 100.0, .. }, Flaw::UnknownHeight(_)]), "{found:?}");
}
