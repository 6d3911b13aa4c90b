//! The next best sets that derive the target, in order of size, by Murty's partition (1968).
//!
//! The sets other than S fall into disjoint classes: "holds s₁ … sᵢ₋₁ but not sᵢ" for each i. Each class is a
//! restricted question.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::least::least;
use super::outcome::{Derivation, Restriction, SearchOutcome};
use crate::budget::{Budget, Interrupted};
use crate::cost::Cost;
use crate::knowledge::{KnowledgeBase, derivable};
use crate::scene::ObjectIndex;

/// Enumerates inclusion-minimal derivations in order of size.
pub struct Alternatives<'a> {
    base: &'a KnowledgeBase,
    target: ObjectIndex,
    /// Positions in `found`, by size, then by age.
    open: BinaryHeap<Reverse<(Cost, usize)>>,
    found: Vec<(Restriction, Derivation)>,
    /// The class of the last set returned, as far as it is not partitioned yet.
    class: Option<Class>,
}

/// The class of a set that was returned, under partition.
struct Class {
    restriction: Restriction,
    /// The objects of the set that are still to be excluded, the next one last.
    rest: Vec<ObjectIndex>,
}

impl<'a> Alternatives<'a> {
    /// `first` is a least derivation of the target, and is returned first.
    pub fn new(base: &'a KnowledgeBase, target: ObjectIndex, first: Derivation) -> Self {
        let open = BinaryHeap::from([Reverse((first.cost(), 0))]);
        Self { base, target, open, found: vec![(Restriction::default(), first)], class: None }
    }

    /// The next derivation, no shorter than any before. After an interruption the next call goes on where this one
    /// stopped.
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
                SearchOutcome::Least(set) => {
                    self.open.push(Reverse((set.derivation.cost(), self.found.len())));
                    self.found.push((narrower, set.derivation));
                }
                SearchOutcome::Underivable => {}
                SearchOutcome::Interrupted(_) => return Err(Interrupted),
            }
            restriction.required.push(object);
            rest.pop();
        }
        self.class = None;
        Ok(())
    }

    /// True if every object of the set is derived within it. A required object may not be: then the set is no solution.
    fn holds(&self, derivation: &Derivation, budget: &Budget<'_>) -> Result<bool, Interrupted> {
        let mut moved = vec![false; self.base.len()];
        derivation.order.iter().for_each(|object| moved[object.get()] = true);
        let derivable = derivable(self.base, |object| !moved[object.get()], budget)?;
        Ok(derivation.order.iter().all(|&object| derivable.derives(object)))
    }
}
