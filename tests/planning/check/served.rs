//! Answers of the planner with one thing taken away or added: the proofs say that none of these can hold.

use singulate::experiments::varied;
use singulate_planner::budget::Budget;
use singulate_planner::plan::check::FaultCode::*;
use singulate_planner::plan::{Claim, Settings, plan};
use singulate_planner::scene::{Scene, SceneLimits};

use super::scenes::*;

/// A scene and the claim of its answer.
fn served(seed: u64) -> (Scene, Claim) {
    let (scene, _) = Scene::new(varied(seed), &SceneLimits::default()).expect("a sound scene");
    let answer = plan(&scene, &Settings::default(), &Budget::unlimited()).expect("an answer that passes");
    let claim = Claim::of(&scene, &answer);
    assert_valid(&scene, &claim);
    (scene, claim)
}

/// An optimal plan without one of its steps would be shorter than the shortest.
fn shortened(scene: &Scene, claim: &Claim) {
    let steps = claim.relocations.as_ref().expect("a plan");
    for at in 0..steps.len() {
        let mut steps = steps.clone();
        steps.remove(at);
        steps.iter_mut().for_each(|step| step.gap = None);
        let shorter = Claim { relocations: Some(steps), target_grasp: claim.target_grasp, ..Claim::default() };
        let faults = codes(&judge(scene, &shorter));
        assert!(!faults.is_empty(), "step {at} is needless: {claim:?}");
    }
}

/// No landmarks prove more than the cost of a plan that holds.
fn raised(scene: &Scene, claim: &Claim) {
    let raised = Claim { lower_bound: claim.cost.map(|cost| cost + 1), ..claim.clone() };
    assert!(codes(&judge(scene, &raised)).contains(&BoundUnproven));
}

/// The core is the least of its kind, so no member can be missed.
fn thinned(scene: &Scene, claim: &Claim) {
    let deadlock = claim.deadlock.as_ref().expect("a deadlock");
    for at in 0..deadlock.core.len() {
        let mut thinner = deadlock.clone();
        thinner.core.remove(at);
        let faults = codes(&judge(scene, &Claim { deadlock: Some(thinner), ..claim.clone() }));
        assert!(faults.contains(&LockMemberFree) || faults.contains(&LockWithoutTarget), "{at} of {deadlock:?}");
    }
}

#[test]
fn no_served_answer_still_holds_with_less() {
    let (mut plans, mut locks) = (0, 0);
    for seed in 0..300 {
        let (scene, claim) = served(seed);
        if claim.deadlock.is_some() {
            locks += 1;
            thinned(&scene, &claim);
        } else if claim.relocations.as_ref().is_some_and(|steps| !steps.is_empty()) {
            plans += 1;
            raised(&scene, &claim);
            if claim.optimal == Some(true) {
                shortened(&scene, &claim);
            }
        }
    }
    assert!(plans > 20 && locks > 20, "{plans} plans, {locks} locks");
}
