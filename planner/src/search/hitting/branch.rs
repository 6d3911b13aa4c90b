//! What is seen of a question without asking another one: it is decided, it falls into parts, or it needs a choice.

use super::fork::{Choice, Fork, Parts};
use super::instance::{Decided, Instance};
use super::prices::{Valuation, raise};
use super::reduce::reduce;
use super::{Found, Stop};
use crate::search::pace::Pace;

/// Rounds for the prices of a part, which come from the part before it.
const ROUNDS: usize = 12;

/// Asks for a least solution of the instance with fewer than `limit` elements.
pub(super) struct Question {
    pub(super) instance: Instance,
    pub(super) limit: usize,
    /// One part, in which nothing can be decided but by prices.
    pub(super) reduced: bool,
}

/// What is seen of a question.
pub(super) enum Sight {
    Answer(Found),
    /// Others have to be answered first.
    Fork(Box<Fork>),
}

/// Decide what needs no choice, and bound the rest.
///
/// # Errors
/// [`Stop`] when the budget ends or the `choices`, which are counted down, are spent.
pub(super) fn look(question: Question, choices: &mut usize, pace: &mut Pace<'_>) -> Result<Sight, Stop> {
    let Question { mut instance, limit, mut reduced } = question;
    let mut decided = Decided::default();
    loop {
        pace.step(instance.steps())?;
        if !core::mem::take(&mut reduced) {
            if !reduce(&mut instance, &mut decided, pace)? || decided.count() >= limit {
                return Ok(Sight::Answer(None));
            }
            let mut parts = instance.parts();
            if parts.len() != 1 {
                parts.sort_by_key(Instance::sets);
                // What one element meets would have been decided.
                let bounds = vec![2; parts.len()];
                return Ok(Sight::Fork(Box::new(Fork::Parts(Parts::new(decided, parts, bounds, limit)))));
            }
            instance = parts.swap_remove(0);
        }
        *choices = choices.checked_sub(1).ok_or(Stop::Spent)?;
        let rest = limit - decided.count();
        let worth = raise(&mut instance, rest, ROUNDS, pace).map_err(|_| Stop::Interrupted)?;
        if worth.bound() >= rest {
            return Ok(Sight::Answer(None));
        }
        if fix(&mut instance, &worth, rest, &mut decided) {
            if decided.count() >= limit {
                return Ok(Sight::Answer(None));
            }
            continue;
        }
        let Some(element) = most_wanted(&instance) else {
            return Ok(Sight::Answer(Some(decided.complete(Vec::new()))));
        };
        return Ok(Sight::Fork(Box::new(Fork::Choice(Choice::new(decided, instance, element, worth.bound(), limit)))));
    }
}

/// Leave out, and take, what a solution with fewer than `limit` elements must. True if there is anything.
fn fix(instance: &mut Instance, worth: &Valuation, limit: usize, decided: &mut Decided) -> bool {
    let mut fixed = false;
    for element in 0..instance.elements() {
        if worth.bound_if(element, true) >= limit {
            instance.exclude(element);
            fixed = true;
        } else if worth.bound_if(element, false) >= limit {
            instance.take(element, decided);
            fixed = true;
        }
    }
    fixed
}

/// The element that meets most of what is open, small sets first of all; `None` if nothing is.
pub(super) fn most_wanted(instance: &Instance) -> Option<usize> {
    let mut wanted = vec![0_u32; instance.elements()];
    for set in (0..instance.sets()).filter(|&set| instance.is_open(set)) {
        let weight = match instance.members().count(set) {
            0..=2 => 8,
            3 => 4,
            4 => 2,
            _ => 1,
        };
        instance.members().ones(set).for_each(|element| wanted[element] += weight);
    }
    let best = (0..wanted.len()).max_by_key(|&element| (wanted[element], core::cmp::Reverse(element)))?;
    (wanted[best] > 0).then_some(best)
}
