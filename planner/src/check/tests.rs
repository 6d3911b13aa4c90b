//! Whole statements on objects that are no discs: one that holds, and what it may not be changed to.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::Point2;

use super::FaultCode::*;
use super::body::{cos_sin, rotated};
use super::{FaultCode, Terms, check_on};
use crate::budget::Budget;
use crate::scene::scenes::TestScene;
use crate::scene::{ObjectDraft, Scene, ShapeDraft};
use crate::statement::{Deadlock, PickPlace, StatedGrasp, StatedPose, Statement, Step, Verdict};

const FROM: [f64; 3] = [0.5, 0.5, 0.3];
const TO: [f64; 3] = [1.2, 1.0, 1.1];

/// A point of the frame at a pose, on the table.
fn point([x, y, yaw]: [f64; 3], own: [f64; 2]) -> Point2<f64> {
    Point2::new(x, y) + rotated(own.into(), cos_sin(yaw))
}

/// A box of 10 × 6 cm with a tray beyond one jaw and a tall bottle beside its end, each half a millimetre and more out of the
/// way; `nearer` are so much nearer, m.
fn crowd(nearer: [f64; 2]) -> TestScene {
    // The outer corners of the jaw reach 0.08094 m towards the tray, at one end of the band.
    let tray = point(FROM, [0.0, 0.0815 + 0.03 - nearer[0]]);
    let bottle = point(FROM, [-(0.06 + 0.03 + 0.0005 - nearer[1]), 0.0]);
    TestScene::new(2)
        .palm(0.1, 0.06)
        .rectangle("box", FROM, [0.1, 0.06])
        .height("box", 0.05)
        .rectangle("tray", [tray.x, tray.y, 0.3], [0.3, 0.06])
        .disc("bottle", bottle.x, bottle.y, 0.03)
        .height("bottle", 0.3)
        .disc("t", 1.5, 0.4, 0.02)
}

fn scene() -> Scene {
    crowd([0.0; 2]).build("t")
}

fn grasp(pose: [f64; 3]) -> StatedGrasp {
    StatedGrasp { at: Some(point(pose, [0.0; 2])), yaw: (pose[2] + FRAC_PI_2).rem_euclid(TAU), slack: Some(0.05) }
}

fn pose([x, y, yaw]: [f64; 3]) -> StatedPose {
    StatedPose { at: Point2::new(x, y), yaw: Some(yaw) }
}

fn plan() -> Statement {
    let step = PickPlace {
        object: "box".into(),
        from: Some(pose(FROM)),
        to: pose(TO),
        grasp: grasp(FROM),
        release: grasp(TO),
        turn: Some(0.8),
        gap: None,
    };
    let target_grasp = Some(StatedGrasp { at: Some(Point2::new(1.5, 0.4)), yaw: FRAC_PI_2, slack: None });
    Statement { relocations: Some(vec![Step::PickPlace(step)]), target_grasp, ..Statement::default() }
}

fn codes_on(scene: &Scene, statement: &Statement, terms: &Terms) -> Vec<FaultCode> {
    let report = check_on(scene, statement, terms, &Budget::unlimited());
    report.faults.into_iter().map(|fault| fault.code).collect()
}

fn codes(scene: &Scene, statement: &Statement) -> Vec<FaultCode> {
    codes_on(scene, statement, &Terms::default())
}

/// The plan with its step changed has these faults.
fn mutant(change: impl FnOnce(&mut PickPlace), expected: &[FaultCode]) {
    let mut statement = plan();
    change(statement.relocations.as_mut().unwrap()[0].pick_place_mut().unwrap());
    assert_eq!(codes(&scene(), &statement), expected);
}

#[test]
fn the_plan_holds() {
    assert_eq!(codes(&scene(), &plan()), []);
    mutant(|step| (step.from, step.turn, step.grasp.at, step.release.at) = (None, None, None, None), &[]);
    mutant(|step| (step.grasp.yaw, step.release.yaw) = (step.grasp.yaw - PI, step.release.yaw - PI), &[]);
    mutant(|step| step.turn = Some(0.8 + 1e-10), &[]);
}

#[test]
fn turned_by_a_hundredth_it_does_not_hold() {
    mutant(|step| step.grasp.yaw += 0.01, &[NoSuchGrasp]);
    mutant(|step| step.release.yaw += 0.01, &[WrongTurn]);
    mutant(|step| step.release.yaw += PI, &[WrongTurn]);
    mutant(|step| step.turn = Some(0.81), &[WrongTurn]);
    mutant(|step| step.turn = Some(0.8 - TAU), &[WrongTurn]);
    mutant(|step| step.turn = Some(f64::NAN), &[WrongTurn, WrongTurn]);
    mutant(|step| step.to.yaw = Some(1.11), &[WrongTurn, WrongTurn]);
    mutant(|step| step.from.as_mut().unwrap().yaw = Some(0.31), &[WrongFrom]);
}

