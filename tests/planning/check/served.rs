//! Answers of the planner with one thing taken away or added: the proofs say that none of these can hold.

use singulate::experiments::varied;
use singulate_planner::budget::Budget;
use singulate_planner::check::FaultCode::*;
use singulate_planner::cost::Cost;
use singulate_planner::plan::{Settings, plan};
use singulate_planner::scene::{Scene, SceneLimits};
use singulate_planner::search::SILENT;
use singulate_planner::statement::{Statement, Step};

use super::scenes::*;

/// A scene and what its answer states.
fn served(seed: u64) -> (Scene, Statement) {
    let (scene, _) = Scene::new(varied(seed), &SceneLimits::default()).expect("a sound scene");
    let answer = plan(&scene, &Settings::default(), &Budget::unlimited(), SILENT).expect("an answer that passes");
    let stated = answer.statement;
    assert_valid(&scene, &stated);
    (scene, stated)
}

/// An optimal plan without one of its steps would be shorter than the shortest.
fn shortened(scene: &Scene, stated: &Statement) {
    let steps = stated.relocations.as_ref().expect("a plan");
    for at in 0..steps.len() {
        let mut steps = steps.clone();
        steps.remove(at);
        steps.iter_mut().filter_map(Step::pick_place_mut).for_each(|step| step.gap = None);
        let shorter = Statement { relocations: Some(steps), target_grasp: stated.target_grasp, ..Statement::default() };
        let faults = codes(&judge(scene, &shorter));
        assert!(!faults.is_empty(), "step {at} is needless: {stated:?}");
    }
}

/// No landmarks prove more than the cost of a plan that holds.
fn raised(scene: &Scene, stated: &Statement) {
    let raised = Statement { lower_bound: stated.cost.map(|cost| cost + Cost::new(1)), ..stated.clone() };
    assert!(codes(&judge(scene, &raised)).contains(&BoundUnproven));
}

/// The core is the least of its kind, so no member can be missed.
fn thinned(scene: &Scene, stated: &Statement) {
    let deadlock = stated.deadlock.as_ref().expect("a deadlock");
    for at in 0..deadlock.core.len() {
        let mut thinner = deadlock.clone();
        thinner.core.remove(at);
        let faults = codes(&judge(scene, &Statement { deadlock: Some(thinner), ..stated.clone() }));
        assert!(faults.contains(&LockMemberFree) || faults.contains(&LockWithoutTarget), "{at} of {deadlock:?}");
    }
}

#[test]
fn no_served_answer_still_holds_with_less() {
    let (mut plans, mut locks) = (0, 0);
    for seed in 0..300 {
        let (scene, stated) = served(seed);
        if stated.deadlock.is_some() {
            locks += 1;
            thinned(&scene, &stated);
        } else if !stated.steps().is_empty() {
            plans += 1;
            raised(&scene, &stated);
            if stated.optimal == Some(true) {
                shortened(&scene, &stated);
            }
        }
    }
    assert!(plans > 20 && locks > 20, "{plans} plans, {locks} locks");
}
