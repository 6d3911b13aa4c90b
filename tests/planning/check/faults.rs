//! One mutant for each kind of fault. Each is a plan that holds with one thing made wrong, and is caught for that thing.

use core::f64::consts::FRAC_PI_2;

use singulate_planner::check::FaultCode::{self, *};
use singulate_planner::cost::Cost;
use singulate_planner::statement::{PickPlace, Statement, Step, Verdict};

use super::scenes::*;

#[test]
fn the_plan_without_a_mutation_holds() {
    let scene = gate_with_posts();
    assert_valid(&scene, &gate_plan());
    assert_eq!(judge(&scene, &gate_plan()).proven_bound, Cost::new(3));
}

/// The mutant's faults are of these kinds and no others.
#[track_caller]
fn mutant(mutate: impl FnOnce(&mut Statement), expected: &[FaultCode]) {
    let mut stated = gate_plan();
    mutate(&mut stated);
    let report = judge(&gate_with_posts(), &stated);
    assert_eq!(codes(&report), expected, "{:#?}", report.faults);
}

fn steps(stated: &mut Statement) -> &mut Vec<Step> {
    stated.relocations.as_mut().expect("a plan with steps")
}

#[track_caller]
fn mutant_step(at: usize, mutate: impl FnOnce(&mut PickPlace), expected: &[FaultCode]) {
    mutant(
        |stated| {
            let step = step_mut(stated, at);
            step.gap = None;
            mutate(step);
        },
        expected,
    );
}

#[test]
fn two_dependent_steps_swapped_are_seen() {
    mutant(
        |stated| {
            steps(stated).swap(0, 1);
            steps(stated).iter_mut().filter_map(Step::pick_place_mut).for_each(|step| step.gap = None);
        },
        &[GraspBlocked],
    );
}

#[test]
fn a_needed_step_left_out_is_seen() {
    mutant(
        |stated| {
            steps(stated).pop();
            (stated.cost, stated.lower_bound, stated.optimal, stated.landmarks) = (None, None, None, None);
        },
        &[TargetBlocked],
    );
}

#[test]
fn a_place_one_millimetre_into_a_neighbour_is_seen() {
    mutant_step(1, |step| step.to.at.x += 1e-3, &[TooClose]);
}

#[test]
fn a_yaw_off_its_interval_is_seen() {
    mutant_step(1, |step| step.grasp.yaw = 1.0, &[GraspBlocked]);
    mutant_step(1, |step| step.release.yaw = 0.0, &[ReleaseBlocked]);
    mutant(|stated| stated.target_grasp = Some(grasp(FRAC_PI_2, 0.0)), &[TargetBlocked]);
}

#[test]
fn a_slack_past_the_free_interval_is_seen() {
    mutant_step(0, |step| step.grasp.slack = Some(0.2), &[GraspBlocked]);
    mutant(|stated| stated.target_grasp = Some(grasp(0.0, 0.9)), &[TargetBlocked]);
}

#[test]
fn a_slack_that_no_yaw_has_is_seen() {
    mutant_step(0, |step| step.release.slack = Some(FRAC_PI_2 + 1e-6), &[WrongSlack]);
    mutant_step(0, |step| step.release.slack = Some(-0.1), &[WrongSlack]);
}

#[test]
fn a_place_over_the_edge_is_seen() {
    mutant_step(2, |step| step.to.at.x += 1e-3, &[OffTable]);
    mutant_step(2, |step| step.to.at.y = -5.0, &[OffTable]);
}

#[test]
fn a_place_in_a_keep_out_is_seen() {
    mutant_step(0, |step| step.to.at.x -= 1e-3, &[InKeepOut]);
    mutant_step(0, |step| step.to.at.x = 0.12, &[InKeepOut]);
}

#[test]
fn a_moved_fixed_object_is_seen() {
    let forbidden = |object: &str| {
        let step = step(object, [0.3, 0.3], 0.0, 0.0);
        move |stated: &mut Statement| {
            steps(stated).push(step);
            let bound = Some(Cost::new(3));
            (stated.cost, stated.lower_bound, stated.optimal) = (Some(Cost::new(4)), bound, Some(false));
        }
    };
    mutant(forbidden("north"), &[FixedObjectMoved]);
    mutant(forbidden("target"), &[TargetMoved]);
    mutant(forbidden("nobody"), &[UnknownObject]);
}

#[test]
fn a_wrong_start_is_seen() {
    mutant_step(1, |step| step.from.as_mut().unwrap().at.y += 1e-6, &[WrongFrom]);
}

#[test]
fn a_wrong_gap_is_seen() {
    mutant_step(1, |step| step.gap = Some(1e-6), &[WrongGap]);
    mutant_step(0, |step| step.gap = Some(0.1), &[WrongGap]);
}

