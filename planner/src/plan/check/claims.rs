//! Checks that the parts of a stated answer agree with each other and with the proof.

use crate::plan::claim::{Claim, VerdictName};

use super::bound::Proof;
use super::fault::{FaultCode, Faults};

/// The cost of the stated plan: counted if possible, otherwise as stated. `None` for a verdict without a plan.
fn cost(claim: &Claim) -> Option<u64> {
    if matches!(claim.verdict, Some(VerdictName::NoSpace | VerdictName::TimedOut | VerdictName::Deadlock)) {
        return None;
    }
    claim.relocations.as_ref().map(|steps| steps.len() as u64).or(claim.cost)
}

/// The parts that belong to the verdict are there, and no others.
pub(super) fn parts(claim: &Claim, faults: &mut Faults) {
    let moves = claim.relocations.as_ref().is_some_and(|steps| !steps.is_empty());
    let plan = [("relocations", moves), ("target_grasp", claim.target_grasp.is_some())];
    let deadlock = ("deadlock", claim.deadlock.is_some());
    let needed = ("needed", claim.needed.is_some());
    let mut unexpected = |parts: &[(&str, bool)]| {
        for (name, _) in parts.iter().filter(|(_, there)| *there) {
            let detail = || format!("'{name}' does not go with this verdict");
            faults.of_answer(FaultCode::UnexpectedPart, detail);
        }
    };
    match claim.verdict {
        Some(VerdictName::Graspable) => unexpected(&[("relocations", moves), deadlock, needed]),
        Some(VerdictName::Relocate) => unexpected(&[deadlock, needed]),
        Some(VerdictName::NoSpace | VerdictName::TimedOut) => {
            unexpected(&plan);
            unexpected(&[deadlock]);
        }
        Some(VerdictName::Deadlock) => {
            unexpected(&plan);
            unexpected(&[needed]);
        }
        None if claim.deadlock.is_some() => unexpected(&plan),
        None => {}
    }
    if claim.verdict == Some(VerdictName::Deadlock) && claim.deadlock.is_none() {
        faults.of_answer(FaultCode::MissingPart, || "a deadlock needs its locks".into());
    }
    costs(claim, faults);
}

/// The cost is the number of relocations.
fn costs(claim: &Claim, faults: &mut Faults) {
    let stated_steps = claim.relocations.as_ref().map(Vec::len);
    let steps = match claim.verdict {
        Some(VerdictName::Graspable) => Some(0),
        Some(VerdictName::Relocate) if stated_steps.is_none() => {
            faults.of_answer(FaultCode::MissingPart, || "a plan needs its relocations".into());
            None
        }
        Some(VerdictName::Relocate) if stated_steps == Some(0) => {
            faults.of_answer(FaultCode::WrongCost, || "a plan without relocations is called graspable".into());
            Some(0)
        }
        Some(VerdictName::Relocate) | None => stated_steps,
        Some(_) => None,
    };
    if let (Some(stated), Some(steps)) = (claim.cost, steps)
        && stated != steps as u64
    {
        faults.of_answer(FaultCode::WrongCost, || format!("the cost is {steps}, not {stated}"));
    }
}

/// The stated bound is proven, and `optimal` agrees with cost and bound.
pub(super) fn bounds(claim: &Claim, proof: &Proof, faults: &mut Faults) {
    let (cost, proven) = (cost(claim), proof.bound as u64);
    if let Some(stated) = claim.lower_bound {
        at_most_proven(stated, proof, faults);
        if let Some(cost) = cost.filter(|cost| stated > *cost) {
            faults.of_answer(FaultCode::BoundAboveCost, || format!("the bound {stated} is above the cost {cost}"));
        }
    }
    match (claim.optimal, cost) {
        (Some(true), None) => {
            faults.of_answer(FaultCode::UnexpectedPart, || "'optimal' is said of no plan".into());
        }
        (Some(true), Some(cost)) => match claim.lower_bound {
            Some(stated) if stated != cost => {
                let detail = || format!("said to be optimal at cost {cost} and bound {stated}");
                faults.of_answer(FaultCode::WrongOptimal, detail);
            }
            Some(_) => {}
            None => at_most_proven(cost, proof, faults),
        },
        (Some(false), Some(cost)) if cost == proven || claim.lower_bound == Some(cost) => {
            faults
                .of_answer(FaultCode::WrongOptimal, || format!("no plan costs less than {cost}, this one is optimal"));
        }
        _ => {}
    }
}

fn at_most_proven(stated: u64, proof: &Proof, faults: &mut Faults) {
    let proven = proof.bound;
    if stated <= proven as u64 {
        return;
    }
    let (code, why) = if proof.complete {
        (FaultCode::BoundUnproven, "prove no more than")
    } else {
        (FaultCode::BoundUnconfirmed, "could in the time left only be seen to prove")
    };
    faults.of_answer(code, || format!("the bound {stated} is stated, the landmarks {why} {proven}"));
}
