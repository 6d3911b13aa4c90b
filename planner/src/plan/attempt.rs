//! One set of objects to move: places and drop-offs for it, by the scene's destination.

use crate::budget::{Budget, Interrupted};
use crate::cost::Cost;
use crate::knowledge::{GraspModel, KnowledgeBase};
use crate::placement::{Arrangement, Drops, Effort, Objective, Task, arrange, grasp_without};
use crate::scene::{Destination, Goal, ObjectIndex, Scene};
use crate::search::Derivation;

/// The effort for one set, so that other sets get their turn.
const MAX_EFFORT_PER_SET: u32 = 100_000;
/// Less than this does not even try one grasp.
const LEAST_EFFORT: u32 = 8;
/// Extra effort per move, for both limits: a long plan needs many places, each found among the earlier ones.
const EFFORT_PER_STEP: u32 = 10_000;

/// The placement problem.
pub(crate) struct Question<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) base: &'a KnowledgeBase,
    /// The node of the goal in the base.
    pub(crate) goal: ObjectIndex,
    pub(crate) model: &'a dyn GraspModel,
    pub(crate) objective: Objective,
}

/// One set with as many extra moves as the cost allows, for each candidate that it frees.
pub(super) fn attempt(
    question: &Question<'_>,
    set: &Derivation,
    cost: Cost,
    effort: &mut Effort,
    budget: &Budget<'_>,
) -> Result<Option<Arrangement>, Interrupted> {
    for scene in freed(question, set) {
        let found = Attempt { question, scene: &scene, set, cost }.all(effort, budget)?;
        if found.is_some() {
            return Ok(found);
        }
    }
    Ok(None)
}

/// The scene; of several candidates, one scene for each that is free once the set is gone, with it as the target.
fn freed(question: &Question<'_>, set: &Derivation) -> Vec<Scene> {
    let Question { scene, model, .. } = *question;
    match scene.goal() {
        Goal::AnyOf(_) => free_candidates(scene, model, &set.order)
            .into_iter()
            .filter_map(|candidate| scene.with_target(candidate))
            .collect(),
        _ => vec![scene.clone()],
    }
}

/// The candidates that can be grasped once some objects are gone, widest slack first, then in index order.
pub(crate) fn free_candidates(scene: &Scene, model: &dyn GraspModel, gone: &[ObjectIndex]) -> Vec<ObjectIndex> {
    let may_be_free = |candidate: &&ObjectIndex| gone.is_empty() || frees_any(scene, model, gone, **candidate);
    let candidates = scene.goal().candidates().iter().filter(may_be_free);
    let mut free: Vec<_> = candidates
        .filter_map(|&candidate| Some((grasp_without(scene, candidate, gone, model)?.slack, candidate)))
        .collect();
    free.sort_by(|a, b| b.0.total_cmp(&a.0));
    free.into_iter().map(|(_, candidate)| candidate).collect()
}

/// True if one of the objects that are gone stood near enough to the candidate to have blocked it: no other set frees it.
fn frees_any(scene: &Scene, model: &dyn GraspModel, gone: &[ObjectIndex], candidate: ObjectIndex) -> bool {
    let grasped = scene.object(candidate).footprint();
    let reach = model.reach(scene.gripper(), scene.object(candidate));
    gone.iter().any(|&object| scene.object(object).footprint().comes_within(grasped.at(), reach))
}

/// One set with its target.
struct Attempt<'a> {
    question: &'a Question<'a>,
    scene: &'a Scene,
    set: &'a Derivation,
    cost: Cost,
}