#[test]
fn over_another_point_it_does_not_hold() {
    mutant(|step| step.grasp.at.as_mut().unwrap().x += 0.001, &[NoSuchGrasp]);
    mutant(|step| step.release.at.as_mut().unwrap().x += 0.001, &[WrongAxis]);
    let mut statement = plan();
    statement.target_grasp.as_mut().unwrap().at = Some(Point2::new(1.5, 0.401));
    assert_eq!(codes(&scene(), &statement), [WrongAxis]);
}

#[test]
fn what_is_left_out_or_no_number_is_told() {
    mutant(|step| step.to.yaw = None, &[MissingPart]);
    mutant(|step| step.to.yaw = Some(f64::NAN), &[NumberOutOfRange]);
    mutant(|step| step.grasp.yaw = f64::INFINITY, &[NumberOutOfRange]);
    mutant(|step| step.release.yaw = f64::NAN, &[NumberOutOfRange]);
    mutant(|step| step.grasp.slack = Some(0.04), &[WrongSlack]);
    mutant(|step| step.release.slack = Some(f64::NAN), &[NumberOutOfRange]);
}

#[test]
fn a_jaw_a_millimetre_into_a_neighbour_is_told() {
    let report = |nearer: [f64; 2], height: f64| {
        let scene = crowd(nearer).height("bottle", height).build("t");
        let faults = check_on(&scene, &plan(), &Terms::default(), &Budget::unlimited()).faults;
        faults.into_iter().map(|fault| (fault.code, fault.detail)).collect::<Vec<_>>()
    };
    assert_eq!(report([0.0005, 0.0], 0.3), []);
    let jaw = report([0.001, 0.0], 0.3);
    assert_eq!(jaw[0].0, GraspBlocked);
    assert!(jaw[0].1.starts_with("a finger comes 0.0004") && jaw[0].1.contains("'tray'"), "{jaw:?}");
    let palm = report([0.0, 0.001], 0.3);
    assert_eq!(palm[0].0, GraspBlocked);
    assert!(palm[0].1.starts_with("the palm comes 0.000500000 m too near to 'bottle'"), "{palm:?}");
    // A palm passes over what is no taller than the fingers are long.
    assert_eq!(report([0.0, 0.001], 0.1), []);
}

#[test]
fn fingers_pass_over_what_is_low_only_if_the_grasped_is_high() {
    let on =
        |tray: f64, held: f64| codes(&crowd([0.01, 0.0]).height("tray", tray).height("box", held).build("t"), &plan());
    assert_eq!(on(0.02, 0.05), [GraspBlocked]);
    assert_eq!(on(0.02, 0.12), []);
    assert_eq!(on(0.021, 0.12), [GraspBlocked]);
}

#[test]
fn a_grasp_or_an_object_that_is_too_wide_is_told() {
    let lengthwise = |pose: [f64; 3]| StatedGrasp { yaw: pose[2], ..grasp(pose) };
    let mut statement = plan();
    assert_eq!(codes(&crowd([0.0; 2]).max_opening(0.09).build("t"), &statement), []);
    assert_eq!(codes(&crowd([0.0; 2]).max_opening(0.061).build("t"), &statement), [TooWide]);
    let step = statement.relocations.as_mut().unwrap()[0].pick_place_mut().unwrap();
    (step.grasp, step.release) = (lengthwise(FROM), lengthwise(TO));
    assert_eq!(codes(&crowd([0.0; 2]).max_opening(0.09).build("t"), &statement), [TooWide, TooWide]);
}

#[test]
fn a_turn_as_far_as_the_band_is_forgiven_where_places_are() {
    let mut statement = plan();
    let step = statement.relocations.as_mut().unwrap()[0].pick_place_mut().unwrap();
    let beside = [FROM[0] + 0.002, FROM[1], FROM[2] + 0.03];
    (step.from, step.grasp, step.turn) = (Some(pose(beside)), grasp(beside), Some(0.77));
    let tolerant = Terms { position_tolerance: 0.005, ..Terms::default() };
    assert_eq!(codes_on(&scene(), &statement, &tolerant), []);
    assert_eq!(codes(&scene(), &statement), [WrongFrom, WrongFrom, NoSuchGrasp]);
}

