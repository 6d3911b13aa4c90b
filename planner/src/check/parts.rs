//! Checks that the parts of a statement agree with each other and with the proof.

use crate::cost::Cost;
use crate::scene::{Goal, Scene};
use crate::statement::{Statement, Step, Verdict};

use super::bound::Proof;
use super::fault::{FaultCode, Faults};

fn cost_of(steps: &[Step]) -> Cost {
    steps.iter().map(Step::cost).sum()
}

/// The cost of the stated plan: counted if possible, otherwise as stated. `None` for a verdict without a plan.
fn cost(statement: &Statement) -> Option<Cost> {
    if matches!(statement.verdict, Some(Verdict::NoSpace | Verdict::TimedOut | Verdict::Deadlock)) {
        return None;
    }
    statement.relocations.as_deref().map(cost_of).or(statement.cost)
}

/// The verdict goes with the goal, and the parts that belong to both are there and no others.
pub(super) fn agree(scene: &Scene, statement: &Statement, faults: &mut Faults) {
    verdict(scene, statement, faults);
    of_goal(scene, statement, faults);
    let moves = !statement.steps().is_empty();
    let cost = ("cost", statement.cost.is_some());
    let plan = [("relocations", moves), ("target_grasp", statement.target_grasp.is_some()), cost];
    let deadlock = ("deadlock", statement.deadlock.is_some());
    let needed = ("needed", statement.needed.is_some());
    let mut unexpected = |parts: &[(&str, bool)]| {
        for (name, _) in parts.iter().filter(|(_, there)| *there) {
            let detail = || format!("'{name}' does not go with this verdict");
            faults.of_answer(FaultCode::UnexpectedPart, detail);
        }
    };
    match statement.verdict {
        Some(Verdict::Graspable) => unexpected(&[("relocations", moves), deadlock, needed]),
        Some(Verdict::Relocate) => unexpected(&[deadlock, needed]),
        Some(Verdict::Cleared | Verdict::PartlyCleared) => {}
        Some(Verdict::NoSpace | Verdict::TimedOut) => {
            unexpected(&plan);
            unexpected(&[deadlock]);
        }
        Some(Verdict::Deadlock) => {
            unexpected(&plan);
            unexpected(&[needed]);
        }
        None if statement.deadlock.is_some() => unexpected(&plan[..2]),
        None => {}
    }
    if statement.verdict == Some(Verdict::Deadlock) && statement.deadlock.is_none() {
        faults.of_answer(FaultCode::MissingPart, || "a deadlock needs its locks".into());
    }
    costs(statement, faults);
}

/// A clearing has verdicts of its own, and where objects are taken away none is graspable as the table stands.
fn verdict(scene: &Scene, statement: &Statement, faults: &mut Faults) {
    let Some(verdict) = statement.verdict else { return };
    let clears = matches!(verdict, Verdict::Cleared | Verdict::PartlyCleared);
    let fits = match scene.goal() {
        Goal::Target(_) | Goal::AnyOf(_) => !clears,
        Goal::AllOf(_) => !clears && verdict != Verdict::Graspable,
        Goal::Clear => clears,
    };
    if !fits {
        faults.of_answer(FaultCode::WrongVerdict, || format!("'{}' does not go with this goal", verdict.as_str()));
    }
}

/// The parts that are there go with the goal.
fn of_goal(scene: &Scene, statement: &Statement, faults: &mut Faults) {
    let clears = *scene.goal() == Goal::Clear;
    let grasps = !scene.goal().candidates().is_empty();
    let parts = [
        ("target_grasp", statement.target_grasp.is_some() && !grasps),
        ("target", statement.target.is_some() && (!grasps || statement.deadlock.is_some())),
        ("lower_bound", statement.lower_bound.is_some() && clears),
        ("optimal", statement.optimal.is_some() && clears),
        ("landmarks", statement.landmarks.is_some() && clears),
        ("deadlock", statement.deadlock.is_some() && clears),
        ("needed", statement.needed.is_some() && clears),
        ("stuck", statement.stuck.is_some() && !clears),
        ("left", statement.left.is_some() && !clears),
        ("proven", statement.proven.is_some() && !clears),
    ];
    for (name, _) in parts.iter().filter(|(_, unexpected)| *unexpected) {
        faults.of_answer(FaultCode::UnexpectedPart, || format!("'{name}' does not go with this goal"));
    }
}

/// The stated cost is that of the steps.
fn costs(statement: &Statement, faults: &mut Faults) {
    let stated_steps = statement.relocations.as_deref();
    let real = match statement.verdict {
        Some(Verdict::Graspable) => Some(Cost::ZERO),
        Some(Verdict::Relocate) if stated_steps.is_none() => {
            faults.of_answer(FaultCode::MissingPart, || "a plan needs its relocations".into());
            None
        }
        Some(Verdict::Relocate) if stated_steps.is_some_and(<[Step]>::is_empty) => {
            faults.of_answer(FaultCode::WrongCost, || "a plan without relocations is called graspable".into());
            Some(Cost::ZERO)
        }
        Some(Verdict::Relocate | Verdict::Cleared | Verdict::PartlyCleared) | None => stated_steps.map(cost_of),
        Some(_) => None,
    };
    if let (Some(stated), Some(real)) = (statement.cost, real)
        && stated != real
    {
        faults.of_answer(FaultCode::WrongCost, || format!("the cost is {real}, not {stated}"));
    }
}

/// The stated bound is proven, and `optimal` agrees with cost and bound.
pub(super) fn bounded(statement: &Statement, proof: &Proof, faults: &mut Faults) {
    let cost = cost(statement);
    if let Some(stated) = statement.lower_bound {
        at_most_proven(stated, proof, faults);
        if let Some(cost) = cost.filter(|cost| stated > *cost) {
            faults.of_answer(FaultCode::BoundAboveCost, || format!("the bound {stated} is above the cost {cost}"));
        }
    }
    match (statement.optimal, cost) {
        (Some(true), None) => {
            faults.of_answer(FaultCode::UnexpectedPart, || "'optimal' is said of no plan".into());
        }
        (Some(true), Some(cost)) => match statement.lower_bound {
            Some(stated) if stated != cost => {
                let detail = || format!("said to be optimal at cost {cost} and bound {stated}");
                faults.of_answer(FaultCode::WrongOptimal, detail);
            }
            Some(_) => {}
            None => at_most_proven(cost, proof, faults),
        },
        (Some(false), Some(cost)) if cost == proof.bound || statement.lower_bound == Some(cost) => {
            faults
                .of_answer(FaultCode::WrongOptimal, || format!("no plan costs less than {cost}, this one is optimal"));
        }
        _ => {}
    }
}

fn at_most_proven(stated: Cost, proof: &Proof, faults: &mut Faults) {
    let proven = proof.bound;
    if stated <= proven {
        return;
    }
    let (code, why) = if proof.complete {
        (FaultCode::BoundUnproven, "prove no more than")
    } else {
        (FaultCode::BoundUnconfirmed, "could in the time left only be seen to prove")
    };
    faults.of_answer(code, || format!("the bound {stated} is stated, the landmarks {why} {proven}"));
}
