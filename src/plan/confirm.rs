//! Nothing leaves unchecked.

use super::answer::{Answer, Statistics, Unplanned, Verdict};
use super::check::{Fault, FaultCode, MAX_FAULTS, Report, check};
use super::claim::Claim;
use super::warning::Warning;
use crate::budget::Budget;
use crate::knowledge::NoBase;
use crate::scene::Scene;

/// The planner failed.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// The checker refused the planner's own answer: a bug. The answer is not served.
    #[error("the answer did not pass its check")]
    Refused(Report),
    /// The objects stand too dense: their knowledge base would be larger than the limit
    /// ([`MAX_BASE_SIZE`](crate::knowledge::MAX_BASE_SIZE)).
    #[error("{}", NoBase::TooLarge)]
    TooDense,
}

/// The verdict as far as the checker confirms it. What it could not confirm in time is not claimed.
///
/// # Errors
/// [`PlanError::Refused`] if anything in it does not hold.
pub(super) fn confirm(scene: &Scene, verdict: Verdict, budget: &Budget<'_>) -> Result<Verdict, PlanError> {
    let (verdict, report) = checked(scene, verdict, budget);
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

/// The same for an answer by the paper's methods: a step that does not hold becomes a warning, a proof that does not hold
/// is refused, for proofs are our own. `setting` is to blame for a deadlock that can't be confirmed.
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
    let (verdict, report) = checked(scene, verdict, budget);
    let ours = |fault: &Fault| !is_late(fault.code) && is_of_a_proof(fault.code);
    if report.faults.iter().any(ours) {
        return Err(PlanError::Refused(report));
    }
    let mut verdict = proven_part(verdict, &report);
    let seen = |code| report.faults.iter().any(|fault| fault.code == code);
    // A list of faults that was cut off may have lost those of the proofs.
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

fn checked(scene: &Scene, verdict: Verdict, budget: &Budget<'_>) -> (Verdict, Report) {
    let answer = Answer { verdict, warnings: Vec::new(), statistics: Statistics::default() };
    let mut claim = Claim::of(scene, &answer);
    // A search that was cut off may have landmarks that prove more than it had time to see: not a fault, a better bound.
    claim.optimal.take_if(|optimal| !*optimal);
    let report = check(scene, &claim, budget);
    (answer.verdict, report)
}

/// The verdict with no more of a bound, and no more needed objects, than could be confirmed.
fn proven_part(mut verdict: Verdict, report: &Report) -> Verdict {
    let unconfirmed = |code| report.faults.iter().any(|fault| fault.code == code);
    if let Some(bound) = verdict.bound_mut() {
        // What was not tried in time is not stated, even where the rest proves the bound.
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

/// True if the code says that a bound or a lock does not hold.
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

/// True if the code says that time ran out, not that anything is wrong.
fn is_late(code: FaultCode) -> bool {
    matches!(
        code,
        FaultCode::BoundUnconfirmed
            | FaultCode::LockUnconfirmed
            | FaultCode::NeededUnconfirmed
            | FaultCode::ReplayUnconfirmed
    )
}
