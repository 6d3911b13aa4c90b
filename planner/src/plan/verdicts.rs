//! Verdicts that need no places: graspable as the table stands, and a deadlock with its locks.

use super::answer::{Deadlock, Verdict};
use super::check::{Fault, FaultCode, Report};
use super::confirm::PlanError;
use crate::budget::{Budget, Interrupted};
use crate::geometry::Shadow;
use crate::knowledge::{
    Derivable, KnowledgeBase, Locks, NoBase, completed, derivable, fixed_blockers, locks, swept_finger_options,
};
use crate::placement::grasp_in_place;
use crate::scene::Scene;

/// The grasp of a target that is graspable as the table stands.
///
/// # Errors
/// [`PlanError::Refused`] if no yaw is free: knowledge and geometry contradict each other, a bug.
pub(super) fn graspable_now(scene: &Scene, model: Shadow) -> Result<Verdict, PlanError> {
    grasp_in_place(scene, scene.target(), model).map(Verdict::Graspable).ok_or_else(|| {
        let fault = Fault {
            code: FaultCode::TargetBlocked,
            step: None,
            object: Some(scene.object(scene.target()).id().to_owned()),
            detail: "said to be graspable as the table stands, but no yaw is free".to_owned(),
        };
        PlanError::Refused(Report { faults: vec![fault], ..Report::default() })
    })
}

/// The deadlock of a target that does not follow from the relevant part of the swept finger's base. Builds the complete
/// base, since that part shows a lock, but not the greatest.
pub(super) fn prove_deadlock(scene: &Scene, relevant: &KnowledgeBase, budget: &Budget<'_>) -> Result<Deadlock, NoBase> {
    let base = completed(scene, relevant, swept_finger_options, budget)?;
    let derivable = derivable(&base, |_| false, budget)?;
    Ok(greatest_lock(scene, &base, &derivable, budget)?)
}

/// The greatest lock around a target that is not derivable, from the complete base and its derivable objects.
pub(super) fn greatest_lock(
    scene: &Scene,
    base: &KnowledgeBase,
    derivable: &Derivable,
    budget: &Budget<'_>,
) -> Result<Deadlock, Interrupted> {
    let Locks { mut blocked, core } = locks(base, derivable, scene.target(), budget)?;
    blocked.extend(fixed_blockers(scene, &blocked, budget)?);
    blocked.sort_unstable();
    Ok(Deadlock { blocked, core })
}
