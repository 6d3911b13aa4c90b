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
    let reach = model.reach(scene.gripper(), &grasped);
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
        match self.scene.destination() {
            Destination::DropOff => self.with(objective, Drops::All, effort, budget),
            Destination::Table => self.on_table(effort, budget),
            Destination::TableThenDropOff => {
                if let Some(found) = self.on_table(effort, budget)? {
                    return Ok(Some(found));
                }
                let mut part = self.part(effort);
                for most in 1..=self.set.order.len() {
                    budget.check()?;
                    if part.left() < LEAST_EFFORT {
                        break;
                    }
                    if let Some(found) = self.within(objective, Drops::UpTo(most), &mut part, budget)? {
                        return Ok(Some(found));
                    }
                }
                effort.join(part);
                self.with(objective, Drops::UpTo(usize::MAX), effort, budget)
            }
        }
    }

    /// If the places that are best by the objective lead nowhere, those that are best by another one are tried: a worse place is
    /// better than one more relocation.
    fn on_table(&self, effort: &mut Effort, budget: &Budget<'_>) -> Result<Option<Arrangement>, Interrupted> {
        for objective in [self.question.objective, self.question.objective.other()] {
            let found = self.with(objective, Drops::Wanted, effort, budget)?;
            if found.is_some() {
                return Ok(found);
            }
        }
        Ok(None)
    }

    fn part(&self, effort: &mut Effort) -> Effort {
        effort.split(MAX_EFFORT_PER_SET.saturating_add(for_steps(self.cost)))
    }

    /// With one set's part of the effort.
    fn with(
        &self,
        objective: Objective,
        drops: Drops,
        effort: &mut Effort,
        budget: &Budget<'_>,
    ) -> Result<Option<Arrangement>, Interrupted> {
        let mut part = self.part(effort);
        let found = self.within(objective, drops, &mut part, budget)?;
        effort.join(part);
        Ok(found)
    }

    fn within(
        &self,
        objective: Objective,
        drops: Drops,
        effort: &mut Effort,
        budget: &Budget<'_>,
    ) -> Result<Option<Arrangement>, Interrupted> {
        let Self { question, scene, set, cost } = *self;
        let extra = cost.beyond(set.cost());
        let kept = question.scene.goal().candidates();
        let task = Task { scene, model: question.model, set: &set.order, kept, extra, objective, drops };
        arrange(&task, effort, budget)
    }
}

/// The extra effort for a plan of this cost.
pub(super) fn for_steps(cost: Cost) -> u32 {
    EFFORT_PER_STEP.saturating_mul(u32::try_from(cost.get()).unwrap_or(u32::MAX))
}
