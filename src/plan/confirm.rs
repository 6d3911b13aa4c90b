//! Nothing leaves unchecked.

use super::answer::{Answer, Statistics, Unplanned, Verdict};
use super::check::{Fault, FaultCode, Report, check};
use super::claim::Claim;
use crate::budget::Budget;
use crate::scene::Scene;

/// The planner failed.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// The checker refused the planner's own answer: a bug. The answer is not served.
    #[error("the answer did not pass its check")]
    Refused(Report),
}

/// The verdict as far as the checker confirms it. What it could not confirm in time is not claimed.
pub(super) fn confirm(scene: &Scene, verdict: Verdict, budget: &Budget<'_>) -> Result<Verdict, PlanError> {
    let answer = Answer { verdict, statistics: Statistics::default() };
    let report = check(scene, &Claim::of(scene, &answer), budget);
    let late = |fault: &Fault| is_late(fault.code);
    if report.faults.iter().any(|fault| !late(fault)) {
        return Err(PlanError::Refused(report));
    }
    let unconfirmed = |code| report.faults.iter().any(|fault| fault.code == code);
    let mut verdict = answer.verdict;
    if let Some(bound) = verdict.bound_mut()
        && unconfirmed(FaultCode::BoundUnconfirmed)
    {
        bound.cost = report.proven_bound;
    }
    if unconfirmed(FaultCode::LockUnconfirmed) || unconfirmed(FaultCode::ReplayUnconfirmed) {
        let bound = verdict.bound_mut().map(core::mem::take).unwrap_or_default();
        verdict = Verdict::TimedOut(Unplanned { bound, needed: None });
    }
    if unconfirmed(FaultCode::NeededUnconfirmed)
        && let Verdict::NoSpace(unplanned) | Verdict::TimedOut(unplanned) = &mut verdict
    {
        unplanned.needed = None;
    }
    Ok(verdict)
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
