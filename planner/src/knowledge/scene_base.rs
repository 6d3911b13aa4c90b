//! The knowledge base of a scene.

use super::base::KnowledgeBase;
use super::grasp_model::{GraspModel, SweptFinger, those_blocking};
use crate::budget::{Budget, Interrupted};
use crate::scene::{Goal, ObjectIndex, Scene};

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

/// The base of every object that may be moved, or grasped in the end.
///
/// # Errors
/// [`NoBase`] when the budget ends, or when the objects stand too dense.
pub fn complete(scene: &Scene, model: &dyn GraspModel, budget: &Budget<'_>) -> Result<KnowledgeBase, NoBase> {
    let nothing: KnowledgeBase = scene.indices().map(|_| Vec::new()).collect();
    completed(scene, &nothing, model, budget)
}

/// The same, given the part of it that [`relevant`] or [`of_goal`] found.
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
            base.push(bodies(scene, object, model, budget)?);
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
    reached_from(scene, vec![target], model, budget)
}

/// The base of a goal: of the objects on which it depends, and of a node that stands for it. The node is the target itself where
/// there is one. Otherwise it comes after all objects, as one more head of rules: for one of several candidates with the bodies
/// of each, none of which holds a candidate, since a candidate that could be moved could be grasped; for several objects that
/// are all taken away with one body, all of them. Candidates are moved by no rule here.
///
/// # Errors
/// [`NoBase`] when the budget ends, or when the objects stand too dense.
pub fn of_goal(
    scene: &Scene,
    model: &dyn GraspModel,
    budget: &Budget<'_>,
) -> Result<(KnowledgeBase, ObjectIndex), NoBase> {
    let goal = scene.goal();
    let reached = reached_from(scene, goal.named().to_vec(), model, budget)?;
    if let Goal::Target(target) = goal {
        return Ok((reached, *target));
    }
    let mut base = KnowledgeBase::new();
    for object in scene.indices() {
        base.push_same(&reached, (!goal.is_candidate(object)).then_some(object));
    }
    budget.check()?;
    // A rule with a member that nothing moves never fires.
    let moves = |member: &ObjectIndex| !goal.is_candidate(*member) && !reached.rules_of(*member).is_empty();
    let without_candidates = |option: &&[ObjectIndex]| option.iter().all(moves);
    let bodies = goal.candidates().iter().flat_map(|&candidate| reached.options(candidate).filter(without_candidates));
    let all = (!goal.wanted_away().is_empty()).then(|| goal.wanted_away().to_vec());
    base.push(bodies.map(<[_]>::to_vec).chain(all).collect());
    Ok((base, ObjectIndex::new(scene.objects().len())))
}

/// The base of these objects, and of every member of an option of an object in it.
fn reached_from(
    scene: &Scene,
    mut order: Vec<ObjectIndex>,
    model: &dyn GraspModel,
    budget: &Budget<'_>,
) -> Result<KnowledgeBase, NoBase> {
    let count = scene.objects().len();
    // The objects in breadth-first order; renumbered at the end.
    let mut reached = KnowledgeBase::new();
    let mut seen = vec![false; count];
    order.iter().for_each(|object| seen[object.get()] = true);
    while let Some(&object) = order.get(reached.len()) {
        budget.check()?;
        reached.push(bodies(scene, object, model, budget)?);
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

/// The objects that no plan moves, and that block a member at some yaw by the swept finger, in index order.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub fn fixed_blockers(
    scene: &Scene,
    members: &[ObjectIndex],
    budget: &Budget<'_>,
) -> Result<Vec<ObjectIndex>, Interrupted> {
    let stays = |object: ObjectIndex| !has_rules(scene, object);
    let mut found: Vec<ObjectIndex> = Vec::new();
    for &member in members.iter().filter(|member| !stays(**member)) {
        budget.check()?;
        let blockers = those_blocking(scene, member, &SweptFinger, stays, budget)?;
        found.extend(blockers.into_iter().map(|blocker| blocker.object));
    }
    found.sort_unstable();
    found.dedup();
    Ok(found)
}

/// True if an object may be moved, or is grasped in the end.
fn has_rules(scene: &Scene, object: ObjectIndex) -> bool {
    scene.movable(object) || scene.goal().is_candidate(object)
}

/// The bodies of the rules by which an object is picked, to be put aside or taken away: the options of the grasp model; none for
/// an object that is as if fixed. Options with such a member stay: their rules never fire, and locks need them. An action that
/// moves objects without grasping them adds its bodies here, for all but the candidates, which are grasped in the end.
fn bodies(
    scene: &Scene,
    object: ObjectIndex,
    model: &dyn GraspModel,
    budget: &Budget<'_>,
) -> Result<Vec<Vec<ObjectIndex>>, Interrupted> {
    if has_rules(scene, object) { model.options(scene, object, budget) } else { Ok(Vec::new()) }
}
