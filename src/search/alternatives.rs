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
    /// The set last given out, whose class is not yet partitioned.
    last: Option<usize>,
}

impl<'a> Alternatives<'a> {
    /// Starts with a least derivation of the target.
    pub fn new(base: &'a KnowledgeBase, target: ObjectIndex, first: Derivation) -> Self {
        let open = BinaryHeap::from([Reverse((first.order.len(), 0))]);
        Self { base, target, open, found: vec![(Restriction::default(), first)], last: None }
    }

    /// The next one, no smaller than any before.
    ///
    /// # Errors
    /// [`Interrupted`] when the budget ends.
    pub fn next(&mut self, budget: &Budget<'_>) -> Result<Option<Derivation>, Interrupted> {
        loop {
            if let Some(last) = self.last.take() {
                self.partition(last, budget)?;
            }
            let Some(Reverse((_, at))) = self.open.pop() else { return Ok(None) };
            self.last = Some(at);
            let derivation = &self.found[at].1;
            if self.holds(derivation, budget)? {
                return Ok(Some(derivation.clone()));
            }
        }
    }

    fn partition(&mut self, at: usize, budget: &Budget<'_>) -> Result<(), Interrupted> {
        let (mut restriction, derivation) = self.found[at].clone();
        for object in derivation.order {
            if restriction.required.contains(&object) {
                continue;
            }
            restriction.held.push(object);
            match least(self.base, self.target, &restriction, budget) {
                Outcome::Least(set) => {
                    self.open.push(Reverse((set.derivation.order.len(), self.found.len())));
                    self.found.push((restriction.clone(), set.derivation));
                }
                Outcome::Underivable => {}
                Outcome::Interrupted(_) => return Err(Interrupted),
            }
            restriction.held.pop();
            restriction.required.push(object);
        }
        Ok(())
    }

    /// A required object that nothing in the set makes graspable can't be moved: such a set is none.
    fn holds(&self, derivation: &Derivation, budget: &Budget<'_>) -> Result<bool, Interrupted> {
        let closure = close(self.base, |object| !derivation.order.contains(&object), budget)?;
        Ok(derivation.order.iter().all(|&object| closure.derives(object)))
    }
}
