//! Verdicts that need no places: graspable as the table stands, and a deadlock with its locks.

use super::confirm::PlanError;
use crate::budget::{Budget, Interrupted};
use crate::check::{Fault, FaultCode, Report};
use crate::geometry::Grasp;
use crate::knowledge::{
    Derivable, GraspModel, KnowledgeBase, Locks, NoBase, SweptFinger, completed, derivable, fixed_blockers, locks,
};
use crate::placement::grasp_in_place;
use crate::scene::{Goal, ObjectIndex, Scene};

/// The grasp of an object that is graspable as the table stands.
///
/// # Errors
/// [`PlanError::Refused`] if no yaw is free: knowledge and geometry contradict each other, a bug.
pub(crate) fn graspable_now(scene: &Scene, target: ObjectIndex, model: &dyn GraspModel) -> Result<Grasp, PlanError> {
    grasped(scene, target, grasp_in_place(scene, target, model))
}

/// The grasp that was found of an object which knowledge calls graspable.
///
/// # Errors
/// As [`graspable_now`].
pub(super) fn grasped(scene: &Scene, object: ObjectIndex, found: Option<Grasp>) -> Result<Grasp, PlanError> {
    found.ok_or_else(|| {
        let fault = Fault {
            code: FaultCode::TargetBlocked,
            step: None,
            object: Some(scene.object(object).id().to_owned()),
            detail: "said to be graspable as the table stands, but no yaw is free".to_owned(),
        };
        PlanError::Refused(Report { faults: vec![fault], ..Report::default() })
    })
}

/// The locks that keep the goal from being reached, which does not follow from the relevant part of the swept finger's base.
/// Builds the complete base, since that part shows a lock, but not the greatest.
pub(crate) fn prove_deadlock(scene: &Scene, relevant: &KnowledgeBase, budget: &Budget<'_>) -> Result<Locks, NoBase> {
    let base = completed(scene, relevant, &SweptFinger, budget)?;
    let derivable = derivable(&base, |_| false, budget)?;
    let underived = |object: &&ObjectIndex| !derivable.derives(**object);
    let wanted: Vec<ObjectIndex> = match scene.goal() {
        // One that can't be taken away is enough.
        Goal::AllOf(wanted) => wanted.iter().find(underived).copied().into_iter().collect(),
        goal => goal.candidates().to_vec(),
    };
    Ok(greatest_lock(scene, &base, &derivable, &wanted, budget)?)
}

/// The locks round wanted objects that are not derivable, from the complete base and its derivable objects. The greatest one
/// with the objects that block a member and that no plan moves.
pub(super) fn greatest_lock(
    scene: &Scene,
    base: &KnowledgeBase,
    derivable: &Derivable,
    wanted: &[ObjectIndex],
    budget: &Budget<'_>,
) -> Result<Locks, Interrupted> {
    let mut found = locks(base, derivable, wanted, budget)?;
    found.blocked.extend(fixed_blockers(scene, &found.blocked, budget)?);
    found.blocked.sort_unstable();
    Ok(found)
}
