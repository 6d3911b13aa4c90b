//! The physical rules at their limits: what touches is free, what is a micrometre further is not.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use singulate_planner::check::FaultCode::{self, *};
use singulate_planner::scene::Scene;
use singulate_planner::statement::{StatedGrasp, Statement, Step, Verdict};

use super::scenes::*;

fn just_grasp(yaw: f64, slack: Option<f64>) -> Statement {
    let target_grasp = Some(StatedGrasp { at: None, yaw, slack });
    Statement { target_grasp, ..Statement::default() }
}

#[track_caller]
fn expect(scene: &Scene, stated: &Statement, expected: &[FaultCode]) {
    let report = judge(scene, stated);
    assert_eq!(codes(&report), expected, "{:#?}", report.faults);
}

#[test]
fn a_disc_that_touches_the_fingers_does_not_block() {
    for (beyond, expected) in [(0.0, &[][..]), (-1e-6, &[TargetBlocked]), (1e-6, &[])] {
        // Before the tip, and beside the finger.
        let before = Builder::new(3).disc("t", 1.0, 1.0, 0.05).disc("o", 1.1 + 0.07 + beyond, 1.0, 0.07).build("t");
        expect(&before, &just_grasp(0.0, None), expected);
        let beside = Builder::new(3).disc("t", 1.0, 1.0, 0.05).disc("o", 1.075, 1.02 + beyond, 0.01).build("t");
        expect(&beside, &just_grasp(0.0, None), expected);
    }
}

#[test]
fn the_tip_is_free_where_only_the_corners_are_blocked() {
    // Wide fingers, and a pin that the tip clears straight ahead but not when a corner comes past.
    let scene = Builder::new(2).disc("t", 1.0, 1.0, 0.05).disc("pin", 1.1015, 1.0, 0.001).build("t");
    expect(&scene, &just_grasp(0.0, Some(0.02)), &[]);
    expect(&scene, &just_grasp(0.0, Some(FRAC_PI_2)), &[]);
    let nearer = Builder::new(2).disc("t", 1.0, 1.0, 0.05).disc("pin", 1.1012, 1.0, 0.001).build("t");
    expect(&nearer, &just_grasp(0.0, Some(0.0)), &[]);
    // Neither end of the band meets the pin, but a yaw between does.
    expect(&nearer, &just_grasp(0.0, Some(1.0)), &[TargetBlocked]);
    expect(&nearer, &just_grasp(1.0, Some(0.5)), &[]);
}

#[test]
fn the_whole_band_of_the_yaw_tolerance_must_be_free() {
    let scene = |tolerance| gate().fix("north").fix("south").yaw_tolerance(tolerance).build("target");
    let mut stated = gate_plan();
    // The target's yaw may be off by 0.81 rad, `cap`'s by 0.168.
    assert_valid(&scene(0.1), &stated);
    expect(&scene(0.15), &stated, &[WrongSlack]);
    for step in stated.relocations.iter_mut().flatten().filter_map(Step::pick_place_mut) {
        (step.grasp.slack, step.release.slack) = (None, None);
    }
    assert_valid(&scene(0.15), &stated);
    expect(&scene(0.2), &stated, &[GraspBlocked]);
}

#[test]
fn a_tolerance_of_half_a_turn_matters_only_where_something_blocks() {
    let alone = Builder::new(2).yaw_tolerance(PI).disc("t", 1.0, 1.0, 0.05).build("t");
    let stated = Statement { verdict: Some(Verdict::Graspable), ..just_grasp(0.3, Some(FRAC_PI_2)) };
    expect(&alone, &stated, &[]);
    let pair = Builder::new(2).yaw_tolerance(PI).disc("t", 1.0, 1.0, 0.05).disc("o", 1.1, 1.0, 0.05).build("t");
    expect(&pair, &stated, &[TargetBlocked]);
}

#[test]
fn a_yaw_is_judged_modulo_the_turn_between_fingers() {
    let scene = gate_with_posts();
    for turns in [-3.0, -1.0, 1.0, 2.0, 1e5] {
        let mut stated = gate_plan();
        stated.target_grasp = Some(grasp(turns * PI, 0.7));
        assert_valid(&scene, &stated);
        step_mut(&mut stated, 1).grasp.yaw += turns * TAU;
        assert_valid(&scene, &stated);
    }
}

