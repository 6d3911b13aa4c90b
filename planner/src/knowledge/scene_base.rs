//! The knowledge base of a scene.

use super::base::KnowledgeBase;
use super::grasp_model::{GraspModel, SweptFinger, those_blocking};
use crate::budget::{Budget, Interrupted};
use crate::scene::{ObjectIndex, Scene};

/// The most members that all options of one base may have together. A crowd of 10,000 dishes has some 100,000; a base
/// of this size takes a few dozen megabytes, and search as much again.
pub const MAX_BASE_SIZE: usize = 1_000_000;

/// Why there is no base.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum NoBase {
    /// The budget ended first.
    #[error("interrupted")]
    Interrupted,
    /// The base would be larger than [`MAX_BASE_SIZE`].
    #[error("the options of all objects have more than {MAX_BASE_SIZE} members together")]
    TooLarge,
}

impl From<Interrupted> for NoBase {
    fn from(Interrupted: Interrupted) -> Self {
        Self::Interrupted
    }
}

/// The base of every movable object.
///
/// # Errors
/// [`NoBase`] when the budget ends, or when the objects stand too dense.
pub fn complete(scene: &Scene, model: &dyn GraspModel, budget: &Budget<'_>) -> Result<KnowledgeBase, NoBase> {
    let nothing: KnowledgeBase = scene.indices().map(|_| Vec::new()).collect();
    completed(scene, &nothing, model, budget)
}

/// The base of every movable object, given the part of it that [`relevant`] found.
///
/// # Errors
/// [`NoBase`] when the budget ends, or when the objects stand too dense.
pub fn completed(
    scene: &Scene,
    part: &KnowledgeBase,
    model: &dyn GraspModel,
    budget: &Budget<'_>,
) -> Result<KnowledgeBase, NoBase> {
    let mut base = KnowledgeBase::new();
    for object in scene.indices() {
        budget.check()?;
        // An object without options in `part` was not derived there: every movable object has at least one.
        if part.rules_of(object).is_empty() {
            base.push(bodies(scene, object, model));
        } else {
            base.push_same(part, Some(object));
        }
        if base.size() > MAX_BASE_SIZE {
            return Err(NoBase::TooLarge);
        }
    }
    Ok(base)
}

/// The base of the relevant objects: the target, and every member of an option of a relevant object. All others have no
/// options here. That changes nothing for the target, since no rule of a relevant object names them.
///
/// # Errors
/// [`NoBase`] when the budget ends, or when the objects stand too dense.
pub fn relevant(
    scene: &Scene,
    target: ObjectIndex,
    model: &dyn GraspModel,
    budget: &Budget<'_>,
) -> Result<KnowledgeBase, NoBase> {
    let count = scene.objects().len();
    // The relevant objects in breadth-first order; renumbered at the end.
    let mut reached = KnowledgeBase::new();
    let mut seen = vec![false; count];
    seen[target.get()] = true;
    let mut order = vec![target];
    while let Some(&object) = order.get(reached.len()) {
        budget.check()?;
        reached.push(bodies(scene, object, model));
        for &member in reached.options(ObjectIndex::new(reached.len() - 1)).flatten() {
            if !core::mem::replace(&mut seen[member.get()], true) {
                order.push(member);
            }
        }
        if reached.size() > MAX_BASE_SIZE {
            return Err(NoBase::TooLarge);
        }
    }
    Ok(reached.renumbered(&order, count))
}

/// The fixed objects that block a member at some yaw by the swept finger, in index order.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub fn fixed_blockers(
    scene: &Scene,
    members: &[ObjectIndex],
    budget: &Budget<'_>,
) -> Result<Vec<ObjectIndex>, Interrupted> {
    let fixed = |object: ObjectIndex| scene.object(object).fixed();
    let mut found: Vec<ObjectIndex> = Vec::new();
    for &member in members.iter().filter(|member| !fixed(**member)) {
        budget.check()?;
        found.extend(those_blocking(scene, member, &SweptFinger, fixed).into_iter().map(|blocker| blocker.object));
    }
    found.sort_unstable();
    found.dedup();
    Ok(found)
}

/// The bodies of the rules by which an object is picked: the options of the grasp model; none for a fixed object. Options with
/// a fixed member stay: their rules never fire, and locks need them. An action that moves objects without grasping them adds
/// its bodies here, for all but the target, which is grasped in the end.
fn bodies(scene: &Scene, object: ObjectIndex, model: &dyn GraspModel) -> Vec<Vec<ObjectIndex>> {
    if scene.object(object).fixed() { Vec::new() } else { model.options(scene, object) }
}
