//! The knowledge base of a scene.

use super::base::KnowledgeBase;
use super::options::{Blocker, minimal_options};
use crate::budget::{Budget, Interrupted};
use crate::geometry::shadow;
use crate::scene::{ObjectIndex, Scene};

/// The base of every movable object.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub fn complete(scene: &Scene, budget: &Budget<'_>) -> Result<KnowledgeBase, Interrupted> {
    let mut base = KnowledgeBase::new();
    for object in scene.indices() {
        budget.check()?;
        base.push(options(scene, object));
    }
    Ok(base)
}

/// The base of those objects that can matter to the target: the target, and what stands in an option of one that matters.
/// All others have no option here, which changes nothing, for no rule that matters names them.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub fn relevant(scene: &Scene, target: ObjectIndex, budget: &Budget<'_>) -> Result<KnowledgeBase, Interrupted> {
    let mut options_of: Vec<Option<Vec<Vec<ObjectIndex>>>> = vec![None; scene.objects().len()];
    let mut open = vec![target];
    options_of[target.get()] = Some(Vec::new());
    while let Some(object) = open.pop() {
        budget.check()?;
        let found = options(scene, object);
        for &member in found.iter().flatten() {
            if options_of[member.get()].is_none() {
                options_of[member.get()] = Some(Vec::new());
                open.push(member);
            }
        }
        options_of[object.get()] = Some(found);
    }
    Ok(options_of.into_iter().map(Option::unwrap_or_default).collect())
}

/// The fixed objects that block a member at some yaw, in index order.
pub fn fixed_blockers(scene: &Scene, members: &[ObjectIndex]) -> Vec<ObjectIndex> {
    let fixed = |object: &ObjectIndex| scene.object(*object).fixed();
    let mut found: Vec<ObjectIndex> = members
        .iter()
        .filter(|member| !fixed(member))
        .flat_map(|&member| blockers(scene, member))
        .map(|blocker| blocker.object)
        .filter(fixed)
        .collect();
    found.sort_unstable();
    found.dedup();
    found
}

/// None for a fixed object. Options that hold a fixed object stay: no rule with one ever fires, and locks need them.
fn options(scene: &Scene, object: ObjectIndex) -> Vec<Vec<ObjectIndex>> {
    if scene.object(object).fixed() {
        return Vec::new();
    }
    minimal_options(&blockers(scene, object), scene.gripper().min_free_width())
}

/// The obstacles that block a grasp of `object` at some yaw, in index order.
fn blockers(scene: &Scene, object: ObjectIndex) -> Vec<Blocker> {
    let gripper = scene.gripper();
    let disc = scene.object(object).disc();
    let reach = gripper.corner_distance(disc.radius) + gripper.margin();
    let mut near: Vec<ObjectIndex> =
        scene.index().within(disc.centre, reach).filter(|&other| other != object).collect();
    near.sort_unstable();
    near.into_iter()
        .map(|other| Blocker { object: other, shadow: shadow(gripper, &disc, &scene.object(other).disc(), 0.0) })
        .filter(|blocker| !blocker.shadow.is_empty())
        .collect()
}
