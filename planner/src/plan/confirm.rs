//! Every answer is checked before it is served.

use super::answer::{Answer, Statistics, Unplanned, Verdict};
use super::check::{Checker, Fault, FaultCode, MAX_FAULTS, Report};
use super::claim::Claim;
use super::warning::Warning;
use crate::budget::Budget;
use crate::knowledge::NoBase;
use crate::scene::Scene;

/// Why there is no answer.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// The checker refused the planner's own answer: a bug. The answer is not served.
    #[error("the answer did not pass its check")]
    Refused(Report),
    /// The objects are too dense: their knowledge base would exceed the limit
    /// ([`MAX_BASE_SIZE`](crate::knowledge::MAX_BASE_SIZE)).
    #[error("{}", NoBase::TooLarge)]
    TooDense,
}

/// The part of the verdict that the checker confirms. Its scene may have any target. Parts not confirmed in time are
/// dropped.
///
/// # Errors
/// [`PlanError::Refused`] if any part does not hold.
pub(super) fn confirm(
    checker: &mut Checker<'_>,
    scene: &Scene,
    verdict: Verdict,
    budget: &Budget<'_>,
) -> Result<Verdict, PlanError> {
    let (verdict, report) = checked(checker, scene, verdict, budget);
    if report.faults.iter().any(|fault| !is_late(fault.code)) {
        return Err(PlanError::Refused(report));
    }
    let unconfirmed = |code| report.faults.iter().any(|fault| fault.code == code);
    let late = unconfirmed(FaultCode::LockUnconfirmed) || unconfirmed(FaultCode::ReplayUnconfirmed);
    let mut verdict = proven_part(verdict, &report);
    if late {
        let bound = verdict.bound_mut().map(core::mem::take).unwrap_or_default();
        verdict = Verdict::TimedOut(Unplanned { bound: Some(bound), needed: None });
    }
    Ok(verdict)
}

/// The same for an answer by the paper's methods: a step that does not hold becomes a warning. A proof that does not
/// hold is refused, since proofs are our own. `setting` is named by a deadlock that can't be confirmed.
///
/// # Errors
/// [`PlanError::Refused`] if a landmark or a lock does not hold.
pub(super) fn confirm_unproven(
    scene: &Scene,
    verdict: Verdict,
    setting: &'static str,
    warnings: &mut Vec<Warning>,
    budget: &Budget<'_>,
) -> Result<Verdict, PlanError> {
    if verdict == Verdict::Deadlock(None) {
        return Ok(verdict);
    }
    let (verdict, report) = checked(&mut Checker::new(scene), scene, verdict, budget);
    let ours = |fault: &Fault| !is_late(fault.code) && is_of_a_proof(fault.code);
    if report.faults.iter().any(ours) {
        return Err(PlanError::Refused(report));
    }
    let mut verdict = proven_part(verdict, &report);
    let seen = |code| report.faults.iter().any(|fault| fault.code == code);
    // A list of faults that was cut off may lack those of the proofs.
    let cut = report.faults.len() >= MAX_FAULTS;
    match &mut verdict {
        Verdict::Relocate(plan) if cut => plan.bound = None,
        Verdict::Deadlock(proof) if cut || seen(FaultCode::LockUnconfirmed) => {
            *proof = None;
            warnings.push(Warning::UnprovenDeadlock { enough: None, setting });
        }
        _ => {}
    }
    if seen(FaultCode::WrongNeeded)
        && let Verdict::NoSpace(unplanned) | Verdict::TimedOut(unplanned) = &mut verdict
    {
        unplanned.needed = None;
    }
    let told = |fault: &Fault| !is_late(fault.code) || fault.code == FaultCode::ReplayUnconfirmed;
    warnings.extend(report.faults.into_iter().filter(told).map(Warning::Faulty));
    Ok(verdict)
}

