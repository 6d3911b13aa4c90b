//! Bounds, locks and derivations.

use singulate_planner::plan::check::FaultCode::{self, *};
use singulate_planner::plan::{Claim, ClaimedDeadlock, VerdictName};
use singulate_planner::scene::Scene;

use super::scenes::*;

#[track_caller]
fn expect(scene: &Scene, claim: &Claim, expected: &[FaultCode]) {
    let report = judge(scene, claim);
    assert_eq!(codes(&report), expected, "{:#?}", report.faults);
}

fn bound(lower_bound: u64, landmarks: &[&[&str]]) -> Claim {
    let landmarks = Some(landmarks.iter().map(|members| ids(members)).collect());
    Claim { verdict: Some(VerdictName::TimedOut), lower_bound: Some(lower_bound), landmarks, ..Claim::default() }
}

#[test]
fn a_landmark_may_offer_a_choice() {
    // Posts that can be moved: now the target is free along x or along y.
    let scene = gate().build("target");
    let cross: &[&[&str]] = &[&["west", "north"], &["west", "south"], &["east", "north"], &["east", "south"]];
    expect(&scene, &bound(2, cross), &[]);
    expect(&scene, &bound(3, cross), &[BoundUnproven]);
    expect(&scene, &bound(1, &[&["west"]]), &[LandmarkRefuted, BoundUnproven]);
    assert_eq!(judge(&scene, &bound(1, cross)).proven_bound, 2);
}

#[test]
fn a_refused_proof_carries_what_was_tried() {
    let detail = |scene: &Scene, claim: &Claim| judge(scene, claim).faults[0].detail.clone();
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
    let claim = Claim { verdict: None, relocations, target_grasp: Some(grasp(0.0, 1.57)), ..bound(1, &[&["far"]]) };
    expect(&scene, &claim, &[ReleaseBlocked, TargetBlocked, LandmarkRefuted, BoundUnproven]);
}

#[test]
fn no_landmarks_prove_nothing() {
    let scene = gate_with_posts();
    expect(&scene, &Claim { lower_bound: Some(0), ..Claim::default() }, &[]);
    expect(&scene, &Claim { lower_bound: Some(1), ..Claim::default() }, &[BoundUnproven]);
    expect(&scene, &Claim { optimal: Some(true), ..Claim::default() }, &[UnexpectedPart]);
    // Without a plan there is no cost that a bound could meet.
    let unplanned = Claim { relocations: Some(Vec::new()), optimal: Some(false), ..bound(0, &[]) };
    expect(&scene, &unplanned, &[]);
}

#[test]
fn a_graspable_target_costs_nothing() {
    let scene = gate().build("far");
    let claim = Claim {
        verdict: Some(VerdictName::Graspable),
        relocations: Some(Vec::new()),
        target_grasp: Some(grasp(0.0, 1.57)),
        cost: Some(0),
        lower_bound: Some(0),
        optimal: Some(true),
        landmarks: Some(Vec::new()),
        ..Claim::default()
    };
    assert_valid(&scene, &claim);
    expect(&scene, &Claim { cost: Some(1), ..claim.clone() }, &[WrongCost]);
    expect(&scene, &Claim { optimal: Some(false), ..claim.clone() }, &[WrongOptimal]);
    expect(&scene, &Claim { target_grasp: None, ..claim.clone() }, &[MissingPart]);
    expect(&scene, &Claim { verdict: Some(VerdictName::Relocate), ..claim }, &[WrongCost]);
}

/// `east` can't be moved either, so nothing frees the target.
fn locked() -> Scene {
    gate().fix("north").fix("south").fix("east").build("target")
}

fn deadlock(blocked: &[&str], core: &[&str]) -> Claim {
    let deadlock = Some(ClaimedDeadlock { blocked: ids(blocked), core: ids(core) });
    Claim { verdict: Some(VerdictName::Deadlock), deadlock, ..Claim::default() }
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
    let claim = Claim { relocations: gate_plan().relocations, ..deadlock(&LOCK, &LOCK) };
    let report = judge(&locked(), &claim);
    assert!(codes(&report).contains(&UnexpectedPart), "{:#?}", report.faults);
    let silent = Claim { verdict: None, target_grasp: Some(grasp(0.0, 0.0)), ..deadlock(&LOCK, &LOCK) };
    expect(&locked(), &silent, &[UnexpectedPart, TargetBlocked]);
}

#[test]
fn needed_objects_are_lifted_in_their_order() {
    let scene = gate_with_posts();
    let needed = |names: &[&str]| Claim {
        verdict: Some(VerdictName::NoSpace),
        needed: Some(ids(names)),
        lower_bound: Some(3),
        landmarks: gate_plan().landmarks,
        ..Claim::default()
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
    let nothing = Claim { needed: Some(Vec::new()), ..Claim::default() };
    let alone = Builder::new(2).yaw_tolerance(3.0).disc("t", 1.0, 1.0, 0.05).build("t");
    assert_valid(&alone, &nothing);
    // The outer corner passes in touch with the disc.
    let touch = 1.0 + (0.01_f64 + 0.0001).sqrt() + 0.05;
    let scene =
        |x| Builder::new(2).yaw_tolerance(FRAC_PI_2).disc("t", 1.0, 1.0, 0.05).disc("o", x, 1.0, 0.05).build("t");
    assert_valid(&scene(touch), &nothing);
    expect(&scene(touch - 1e-6), &nothing, &[WrongNeeded]);
}
