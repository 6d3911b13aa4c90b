//! Bounds, locks and derivations.

use singulate_planner::check::FaultCode::{self, *};
use singulate_planner::cost::Cost;
use singulate_planner::scene::Scene;
use singulate_planner::statement::{Deadlock, Statement, Verdict};

use super::scenes::*;

#[track_caller]
fn expect(scene: &Scene, stated: &Statement, expected: &[FaultCode]) {
    let report = judge(scene, stated);
    assert_eq!(codes(&report), expected, "{:#?}", report.faults);
}

fn bound(lower_bound: u64, landmarks: &[&[&str]]) -> Statement {
    let landmarks = Some(landmarks.iter().map(|members| ids(members)).collect());
    let lower_bound = Some(Cost::new(lower_bound));
    Statement { verdict: Some(Verdict::TimedOut), lower_bound, landmarks, ..Statement::default() }
}

#[test]
fn a_landmark_may_offer_a_choice() {
    // Posts that can be moved: now the target is free along x or along y.
    let scene = gate().build("target");
    let cross: &[&[&str]] = &[&["west", "north"], &["west", "south"], &["east", "north"], &["east", "south"]];
    expect(&scene, &bound(2, cross), &[]);
    expect(&scene, &bound(3, cross), &[BoundUnproven]);
    expect(&scene, &bound(1, &[&["west"]]), &[LandmarkRefuted, BoundUnproven]);
    assert_eq!(judge(&scene, &bound(1, cross)).proven_bound, Cost::new(2));
}

#[test]
fn a_refused_proof_carries_what_was_tried() {
    let detail = |scene: &Scene, stated: &Statement| judge(scene, stated).faults[0].detail.clone();
    let refuted = detail(&gate().build("target"), &bound(1, &[&["west"]]));
    assert!(refuted.starts_with("landmark 0 can be left as it stands: the target is free at yaw "), "{refuted}");
    assert!(refuted.contains("'north'") && !refuted.contains("'west'"), "{refuted}");
    let free = detail(&locked(), &deadlock(&["target", "north", "south", "east", "far"], &LOCK));
    assert!(free.starts_with("can be grasped at yaw ") && free.ends_with("though all of 'blocked' stand"), "{free}");
}

#[test]
fn a_landmark_is_judged_by_the_table_as_it_is_at_the_start() {
    // So wide a band that one disc near the target blocks it altogether.
    let scene = Builder::new(2).yaw_tolerance(1.5).disc("t", 1.0, 1.0, 0.05).disc("far", 0.3, 0.3, 0.05).build("t");
    let relocations = Some(vec![step("far", [1.12, 1.0], 0.0, 0.0)]);
    let stated =
        Statement { verdict: None, relocations, target_grasp: Some(grasp(0.0, 1.57)), ..bound(1, &[&["far"]]) };
    expect(&scene, &stated, &[ReleaseBlocked, TargetBlocked, LandmarkRefuted, BoundUnproven]);
}

#[test]
fn no_landmarks_prove_nothing() {
    let scene = gate_with_posts();
    expect(&scene, &Statement { lower_bound: Some(Cost::ZERO), ..Statement::default() }, &[]);
    expect(&scene, &Statement { lower_bound: Some(Cost::new(1)), ..Statement::default() }, &[BoundUnproven]);
    expect(&scene, &Statement { optimal: Some(true), ..Statement::default() }, &[UnexpectedPart]);
    // Without a plan there is no cost that a bound could meet.
    let unplanned = Statement { relocations: Some(Vec::new()), optimal: Some(false), ..bound(0, &[]) };
    expect(&scene, &unplanned, &[]);
}

#[test]
fn a_graspable_target_costs_nothing() {
    let scene = gate().build("far");
    let stated = Statement {
        verdict: Some(Verdict::Graspable),
        relocations: Some(Vec::new()),
        target_grasp: Some(grasp(0.0, 1.57)),
        cost: Some(Cost::ZERO),
        lower_bound: Some(Cost::ZERO),
        optimal: Some(true),
        landmarks: Some(Vec::new()),
        ..Statement::default()
    };
    assert_valid(&scene, &stated);
    expect(&scene, &Statement { cost: Some(Cost::new(1)), ..stated.clone() }, &[WrongCost]);
    expect(&scene, &Statement { optimal: Some(false), ..stated.clone() }, &[WrongOptimal]);
    expect(&scene, &Statement { target_grasp: None, ..stated.clone() }, &[MissingPart]);
    expect(&scene, &Statement { verdict: Some(Verdict::Relocate), ..stated }, &[WrongCost]);
}