fn checked(checker: &mut Checker<'_>, scene: &Scene, verdict: Verdict, budget: &Budget<'_>) -> (Verdict, Report) {
    let answer = Answer { verdict, warnings: Vec::new(), statistics: Statistics::default() };
    let mut claim = Claim::of(scene, &answer);
    // A search that was cut off may have landmarks that prove more than it could compute: not a fault, but a better
    // bound.
    claim.optimal.take_if(|optimal| !*optimal);
    let report = checker.check_for(scene, &claim, budget);
    (answer.verdict, report)
}

/// The verdict with the confirmed part of the bound, and the needed objects only if confirmed.
fn proven_part(mut verdict: Verdict, report: &Report) -> Verdict {
    let unconfirmed = |code| report.faults.iter().any(|fault| fault.code == code);
    if let Some(bound) = verdict.bound_mut() {
        // Landmarks that were not checked in time are dropped, even if the rest proves the bound.
        if report.interrupted {
            bound.landmarks.clone_from(&report.sound_landmarks);
        }
        bound.cost = report.proven_bound;
    }
    if unconfirmed(FaultCode::NeededUnconfirmed)
        && let Verdict::NoSpace(unplanned) | Verdict::TimedOut(unplanned) = &mut verdict
    {
        unplanned.needed = None;
    }
    verdict
}

/// True if the code refutes a bound or a lock.
fn is_of_a_proof(code: FaultCode) -> bool {
    matches!(
        code,
        FaultCode::BoundUnproven
            | FaultCode::BadLandmark
            | FaultCode::LandmarkRefuted
            | FaultCode::LockWithoutTarget
            | FaultCode::LockMemberFree
            | FaultCode::CoreOutsideBlocked
            | FaultCode::UnknownObject
            | FaultCode::MissingPart
            | FaultCode::UnexpectedPart
            | FaultCode::WrongCost
    )
}

/// True if the code means that time ran out, not that the answer is wrong.
fn is_late(code: FaultCode) -> bool {
    matches!(
        code,
        FaultCode::BoundUnconfirmed
            | FaultCode::LockUnconfirmed
            | FaultCode::NeededUnconfirmed
            | FaultCode::ReplayUnconfirmed
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::{LowerBound, Plan, Settings, plan};
    use crate::scene::scenes::TestScene;
    use crate::search::LeastSet;

    #[test]
    fn what_the_search_knows_but_cannot_show_is_not_served() {
        // Two fingers, and four plates round the target: two on opposite sides must be moved.
        let scene = TestScene::new(2)
            .finger(0.04, 0.05)
            .disc("cup", 1.0, 1.0, 0.03)
            .disc("east", 1.13, 1.0, 0.08)
            .disc("north", 1.0, 1.13, 0.08)
            .disc("west", 0.87, 1.0, 0.08)
            .disc("south", 1.0, 0.87, 0.08)
            .build("cup");
        let answer = plan(&scene, &Settings::default(), &Budget::unlimited()).unwrap();
        let Verdict::Relocate(Plan { bound: Some(proof), .. }) = &answer.verdict else { panic!("{answer:?}") };
        assert_eq!((answer.optimal(), proof.cost), (Some(true), 2));
        let served = |bound: LowerBound| {
            let mut verdict = answer.verdict.clone();
            *verdict.bound_mut().unwrap() = bound;
            confirm(&mut Checker::new(&scene), &scene, verdict, &Budget::unlimited())
        };
        // Without one landmark that the bound needs.
        let landmarks = proof.landmarks[..1].to_vec();
        let known = LeastSet { bound: 2, proven: 1, landmarks: landmarks.clone(), ..LeastSet::default() };
        let verdict = served(LowerBound::from(&known)).unwrap();
        let Verdict::Relocate(plan) = &verdict else { panic!("{verdict:?}") };
        assert_eq!((plan.cost(), plan.optimal()), (2, false));
        assert_eq!(plan.bound, Some(LowerBound { cost: 1, landmarks: landmarks.clone() }));
        assert!(matches!(served(LowerBound { cost: 2, landmarks }), Err(PlanError::Refused(_))));
    }
}
