//! Other sets that derive the target, in order of size.
//!
//! Murty's partition: the sets other than S fall into disjoint classes "holds s₁ … sᵢ₋₁ and not sᵢ", each a restricted
//! question of its own.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::least::least;
use super::outcome::{Derivation, Outcome, Restriction};
use crate::budget::{Budget, Interrupted};
use crate::knowledge::{KnowledgeBase, close};
use crate::scene::ObjectIndex;

/// Inclusion-minimal derivations in order of size, the first of them given.
pub struct Alternatives<'a> {
    base: &'a KnowledgeBase,
    target: ObjectIndex,
    /// By size, then by when they were found.
    open: BinaryHeap<Reverse<(usize, usize)>>,
    found: Vec<(Restriction, Derivation)>,
    /// The class of the set last given out, as far as it is not partitioned yet.
    class: Option<Class>,
}

/// Sets other than one that was given out: those that lack one of its objects, and hold all that come before it.
struct Class {
    restriction: Restriction,
    /// The objects that are still to be held, the next one last.
    rest: Vec<ObjectIndex>,
}

impl<'a> Alternatives<'a> {
    /// Starts with a least derivation of the target.
    pub fn new(base: &'a KnowledgeBase, target: ObjectIndex, first: Derivation) -> Self {
        let open = BinaryHeap::from([Reverse((first.order.len(), 0))]);
        Self { base, target, open, found: vec![(Restriction::default(), first)], class: None }
    }

    /// The next one, no smaller than any before. When the budget has ended, a later call goes on where this one was.
    ///
    /// # Errors
    /// [`Interrupted`] when the budget ends.
    pub fn next(&mut self, budget: &Budget<'_>) -> Result<Option<Derivation>, Interrupted> {
        loop {
            self.partition(budget)?;
            let Some(&Reverse((_, at))) = self.open.peek() else { return Ok(None) };
            let holds = self.holds(&self.found[at].1, budget)?;
            self.open.pop();
            let (restriction, derivation) = self.found[at].clone();
            let rest = derivation.order.iter().rev().copied();
            let rest = rest.filter(|object| !restriction.required.contains(object)).collect();
            self.class = Some(Class { restriction, rest });
            if holds {
                return Ok(Some(derivation));
            }
        }
    }

    fn partition(&mut self, budget: &Budget<'_>) -> Result<(), Interrupted> {
        let Some(Class { restriction, rest }) = &mut self.class else { return Ok(()) };
        while let Some(&object) = rest.last() {
            let mut narrower = restriction.clone();
            narrower.held.push(object);
            match least(self.base, self.target, &narrower, budget) {
                Outcome::Least(set) => {
                    self.open.push(Reverse((set.derivation.order.len(), self.found.len())));
                    self.found.push((narrower, set.derivation));
                }
                Outcome::Underivable => {}
                Outcome::Interrupted(_) => return Err(Interrupted),
            }
            restriction.required.push(object);
            rest.pop();
        }
        self.class = None;
        Ok(())
    }

    /// A required object that nothing in the set makes graspable can't be moved: such a set is none.
    fn holds(&self, derivation: &Derivation, budget: &Budget<'_>) -> Result<bool, Interrupted> {
        let mut moved = vec![false; self.base.len()];
        derivation.order.iter().for_each(|object| moved[object.get()] = true);
        let closure = close(self.base, |object| !moved[object.get()], budget)?;
        Ok(derivation.order.iter().all(|&object| closure.derives(object)))
    }
}
