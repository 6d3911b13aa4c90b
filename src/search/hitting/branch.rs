//! Depth-first search: bound, decide, choose.

use super::instance::{Decided, Instance};
use super::prices::{raise, share};
use super::reduce::reduce;
use crate::budget::Interrupted;
use crate::search::pace::Pace;
use crate::search::problem::Node;

/// Rounds for the prices of a part that begins without any, and of one that has its parent's.
const FIRST_ROUNDS: usize = 100;
const ROUNDS: usize = 12;
/// Choices that may be open at once. Each is a frame on the stack; a search so deep would not end in any time.
const MAX_DEPTH: usize = 1000;

/// A least set that meets every landmark, if it has fewer than `limit` members. Where the budget ends first, or the
/// `choices` are spent (they are counted down): `Err` with the bound reached.
pub(in crate::search) fn least(
    landmarks: &[Vec<Node>],
    limit: usize,
    choices: &mut usize,
    pace: &mut Pace<'_>,
) -> Result<Option<Vec<Node>>, usize> {
    let Ok(root) = Root::new(landmarks, limit, pace) else { return Err(0) };
    let bound = root.bound();
    let Some(rest) = limit.checked_sub(root.decided.count()).filter(|rest| *rest > 0) else { return Ok(None) };
    let found =
        Search { choices, pace }.each(root.parts, &root.bounds, rest, MAX_DEPTH).map_err(|Interrupted| bound)?;
    Ok(found.map(|rest| {
        let mut found = root.decided.complete(rest);
        found.sort_unstable();
        found
    }))
}

/// No set of fewer members meets every landmark; found without any choice.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub(in crate::search) fn bound(
    landmarks: &[Vec<Node>],
    limit: usize,
    pace: &mut Pace<'_>,
) -> Result<usize, Interrupted> {
    Ok(Root::new(landmarks, limit, pace)?.bound())
}

/// Where a search begins.
struct Root {
    decided: Decided,
    parts: Vec<Instance>,
    /// Per part how many elements it needs at least.
    bounds: Vec<usize>,
}

impl Root {
    fn new(landmarks: &[Vec<Node>], limit: usize, pace: &mut Pace<'_>) -> Result<Self, Interrupted> {
        let (mut instance, mut decided) = (Instance::new(landmarks), Decided::default());
        // No landmark is empty, so each can be met.
        reduce(&mut instance, &mut decided, pace)?;
        let mut parts = instance.parts();
        let mut price = |part: &mut Instance| {
            share(part);
            raise(part, limit, FIRST_ROUNDS, pace).bound()
        };
        let bounds = parts.iter_mut().map(&mut price).collect();
        Ok(Self { decided, parts, bounds })
    }

    fn bound(&self) -> usize {
        self.decided.count() + self.bounds.iter().sum::<usize>()
    }
}

struct Search<'s, 'b> {
    choices: &'s mut usize,
    pace: &'s mut Pace<'b>,
}

/// `None` if every solution has at least as many elements as the limit.
type Found = Result<Option<Vec<Node>>, Interrupted>;

impl Search<'_, '_> {
    /// A least solution if it has fewer than `limit` elements.
    fn below(&mut self, mut instance: Instance, limit: usize, depth: usize) -> Found {
        let mut decided = Decided::default();
        if !reduce(&mut instance, &mut decided, self.pace)? || decided.count() >= limit {
            return Ok(None);
        }
        let limit = limit - decided.count();
        let mut parts = instance.parts();
        drop(instance);
        let rest = if parts.len() == 1 {
            self.choose(parts.swap_remove(0), limit, depth)?
        } else {
            parts.sort_by_key(Instance::sets);
            // What one element meets would have been decided.
            let bounds = vec![2; parts.len()];
            self.each(parts, &bounds, limit, depth)?
        };
        Ok(rest.map(|rest| decided.complete(rest)))
    }

    /// Like [`Self::below`], for parts that have nothing to do with each other and need so many elements at least.
    fn each(&mut self, parts: Vec<Instance>, bounds: &[usize], limit: usize, depth: usize) -> Found {
        let mut all = Vec::new();
        let mut later: usize = bounds.iter().sum();
        for (part, bound) in parts.into_iter().zip(bounds) {
            later -= bound;
            let Some(limit) = limit.checked_sub(all.len() + later).filter(|limit| limit > bound) else {
                return Ok(None);
            };
            let Some(found) = self.choose(part, limit, depth)? else { return Ok(None) };
            all.extend(found);
        }
        Ok(Some(all))
    }

    /// Like [`Self::below`], for one reduced part: some element is taken, or it is not.
    fn choose(&mut self, mut part: Instance, limit: usize, depth: usize) -> Found {
        let depth = depth.checked_sub(1).ok_or(Interrupted)?;
        *self.choices = self.choices.checked_sub(1).ok_or(Interrupted)?;
        self.pace.step(1)?;
        let worth = raise(&mut part, limit, ROUNDS, self.pace);
        if worth.bound() >= limit {
            return Ok(None);
        }
        let mut decided = Decided::default();
        let mut fixed = false;
        for element in 0..part.elements() {
            if worth.bound_if(element, true) >= limit {
                part.exclude(element);
                fixed = true;
            } else if worth.bound_if(element, false) >= limit {
                part.take(element, &mut decided);
                fixed = true;
            }
        }
        if fixed {
            let Some(limit) = limit.checked_sub(decided.count()) else { return Ok(None) };
            return Ok(self.below(part, limit, depth)?.map(|rest| decided.complete(rest)));
        }
        let Some(element) = most_wanted(&part) else { return Ok(Some(Vec::new())) };
        let mut with = part.clone();
        with.take(element, &mut decided);
        let with = self.below(with, limit - 1, depth)?.map(|rest| decided.complete(rest));
        let limit = with.as_ref().map_or(limit, Vec::len);
        if limit <= worth.bound() {
            return Ok(with);
        }
        part.exclude(element);
        Ok(self.below(part, limit, depth)?.or(with))
    }
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
