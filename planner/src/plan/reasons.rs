//! Verdicts that need no places: graspable as the table stands, and a deadlock with its locks.

use super::confirm::PlanError;
use crate::budget::{Budget, Interrupted};
use crate::check::{Fault, FaultCode, Report};
use crate::geometry::Grasp;
use crate::knowledge::{
    Derivable, GraspModel, KnowledgeBase, Locks, NoBase, SweptFinger, completed, derivable, fixed_blockers, locks,
};
use crate::placement::grasp_in_place;
use crate::scene::Scene;

/// The grasp of a target that is graspable as the table stands.
///
/// # Errors
/// [`PlanError::Refused`] if no yaw is free: knowledge and geometry contradict each other, a bug.
pub(crate) fn graspable_now(scene: &Scene, model: &dyn GraspModel) -> Result<Grasp, PlanError> {
    grasp_in_place(scene, scene.target(), model).ok_or_else(|| {
        let fault = Fault {
            code: FaultCode::TargetBlocked,
            step: None,
            object: Some(scene.object(scene.target()).id().to_owned()),
            detail: "said to be graspable as the table stands, but no yaw is free".to_owned(),
        };
        PlanError::Refused(Report { faults: vec![fault], ..Report::default() })
    })
}

/// The locks round a target that does not follow from the relevant part of the swept finger's base. Builds the complete
/// base, since that part shows a lock, but not the greatest.
pub(crate) fn prove_deadlock(scene: &Scene, relevant: &KnowledgeBase, budget: &Budget<'_>) -> Result<Locks, NoBase> {
    let base = completed(scene, relevant, &SweptFinger, budget)?;
    let derivable = derivable(&base, |_| false, budget)?;
    Ok(greatest_lock(scene, &base, &derivable, budget)?)
}

/// The locks round a target that is not derivable, from the complete base and its derivable objects. The greatest one
/// with the fixed objects that block a member.
pub(super) fn greatest_lock(
    scene: &Scene,
    base: &KnowledgeBase,
    derivable: &Derivable,
    budget: &Budget<'_>,
) -> Result<Locks, Interrupted> {
    let mut found = locks(base, derivable, scene.target(), budget)?;
    found.blocked.extend(fixed_blockers(scene, &found.blocked, budget)?);
    found.blocked.sort_unstable();
    Ok(found)
}