#[test]
fn a_new_place_holds_the_whole_footprint() {
    let moved = |to: [f64; 3]| {
        let mut statement = plan();
        let step = statement.relocations.as_mut().unwrap()[0].pick_place_mut().unwrap();
        (step.to, step.release, step.turn) = (pose(to), grasp(to), None);
        codes(&crowd([0.0; 2]).keep_out([1.0, 1.5, 1.2, 1.7]).build("t"), &statement)
    };
    // Half its diagonal is 0.0583 m.
    assert_eq!(moved([0.05, 1.0, 0.0]), []);
    assert_eq!(moved([0.049, 1.0, 0.0]), [OffTable]);
    assert_eq!(moved([0.03, 1.0, FRAC_PI_2]), []);
    assert_eq!(moved([0.05, 1.0, 0.5]), [OffTable]);
    assert_eq!(moved([0.95, 1.6, 0.0]), []);
    assert_eq!(moved([0.95, 1.6, 0.01]), [InKeepOut]);
    // With an end at the target, whose edge is at 1.48.
    assert_eq!(moved([1.43, 0.4, 0.0]), []);
    assert_eq!(moved([1.4301, 0.4, 0.0]), [TooClose]);
}

/// A box between two fixed bars that leave no room for jaws across it, and `gap` m beside its ends.
fn locked(gap: f64) -> Scene {
    TestScene::new(2)
        .rectangle("box", [1.0, 1.0, 0.0], [0.1, 0.06])
        .rectangle("above", [1.0, 1.06, 0.0], [0.3, 0.05])
        .rectangle("below", [1.0, 0.94, 0.0], [0.3, 0.05])
        .rectangle("right", [1.05 + gap + 0.02, 1.0, 0.0], [0.04, 0.06])
        .rectangle("left", [0.95 - gap - 0.02, 1.0, 0.0], [0.04, 0.06])
        .fix("above")
        .fix("below")
        .fix("right")
        .fix("left")
        .build("box")
}

#[test]
fn a_lock_of_boxes_holds_and_its_members_are_needed() {
    let ids = |ids: &[&str]| ids.iter().map(|id| (*id).to_owned()).collect::<Vec<_>>();
    let deadlock = |members: &[&str]| Statement {
        verdict: Some(Verdict::Deadlock),
        deadlock: Some(Deadlock { blocked: ids(members), core: ids(members) }),
        ..Statement::default()
    };
    let all = deadlock(&["box", "above", "below", "right", "left"]);
    assert_eq!(codes(&locked(0.02), &all), []);
    assert_eq!(codes(&locked(0.02), &deadlock(&["box", "above", "right"])), []);
    assert_eq!(codes(&locked(0.02), &deadlock(&["box", "above"])), [LockMemberFree, LockMemberFree]);
    // The jaws across the ends reach 0.05 m and what turning adds beyond them.
    assert_eq!(codes(&locked(0.052), &all), [LockMemberFree, LockMemberFree]);
    assert_eq!(codes(&locked(0.05), &all), []);
}

#[test]
fn a_disc_among_boxes_is_free_where_its_fingers_fit() {
    let between = |gap: f64| {
        let bar = |scene: TestScene, id: &str, y: f64| scene.rectangle(id, [1.0, y, 0.0], [0.5, 0.04]).fix(id);
        let scene = TestScene::new(2).disc("t", 1.0, 1.0, 0.04);
        bar(bar(scene, "above", 1.02 + gap), "below", 0.98 - gap).build("t")
    };
    let free = Statement { verdict: Some(Verdict::Deadlock), ..Statement::default() };
    let ids = |ids: &[&str]| ids.iter().map(|id| (*id).to_owned()).collect::<Vec<_>>();
    let lock = ["t", "above", "below"];
    let stated = Statement { deadlock: Some(Deadlock { blocked: ids(&lock), core: ids(&lock) }), ..free };
    // Fingers 0.02 m wide lie between the bars whatever they are, but for the last digits.
    assert_eq!(codes(&between(0.041), &stated), [LockMemberFree, LockMemberFree]);
    let along = StatedGrasp { at: None, yaw: 0.0, slack: None };
    let grasped = Statement { target_grasp: Some(along), relocations: Some(Vec::new()), ..Statement::default() };
    assert_eq!(codes(&between(0.041), &grasped), []);
    let across = Statement { target_grasp: Some(StatedGrasp { yaw: FRAC_PI_2, ..along }), ..grasped };
    assert_eq!(codes(&between(0.041), &across), [TargetBlocked]);
}

#[test]
fn an_object_as_low_as_the_fingertips_has_no_grasp() {
    let flat = ObjectDraft {
        id: Some("mat".into()),
        x: Some(1.5),
        y: Some(1.5),
        shape: ShapeDraft::disc(0.05),
        height: Some(0.001),
        ..ObjectDraft::default()
    };
    let scene = crowd([0.0; 2]).tip_height(0.001).object(flat).build("t");
    let mut statement = plan();
    let step = statement.relocations.as_mut().unwrap()[0].pick_place_mut().unwrap();
    step.object = "mat".into();
    assert_eq!(codes(&scene, &statement), [TooWide]);
}
