//! One node of the branch and bound: a question is answered at once, falls into parts, or needs a choice.

use super::Solution;
use super::fork::{Choice, Fork, Parts};
use super::instance::{Decided, Instance};
use super::multipliers::{LagrangianBound, raise};
use super::reduce::reduce;
use crate::budget::{Stop, Ticker};

/// Subgradient rounds for a part that inherits its multipliers.
const ROUNDS: usize = 12;

/// Is there a hitting set of the instance with fewer than `limit` elements? If so, which is least?
pub(super) struct Question {
    pub(super) instance: Instance,
    pub(super) limit: usize,
    /// True for a single part that is fully reduced: only the bound can decide more.
    pub(super) reduced: bool,
}

/// The outcome of one look at a question.
pub(super) enum Sight {
    Answer(Solution),
    /// Other questions have to be answered first.
    Fork(Box<Fork>),
}

/// Reduces the question, bounds what is left, and fixes elements by the bound.
///
/// # Errors
/// [`Stop`] when the budget ends or the `choices`, which are counted down, are spent.
pub(super) fn look(question: Question, choices: &mut usize, ticker: &mut Ticker<'_>) -> Result<Sight, Stop> {
    let Question { mut instance, limit, mut reduced } = question;
    let mut decided = Decided::default();
    loop {
        ticker.step(instance.steps())?;
        if !core::mem::take(&mut reduced) {
            if !reduce(&mut instance, &mut decided, ticker)? || decided.count() >= limit {
                return Ok(Sight::Answer(None));
            }
            let mut parts = instance.parts();
            if parts.len() != 1 {
                parts.sort_by_key(Instance::sets);
                // A part that one element hits was solved by `reduce`, so each part needs two.
                let bounds = vec![2; parts.len()];
                return Ok(Sight::Fork(Box::new(Fork::Parts(Parts::new(decided, parts, bounds, limit)))));
            }
            instance = parts.swap_remove(0);
        }
        *choices = choices.checked_sub(1).ok_or(Stop::Spent)?;
        let rest = limit - decided.count();
        let lagrangian = raise(&mut instance, rest, ROUNDS, ticker).map_err(|_| Stop::Interrupted)?;
        if lagrangian.bound() >= rest {
            return Ok(Sight::Answer(None));
        }
        if fix(&mut instance, &lagrangian, rest, &mut decided) {
            if decided.count() >= limit {
                return Ok(Sight::Answer(None));
            }
            continue;
        }
        let Some(element) = most_frequent(&instance) else {
            return Ok(Sight::Answer(Some(decided.complete(Vec::new()))));
        };
        return Ok(Sight::Fork(Box::new(Fork::Choice(Choice::new(
            decided,
            instance,
            element,
            lagrangian.bound(),
            limit,
        )))));
    }
}

/// Reduced-cost fixing: leaves out or takes every element for which the opposite needs `limit` elements or more. True
/// if it fixed any.
fn fix(instance: &mut Instance, lagrangian: &LagrangianBound, limit: usize, decided: &mut Decided) -> bool {
    let mut fixed = false;
    for element in 0..instance.elements() {
        if lagrangian.bound_if(element, true) >= limit {
            instance.exclude(element);
            fixed = true;
        } else if lagrangian.bound_if(element, false) >= limit {
            instance.take(element, decided);
            fixed = true;
        }
    }
    fixed
}

/// The element that hits most open sets, where small sets count more; `None` if no set is open.
pub(super) fn most_frequent(instance: &Instance) -> Option<usize> {
    let mut weights = vec![0_u32; instance.elements()];
    for set in (0..instance.sets()).filter(|&set| instance.is_open(set)) {
        let weight = match instance.members().count(set) {
            0..=2 => 8,
            3 => 4,
            4 => 2,
            _ => 1,
        };
        instance.members().ones(set).for_each(|element| weights[element] += weight);
    }
    let best = (0..weights.len()).max_by_key(|&element| (weights[element], core::cmp::Reverse(element)))?;
    (weights[best] > 0).then_some(best)
}
