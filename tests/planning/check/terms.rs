//! A plan that is being carried out: is what is left of it still valid?

use core::f64::consts::FRAC_PI_2;

use nalgebra::Point2;
use singulate_planner::budget::Budget;
use singulate_planner::check::FaultCode::{self, *};
use singulate_planner::check::{Report, Terms, check_on};
use singulate_planner::cost::Cost;
use singulate_planner::scene::Scene;
use singulate_planner::statement::Statement;

use super::scenes::*;

const PART: Terms = Terms { position_tolerance: 0.0, partial: true };

fn ask(terms: &Terms, scene: &Scene, stated: &Statement) -> Report {
    check_on(scene, stated, terms, &Budget::unlimited())
}

#[track_caller]
fn expect(terms: &Terms, scene: &Scene, stated: &Statement, failing: Option<usize>, expected: &[FaultCode]) {
    let report = ask(terms, scene, stated);
    assert_eq!((report.first_failing_step, codes(&report)), (failing, expected.to_vec()), "{:#?}", report.faults);
}

/// The gate after so many of its steps, each object off by `off` m along both axes.
fn after(steps: usize, off: f64) -> Scene {
    let mut gate = gate();
    for step in &gate_plan().steps()[..steps] {
        let to = step.rests_at().unwrap().at;
        gate = gate.move_to(step.object(), to.x, to.y);
    }
    gate.shift(off).fix("north").fix("south").build("target")
}

/// The steps from `first` on.
fn rest(first: usize) -> Statement {
    let plan = gate_plan();
    Statement { relocations: Some(plan.steps()[first..].to_vec()), ..plan }
}

#[test]
fn the_steps_that_are_left_hold_after_those_that_were_carried_out() {
    for done in 0..=3 {
        expect(&PART, &after(done, 0.0), &rest(done), None, &[]);
    }
    // As a whole plan it would be one of three relocations that has fewer.
    assert!(codes(&ask(&Terms::default(), &after(1, 0.0), &rest(1))).contains(&WrongCost));
}

#[test]
fn the_next_step_alone_needs_no_final_grasp() {
    let next = Statement { target_grasp: None, relocations: Some(gate_plan().steps()[..1].to_vec()), ..gate_plan() };
    expect(&PART, &after(0, 0.0), &next, None, &[]);
    // With it, the two others are still in the way.
    let grasped = Statement { target_grasp: gate_plan().target_grasp, ..next };
    expect(&PART, &after(0, 0.0), &grasped, Some(1), &[TargetBlocked]);
}

#[test]
fn objects_may_stand_as_far_off_as_the_tolerance_says() {
    let scene = after(0, 1e-4);
    let off = 2.0_f64.sqrt() * 1e-4;
    let within = |position_tolerance| Terms { position_tolerance, partial: true };
    expect(&within(0.0), &scene, &rest(0), Some(0), &[WrongFrom]);
    expect(&within(off - 1e-6), &scene, &rest(0), Some(0), &[WrongFrom]);
    expect(&within(off + 1e-6), &scene, &rest(0), None, &[]);
    // `west` is put where it touches `far` as stated, but `far` stands nearer now: the stated places are not shifted.
    expect(&within(off + 1e-6), &after(0, -1e-4), &rest(0), Some(1), &[TooClose]);
}

#[test]
fn the_grippers_axis_moves_along_with_the_object() {
    let tolerant = Terms { position_tolerance: 0.03, partial: true };
    // At yaw 0 a finger ends 10 cm beside the axis. The post begins 11 cm beside x = 1.0.
    let grasped = |stands: f64, stated: f64, failing, expected: &[FaultCode]| {
        let scene = Builder::new(2)
            .disc("target", 0.3, 0.3, 0.05)
            .disc("cup", stands, 1.0, 0.05)
            .disc("post", 1.16, 1.0, 0.05)
            .build("target");
        let mut next = Statement { relocations: Some(vec![step("cup", [1.6, 1.6], 0.0, 0.0)]), ..Statement::default() };
        step_mut(&mut next, 0).from = Some(Point2::new(stated, 1.0).into());
        expect(&tolerant, &scene, &next, failing, expected);
    };
    grasped(1.02, 1.0, Some(0), &[GraspBlocked]);
    grasped(1.0, 1.02, None, &[]);
    grasped(0.98, 1.02, Some(0), &[WrongFrom]);
}

#[test]
fn stated_slacks_and_gaps_are_those_of_a_whole_plan_on_the_scene_as_it_was() {
    let mut stated = gate_plan();
    stated.target_grasp = Some(grasp(0.0, FRAC_PI_2));
    step_mut(&mut stated, 0).gap = Some(0.5);
    expect(&Terms::default(), &after(0, 0.0), &stated, Some(0), &[WrongGap, TargetBlocked]);
    // With a tolerance, or of a part, only the yaw itself has to be free.
    expect(&Terms { position_tolerance: 1e-3, partial: false }, &after(0, 0.0), &stated, None, &[]);
    expect(&PART, &after(0, 0.0), &stated, None, &[]);
}

#[test]
fn the_first_failing_step_is_the_first_that_fails() {
    let scene = gate_with_posts();
    let whole = Terms::default();
    let failing = |mutate: fn(&mut Statement)| {
        let mut stated = gate_plan();
        mutate(&mut stated);
        ask(&whole, &scene, &stated).first_failing_step
    };
    assert_eq!(failing(|_| {}), None);
    assert_eq!(failing(|stated| step_mut(stated, 1).grasp.yaw = 0.0), Some(1));
    assert_eq!(failing(|stated| step_mut(stated, 2).to.at.x += 1.0), Some(2));
    assert_eq!(failing(|stated| stated.target_grasp = Some(grasp(FRAC_PI_2, 0.0))), Some(3));
    assert_eq!(failing(|stated| stated.target_grasp = None), Some(3));
    let several = |stated: &mut Statement| {
        step_mut(stated, 1).grasp.yaw = 0.0;
        stated.target_grasp = None;
    };
    assert_eq!(failing(several), Some(1));
    // What is no step of it can be carried out all the same.
    assert_eq!(failing(|stated| stated.lower_bound = Some(Cost::new(2))), None);
    assert_eq!(failing(|stated| stated.landmarks = None), None);
}