#[test]
fn a_forged_landmark_is_seen() {
    let add = |members: &[&str]| {
        let forged = ids(members);
        move |stated: &mut Statement| stated.landmarks.as_mut().unwrap().push(forged)
    };
    mutant(add(&["far"]), &[LandmarkRefuted]);
    mutant(add(&[]), &[BadLandmark]);
    mutant(add(&["cap", "target"]), &[BadLandmark]);
    mutant(add(&["cap", "north"]), &[BadLandmark]);
    mutant(add(&["nobody"]), &[UnknownObject]);
    // Not forged: it follows from another one.
    mutant(add(&["cap", "far"]), &[]);
}

#[test]
fn a_bound_one_too_high_is_seen() {
    mutant(|stated| stated.lower_bound = Some(Cost::new(4)), &[BoundUnproven, BoundAboveCost, WrongOptimal]);
    mutant(|stated| stated.landmarks.as_mut().unwrap().truncate(2), &[BoundUnproven]);
    mutant(|stated| stated.landmarks = None, &[BoundUnproven]);
    mutant(|stated| (stated.landmarks, stated.lower_bound) = (None, None), &[BoundUnproven]);
}

fn with_a_needless_move(stated: &mut Statement) {
    steps(stated).push(step("far", [0.3, 0.3], 1.5, 0.0));
    stated.cost = Some(Cost::new(4));
}

#[test]
fn a_needless_move_in_an_optimal_plan_is_seen() {
    mutant(with_a_needless_move, &[WrongOptimal]);
    let raised = |stated: &mut Statement| {
        with_a_needless_move(stated);
        stated.lower_bound = Some(Cost::new(4));
    };
    mutant(raised, &[BoundUnproven]);
    // Said plainly it is no fault.
    let honest = |stated: &mut Statement| {
        with_a_needless_move(stated);
        stated.optimal = Some(false);
    };
    mutant(honest, &[]);
}

#[test]
fn an_optimal_plan_said_not_to_be_is_seen() {
    mutant(|stated| stated.optimal = Some(false), &[WrongOptimal]);
    mutant(|stated| (stated.optimal, stated.lower_bound) = (Some(false), Some(Cost::new(2))), &[WrongOptimal]);
    let contradicts = |stated: &mut Statement| (stated.optimal, stated.landmarks) = (Some(false), None);
    mutant(contradicts, &[BoundUnproven, WrongOptimal]);
}

#[test]
fn a_wrong_cost_is_seen() {
    mutant(|stated| stated.cost = Some(Cost::new(2)), &[WrongCost]);
}

#[test]
fn parts_that_do_not_fit_the_verdict_are_seen() {
    mutant(|stated| stated.target_grasp = None, &[MissingPart]);
    mutant(|stated| stated.relocations = None, &[MissingPart, TargetBlocked]);
    mutant(|stated| stated.needed = Some(ids(&["cap", "west", "east"])), &[UnexpectedPart]);
    mutant(|stated| stated.verdict = Some(Verdict::NoSpace), &[UnexpectedPart]);
    mutant(|stated| stated.verdict = Some(Verdict::Graspable), &[UnexpectedPart, WrongCost]);
    mutant(|stated| stated.verdict = Some(Verdict::Deadlock), &[UnexpectedPart, MissingPart]);
}

#[test]
fn numbers_that_no_table_holds_are_seen() {
    for wild in [f64::NAN, f64::INFINITY, 1e300, -1e300] {
        mutant(
            |stated| {
                steps(stated).push(step("far", [wild, 0.3], 1.5, 0.0));
                (stated.cost, stated.optimal) = (Some(Cost::new(4)), Some(false));
            },
            &[NumberOutOfRange],
        );
        mutant_step(1, |step| step.grasp.yaw = wild, &[NumberOutOfRange]);
        mutant_step(1, |step| step.from.as_mut().unwrap().at.x = wild, &[WrongFrom]);
        mutant_step(1, |step| step.gap = Some(wild), &[WrongGap]);
    }
    mutant_step(1, |step| step.release.slack = Some(f64::NAN), &[NumberOutOfRange]);
    mutant_step(1, |step| step.grasp.yaw = 2e6, &[NumberOutOfRange]);
}

#[test]
fn a_fault_names_its_step_and_its_object() {
    let mut stated = gate_plan();
    let step = step_mut(&mut stated, 1);
    step.to.at.x += 1e-3;
    step.gap = None;
    let report = judge(&gate_with_posts(), &stated);
    let fault = &report.faults[0];
    assert_eq!((fault.code.name(), fault.step, fault.object.as_deref()), ("too_close", Some(1), Some("west")));
    assert!(fault.detail.contains("'far'"), "{}", fault.detail);
}