impl Attempt<'_> {
    /// By the scene's destination. Where the table comes first, as few objects as possible leave it; only the last round, which
    /// sets no limit to that, must not be starved by those before.
    fn all(&self, effort: &mut Effort, budget: &Budget<'_>) -> Result<Option<Arrangement>, Interrupted> {
        let Question { objective, .. } = *self.question;
        let with = |drops| move |part: &mut Effort| arrange(&self.task(objective, drops), part, budget);
        match self.scene.destination() {
            Destination::DropOff => self.on_a_share(effort, with(Drops::All)),
            Destination::Table => self.on_table(effort, budget),
            Destination::TableThenDropOff => {
                if let Some(found) = self.on_table(effort, budget)? {
                    return Ok(Some(found));
                }
                if let Some(found) = self.on_a_share(effort, |part| self.with_few_drops(part, budget))? {
                    return Ok(Some(found));
                }
                self.on_a_share(effort, with(Drops::UpTo(usize::MAX)))
            }
        }
    }

    /// If the places that are best by the objective lead nowhere, those that are best by another one are tried: a worse place is
    /// better than one more relocation.
    fn on_table(&self, effort: &mut Effort, budget: &Budget<'_>) -> Result<Option<Arrangement>, Interrupted> {
        for objective in [self.question.objective, self.question.objective.other()] {
            let task = self.task(objective, Drops::Wanted);
            let found = self.on_a_share(effort, |part| arrange(&task, part, budget))?;
            if found.is_some() {
                return Ok(found);
            }
        }
        Ok(None)
    }

    fn with_few_drops(&self, part: &mut Effort, budget: &Budget<'_>) -> Result<Option<Arrangement>, Interrupted> {
        for most in 1..=self.set.order.len() {
            budget.check()?;
            if part.left() < LEAST_EFFORT {
                break;
            }
            let found = arrange(&self.task(self.question.objective, Drops::UpTo(most)), part, budget)?;
            if found.is_some() {
                return Ok(found);
            }
        }
        Ok(None)
    }

    /// Works with one set's share of the effort, and gives back what is left of it.
    fn on_a_share<T>(&self, effort: &mut Effort, work: impl FnOnce(&mut Effort) -> T) -> T {
        let mut share = effort.split(MAX_EFFORT_PER_SET.saturating_add(for_steps(self.cost)));
        let result = work(&mut share);
        effort.join(share);
        result
    }

    fn task(&self, objective: Objective, drops: Drops) -> Task<'_> {
        let Self { question, scene, set, cost } = *self;
        let (extra, kept) = (cost.beyond(set.cost()), question.scene.goal().candidates());
        Task { scene, model: question.model, set: &set.order, kept, extra, objective, drops }
    }
}

/// The extra effort for a plan of this cost.
pub(super) fn for_steps(cost: Cost) -> u32 {
    EFFORT_PER_STEP.saturating_mul(u32::try_from(cost.get()).unwrap_or(u32::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::knowledge::{SweptFinger, of_goal};
    use crate::scene::scenes::TestScene;

    /// Two plates have to go, and the tray takes one: no set of them fits, whichever it is, and none costs effort.
    #[test]
    fn a_set_that_the_drop_offs_do_not_hold_costs_no_effort() {
        let scene = TestScene::new(2)
            .finger(0.04, 0.05)
            .disc("cup", 1.0, 1.0, 0.03)
            .disc("east", 1.13, 1.0, 0.08)
            .disc("north", 1.0, 1.13, 0.08)
            .disc("west", 0.87, 1.0, 0.08)
            .disc("south", 1.0, 0.87, 0.08)
            .drop_off("tray", Some(1), None)
            .destination(Destination::DropOff)
            .build("cup");
        let budget = Budget::unlimited();
        let (base, goal) = of_goal(&scene, &SweptFinger, &budget).unwrap();
        let question =
            Question { scene: &scene, base: &base, goal, model: &SweptFinger, objective: Objective::default() };
        let set = Derivation { order: vec![ObjectIndex::new(1), ObjectIndex::new(3)] };
        let mut effort = Effort::new(1_000_000);
        for _ in 0..32 {
            assert_eq!(attempt(&question, &set, set.cost(), &mut effort, &budget), Ok(None));
        }
        assert_eq!(effort, Effort::new(1_000_000));
    }
}