/// `east` can't be moved either, so nothing frees the target.
fn locked() -> Scene {
    gate().fix("north").fix("south").fix("east").build("target")
}

fn deadlock(blocked: &[&str], core: &[&str]) -> Statement {
    let deadlock = Some(Deadlock { blocked: ids(blocked), core: ids(core) });
    Statement { verdict: Some(Verdict::Deadlock), deadlock, ..Statement::default() }
}

const LOCK: [&str; 4] = ["target", "north", "south", "east"];

#[test]
fn a_lock_holds() {
    assert_valid(&locked(), &deadlock(&LOCK, &LOCK));
}

#[test]
fn a_forged_lock_is_seen() {
    let scene = locked();
    // Without `east` the target can wait for `west` to go.
    expect(&scene, &deadlock(&LOCK, &["target", "north", "south"]), &[LockMemberFree]);
    expect(&scene, &deadlock(&LOCK, &["north"]), &[LockWithoutTarget]);
    expect(&scene, &deadlock(&LOCK, &[]), &[LockWithoutTarget]);
    // `far` is free.
    expect(&scene, &deadlock(&["target", "north", "south", "east", "far"], &LOCK), &[LockMemberFree]);
    expect(&scene, &deadlock(&["target", "west", "north", "south", "east"], &LOCK), &[LockMemberFree]);
    expect(&scene, &deadlock(&LOCK, &["target", "north", "south", "east", "nobody"]), &[UnknownObject]);
    let outside = deadlock(&LOCK, &["target", "north", "south", "east", "far"]);
    expect(&scene, &outside, &[CoreOutsideBlocked, LockMemberFree]);
    // The same words for a scene in which `east` can go.
    let report = judge(&gate_with_posts(), &deadlock(&LOCK, &LOCK));
    assert_eq!(codes(&report), [LockMemberFree]);
    assert_eq!(report.faults[0].object.as_deref(), Some("east"));
}

#[test]
fn a_deadlock_comes_without_a_plan() {
    let stated = Statement { relocations: gate_plan().relocations, ..deadlock(&LOCK, &LOCK) };
    let report = judge(&locked(), &stated);
    assert!(codes(&report).contains(&UnexpectedPart), "{:#?}", report.faults);
    let silent = Statement { verdict: None, target_grasp: Some(grasp(0.0, 0.0)), ..deadlock(&LOCK, &LOCK) };
    expect(&locked(), &silent, &[UnexpectedPart, TargetBlocked]);
    let dear = Statement { cost: Some(Cost::new(3)), ..deadlock(&LOCK, &LOCK) };
    expect(&locked(), &dear, &[UnexpectedPart]);
}

#[test]
fn needed_objects_are_lifted_in_their_order() {
    let scene = gate_with_posts();
    let needed = |names: &[&str]| Statement {
        verdict: Some(Verdict::NoSpace),
        needed: Some(ids(names)),
        lower_bound: Some(Cost::new(3)),
        landmarks: gate_plan().landmarks,
        ..Statement::default()
    };
    assert_valid(&scene, &needed(&["cap", "west", "east"]));
    assert_valid(&scene, &needed(&["east", "cap", "west", "far"]));
    expect(&scene, &needed(&["west", "cap", "east"]), &[WrongNeeded]);
    expect(&scene, &needed(&["cap", "west"]), &[WrongNeeded]);
    expect(&scene, &needed(&["cap", "cap", "west", "east"]), &[WrongNeeded]);
    expect(&scene, &needed(&["cap", "west", "east", "north"]), &[WrongNeeded]);
    expect(&scene, &needed(&["cap", "west", "east", "nobody"]), &[UnknownObject]);
}

#[test]
fn nothing_is_needed_where_nothing_blocks_or_only_touches() {
    use core::f64::consts::FRAC_PI_2;
    let nothing = Statement { needed: Some(Vec::new()), ..Statement::default() };
    let alone = Builder::new(2).yaw_tolerance(3.0).disc("t", 1.0, 1.0, 0.05).build("t");
    assert_valid(&alone, &nothing);
    // The outer corner passes in touch with the disc.
    let touch = 1.0 + (0.01_f64 + 0.0001).sqrt() + 0.05;
    let scene =
        |x| Builder::new(2).yaw_tolerance(FRAC_PI_2).disc("t", 1.0, 1.0, 0.05).disc("o", x, 1.0, 0.05).build("t");
    assert_valid(&scene(touch), &nothing);
    expect(&scene(touch - 1e-6), &nothing, &[WrongNeeded]);
}
