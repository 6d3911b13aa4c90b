//! Sets from the search meet places on the table, in order of cost.

use crate::budget::{Budget, Interrupted};
use crate::geometry::Shadow;
use crate::knowledge::KnowledgeBase;
use crate::placement::{Arrangement, Effort, Objective, Task, arrange};
use crate::scene::{ObjectIndex, Scene};
use crate::search::{Alternatives, Derivation};

/// The effort for one answer, reached only where space is very short: half a second, or some seconds where a large disc
/// stands among thousands of small ones.
const MAX_EFFORT: u32 = 1_000_000;
/// The effort for one set, so that others get their turn.
const MAX_EFFORT_PER_SET: u32 = 100_000;
/// What each relocation adds to both: a long plan has many places to find, each among those found before.
const EFFORT_PER_STEP: u32 = 10_000;
/// How many more relocations than the least set has are tried.
const MAX_EXTRA: usize = 3;
/// How many sets are tried.
const MAX_SETS: usize = 32;

/// What is asked.
pub(super) struct Question<'a> {
    pub(super) scene: &'a Scene,
    pub(super) base: &'a KnowledgeBase,
    pub(super) model: Shadow,
    pub(super) objective: Objective,
}

/// The cheapest arrangement found: least sets first, then larger ones and extra moves together. `None` if the effort was
/// spent or the candidates exhausted.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub(super) fn arrange_least(
    question: &Question<'_>,
    first: Derivation,
    budget: &Budget<'_>,
) -> Result<Option<Arrangement>, Interrupted> {
    let cheapest = first.order.len();
    let mut alternatives = Alternatives::new(question.base, question.scene.target(), first);
    let mut tried: Vec<Vec<ObjectIndex>> = Vec::new();
    let mut next = alternatives.next(budget)?;
    let mut effort = Effort::new(MAX_EFFORT.saturating_add(for_steps(cheapest)));
    for cost in cheapest..=cheapest + MAX_EXTRA {
        let smaller = tried.len();
        while tried.len() < MAX_SETS
            && let Some(derivation) = next.take_if(|derivation| derivation.order.len() <= cost)
        {
            tried.push(derivation.order);
            if let Some(found) = attempt(question, &tried[tried.len() - 1], cost, &mut effort, budget)? {
                return Ok(Some(found));
            }
            next = alternatives.next(budget)?;
        }
        for set in &tried[..smaller] {
            if let Some(found) = attempt(question, set, cost, &mut effort, budget)? {
                return Ok(Some(found));
            }
        }
        if effort.left() == 0 {
            break;
        }
    }
    Ok(None)
}

/// One set with as many extra moves as the cost allows. Places that are best by the objective may all lead nowhere where
/// those that are best by another don't: a worse place is better than one more relocation.
fn attempt(
    question: &Question<'_>,
    set: &[ObjectIndex],
    cost: usize,
    effort: &mut Effort,
    budget: &Budget<'_>,
) -> Result<Option<Arrangement>, Interrupted> {
    for objective in [question.objective, question.objective.other()] {
        let Question { scene, model, .. } = *question;
        let task = Task { scene, model, set, extra: cost - set.len(), objective };
        let mut part = effort.split(MAX_EFFORT_PER_SET.saturating_add(for_steps(cost)));
        let found = arrange(&task, &mut part, budget)?;
        effort.join(part);
        if found.is_some() {
            return Ok(found);
        }
    }
    Ok(None)
}

/// One set, without alternatives: for a search that ran out of time with a derivation in hand.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub(super) fn arrange_one(
    question: &Question<'_>,
    set: &[ObjectIndex],
    budget: &Budget<'_>,
) -> Result<Option<Arrangement>, Interrupted> {
    attempt(question, set, set.len(), &mut Effort::new(MAX_EFFORT.saturating_add(for_steps(set.len()))), budget)
}

fn for_steps(steps: usize) -> u32 {
    EFFORT_PER_STEP.saturating_mul(u32::try_from(steps).unwrap_or(u32::MAX))
}