#[test]
fn the_margin_holds_between_fingers_and_obstacles() {
    let scene = |margin| Builder::new(3).margin(margin).disc("t", 1.0, 1.0, 0.05).disc("o", 1.18, 1.0, 0.07).build("t");
    expect(&scene(0.01), &just_grasp(0.0, None), &[]);
    expect(&scene(0.010_001), &just_grasp(0.0, None), &[TargetBlocked]);
}

/// `a` and `b` stand 2 mm apart, `e` alone; the margin is 10 mm, and fingers have it too.
fn near_pair() -> Scene {
    Builder::new(2)
        .margin(0.01)
        .disc("t", 1.5, 1.5, 0.05)
        .disc("a", 0.5, 0.5, 0.05)
        .disc("b", 0.602, 0.5, 0.05)
        .disc("e", 0.5, 1.5, 0.05)
        .build("t")
}

fn moves(steps: &[(&str, [f64; 2])]) -> Statement {
    let steps = steps.iter().map(|(object, to)| step(object, *to, FRAC_PI_2, FRAC_PI_2)).collect();
    Statement { relocations: Some(steps), ..just_grasp(0.0, None) }
}

#[test]
fn the_margin_holds_at_a_new_place_but_for_pairs_that_stood_closer() {
    let scene = near_pair();
    let check = |object, to: [f64; 2], expected: &[FaultCode]| expect(&scene, &moves(&[(object, to)]), expected);
    check("a", [0.39, 1.5], &[]);
    check("a", [0.391, 1.5], &[TooClose]);
    // Round `b`, on its other side.
    check("a", [0.704, 0.5], &[]);
    check("a", [0.703, 0.5], &[TooClose]);
    // The margin is not for the edge.
    check("a", [0.05, 1.0], &[]);
}

#[test]
fn discs_that_overlap_at_the_start_may_not_overlap_again() {
    let scene =
        Builder::new(2).disc("t", 1.5, 1.5, 0.05).disc("a", 0.5, 0.5, 0.05).disc("b", 0.5995, 0.5, 0.05).build("t");
    expect(&scene, &moves(&[("a", [0.6995, 0.5])]), &[]);
    expect(&scene, &moves(&[("a", [0.699, 0.5])]), &[TooClose]);
}

#[test]
fn an_object_may_move_twice_and_starts_where_it_was_put() {
    let scene = near_pair();
    let mut stated = moves(&[("a", [0.2, 0.2]), ("e", [0.5, 0.5]), ("a", [0.5, 1.5])]);
    assert_eq!(codes(&judge(&scene, &stated)), [TooClose], "e does not fit beside b");
    stated = moves(&[("a", [0.2, 0.2]), ("e", [0.49, 0.5]), ("a", [0.5, 1.5])]);
    step_mut(&mut stated, 2).from = Some(nalgebra::Point2::new(0.2, 0.2).into());
    expect(&scene, &stated, &[]);
    step_mut(&mut stated, 2).from = Some(nalgebra::Point2::new(0.5, 0.5).into());
    expect(&scene, &stated, &[WrongFrom]);
}

#[test]
fn what_was_put_down_is_in_the_way_and_what_was_lifted_is_not() {
    let scene = near_pair();
    // Beside the target, where only a finger along x reaches it.
    let beside = [1.62, 1.5];
    expect(&scene, &moves(&[("a", beside)]), &[TargetBlocked]);
    expect(&scene, &moves(&[("a", beside), ("a", [0.2, 0.2])]), &[]);
    expect(&scene, &moves(&[("a", [0.5, 1.0]), ("e", [0.5, 1.05])]), &[TooClose, ReleaseBlocked]);
    // One after the other on the same place.
    expect(&scene, &moves(&[("a", [0.5, 1.0]), ("a", [0.2, 0.2]), ("e", [0.5, 1.0])]), &[]);
}

#[test]
fn only_what_is_stated_is_checked() {
    let mut stated = Statement { relocations: gate_plan().relocations, ..Statement::default() };
    stated.target_grasp = gate_plan().target_grasp;
    assert_valid(&gate_with_posts(), &stated);
    assert_valid(&gate_with_posts(), &Statement::default());
}
