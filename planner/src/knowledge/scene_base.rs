//! The knowledge base of a scene.

use super::base::KnowledgeBase;
use super::options::{Blocker, minimal_options};
use crate::budget::{Budget, Interrupted};
use crate::geometry::{Shadow, shadow};
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

/// A grasp model as rules: the options of a movable object. Returns at least one, since removing everything in reach
/// always frees the object.
pub type OptionsOf = fn(&Scene, ObjectIndex) -> Vec<Vec<ObjectIndex>>;

/// The base of every movable object.
///
/// # Errors
/// [`NoBase`] when the budget ends, or when the objects stand too dense.
pub fn complete(scene: &Scene, options_of: OptionsOf, budget: &Budget<'_>) -> Result<KnowledgeBase, NoBase> {
    let nothing: KnowledgeBase = scene.indices().map(|_| Vec::new()).collect();
    completed(scene, &nothing, options_of, budget)
}

/// The base of every movable object, given the part of it that [`relevant`] found.
///
/// # Errors
/// [`NoBase`] when the budget ends, or when the objects stand too dense.
pub fn completed(
    scene: &Scene,
    part: &KnowledgeBase,
    options_of: OptionsOf,
    budget: &Budget<'_>,
) -> Result<KnowledgeBase, NoBase> {
    let mut base = KnowledgeBase::new();
    for object in scene.indices() {
        budget.check()?;
        // An object without options in `part` was not derived there: every movable object has at least one.
        if part.rules_of(object).is_empty() {
            base.push(movable_options(scene, object, options_of));
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
    options_of: OptionsOf,
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
        reached.push(movable_options(scene, object, options_of));
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

/// The fixed objects that block a member at some yaw, in index order.
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
        found.extend(those_blocking(scene, member, shadow, fixed).into_iter().map(|blocker| blocker.object));
    }
    found.sort_unstable();
    found.dedup();
    Ok(found)
}

/// The options of an object; none for a fixed one. Options with a fixed member stay: their rules never fire, and locks
/// need them.
fn movable_options(scene: &Scene, object: ObjectIndex, options_of: OptionsOf) -> Vec<Vec<ObjectIndex>> {
    if scene.object(object).fixed() { Vec::new() } else { options_of(scene, object) }
}

/// The options of a movable object by the swept finger model.
pub fn swept_finger_options(scene: &Scene, object: ObjectIndex) -> Vec<Vec<ObjectIndex>> {
    minimal_options(&blockers(scene, object, shadow), scene.gripper().min_free_width())
}

/// The obstacles that block a grasp of `object` at some yaw, each with its shadow by `model`, in index order.
pub fn blockers(scene: &Scene, object: ObjectIndex, model: Shadow) -> Vec<Blocker> {
    those_blocking(scene, object, model, |_| true)
}

fn those_blocking(
    scene: &Scene,
    object: ObjectIndex,
    model: Shadow,
    of_kind: impl Fn(ObjectIndex) -> bool,
) -> Vec<Blocker> {
    let gripper = scene.gripper();
    let disc = scene.object(object).disc();
    let reach = gripper.corner_distance(disc.radius) + gripper.margin();
    let mut near: Vec<Blocker> = scene
        .index()
        .within(disc.centre, reach)
        .filter(|(other, _)| *other != object && of_kind(*other))
        .map(|(other, obstacle)| Blocker { object: other, shadow: model(gripper, &disc, &obstacle, 0.0) })
        .filter(|blocker| !blocker.shadow.is_empty())
        .collect();
    near.sort_unstable_by_key(|blocker| blocker.object);
    near
}
