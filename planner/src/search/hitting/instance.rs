//! A hitting set instance as a bit matrix, stored by sets and by elements, with its elementary changes.

use crate::budget::{Interrupted, Ticker};
use crate::search::bits::Bits;
use crate::search::problem::Node;

/// Sets to be hit by as few elements as possible.
#[derive(Debug, Clone)]
pub(super) struct Instance {
    /// Per element its node.
    labels: Vec<Node>,
    /// Per set its elements.
    members: Bits,
    /// Per element the open sets that it hits.
    sets_of: Bits,
    /// One row: the sets not hit yet.
    open: Bits,
    /// Per set its multiplier, see [`super::multipliers`].
    pub(super) multipliers: Vec<f64>,
    /// One row each: the sets and elements that [`super::reduce`] has to look at again.
    pub(super) shrunk_sets: Bits,
    pub(super) shrunk_elements: Bits,
}

/// The decided part of a least solution.
#[derive(Debug, Default)]
pub(super) struct Decided {
    taken: Vec<Node>,
    folds: Vec<Fold>,
}

/// Three folded elements: a least solution holds either the `centre` alone or both others. `kept` stands for both
/// others.
#[derive(Debug)]
struct Fold {
    centre: Node,
    kept: Node,
    other: Node,
}

impl Decided {
    /// The number of decided elements.
    pub(super) fn count(&self) -> usize {
        self.taken.len() + self.folds.len()
    }

    /// The whole solution, given one of the rest.
    pub(super) fn complete(&self, mut rest: Vec<Node>) -> Vec<Node> {
        rest.extend(&self.taken);
        for fold in self.folds.iter().rev() {
            let both = rest.contains(&fold.kept);
            rest.push(if both { fold.other } else { fold.centre });
        }
        rest
    }
}

impl Instance {
    /// The instance of `sets`, all open and not reduced. Members need no order.
    ///
    /// # Errors
    /// [`Interrupted`] when the budget ends.
    pub(super) fn read(sets: &[Vec<Node>], ticker: &mut Ticker<'_>) -> Result<Self, Interrupted> {
        ticker.step(1 + sets.iter().map(Vec::len).sum::<usize>() / 32)?;
        let instance = Self::new(sets);
        ticker.step(instance.steps())?;
        Ok(instance)
    }

    fn new(sets: &[Vec<Node>]) -> Self {
        let mut labels: Vec<Node> = sets.iter().flatten().copied().collect();
        labels.sort_unstable();
        labels.dedup();
        let mut number = vec![0; labels.last().map_or(0, |&last| last as usize + 1)];
        labels.iter().enumerate().for_each(|(at, &label)| number[label as usize] = at);
        let mut members = Bits::new(sets.len(), labels.len());
        let mut sets_of = Bits::new(labels.len(), sets.len());
        for (set, nodes) in sets.iter().enumerate() {
            for &node in nodes {
                members.set(set, number[node as usize]);
                sets_of.set(number[node as usize], set);
            }
        }
        Self {
            shrunk_sets: Bits::full(1, sets.len()),
            shrunk_elements: Bits::full(1, labels.len()),
            open: Bits::full(1, sets.len()),
            multipliers: vec![0.0; sets.len()],
            labels,
            members,
            sets_of,
        }
    }

    pub(super) fn elements(&self) -> usize {
        self.labels.len()
    }

    /// The number of sets, hit ones included.
    pub(super) fn sets(&self) -> usize {
        self.multipliers.len()
    }

    pub(super) fn label(&self, element: usize) -> Node {
        self.labels[element]
    }

    /// Its memory, in 64-bit words.
    pub(super) fn words(&self) -> usize {
        self.members.words() + self.sets_of.words() + 2 * self.sets() + 2 * self.elements()
    }

    /// Steps of a ticker for one pass over all rows: a copy, a split, a choice.
    pub(super) fn steps(&self) -> usize {
        1 + self.words() / 512
    }

    pub(super) fn members(&self) -> &Bits {
        &self.members
    }

    pub(super) fn sets_of(&self) -> &Bits {
        &self.sets_of
    }

    pub(super) fn is_open(&self, set: usize) -> bool {
        self.open.has(0, set)
    }

    /// Puts the element into the solution.
    pub(super) fn take(&mut self, element: usize, decided: &mut Decided) {
        decided.taken.push(self.labels[element]);
        self.close_all(element);
    }

    fn close_all(&mut self, element: usize) {
        let mut at = 0;
        while let Some(set) = self.sets_of.next(element, at) {
            at = set + 1;
            self.close(set);
        }
    }

    /// Closes a set that is hit.
    pub(super) fn close(&mut self, set: usize) {
        self.open.clear(0, set);
        for element in self.members.ones(set) {
            self.sets_of.clear(element, set);
            self.shrunk_elements.set(0, element);
        }
        self.members.clear_row(set);
    }

    /// Leaves the element out of the solution.
    pub(super) fn exclude(&mut self, element: usize) {
        for set in self.sets_of.ones(element) {
            self.members.clear(set, element);
            self.shrunk_sets.set(0, set);
        }
        self.sets_of.clear_row(element);
    }

    /// Folds an element of degree two. `centre` is in two sets, each with one other element, so a least solution holds
    /// it alone or both others. The others become one element, which is in the solution if both are.
    pub(super) fn fold(&mut self, centre: usize, kept: usize, other: usize, decided: &mut Decided) {
        let label = |element: usize| self.labels[element];
        decided.folds.push(Fold { centre: label(centre), kept: label(kept), other: label(other) });
        self.close_all(centre);
        let mut at = 0;
        while let Some(set) = self.sets_of.next(other, at) {
            at = set + 1;
            self.members.clear(set, other);
            self.members.set(set, kept);
            self.sets_of.set(kept, set);
        }
        self.sets_of.clear_row(other);
        // Sets may have become supersets, and elements may have become dominated.
        for set in self.sets_of.ones(kept) {
            self.shrunk_sets.set(0, set);
            self.members.ones(set).for_each(|element| self.shrunk_elements.set(0, element));
        }
    }

    /// The connected components: open sets in parts that share no element.
    pub(super) fn parts(&self) -> Vec<Self> {
        let mut left = self.open.clone();
        let mut seen = Bits::new(1, self.elements());
        let mut parts = Vec::new();
        while let Some(first) = left.next(0, 0) {
            left.clear(0, first);
            let (mut sets, mut elements, mut at) = (vec![first], Vec::new(), 0);
            while let Some(&set) = sets.get(at) {
                at += 1;
                for element in self.members.ones(set) {
                    if seen.has(0, element) {
                        continue;
                    }
                    seen.set(0, element);
                    elements.push(element);
                    let known = sets.len();
                    sets.extend(self.sets_of.ones(element).filter(|&other| left.has(0, other)));
                    sets[known..].iter().for_each(|&other| left.clear(0, other));
                }
            }
            sets.sort_unstable();
            elements.sort_unstable();
            parts.push(self.part(&sets, &elements));
        }
        parts
    }

    fn part(&self, sets: &[usize], elements: &[usize]) -> Self {
        let mut number = vec![0; self.elements()];
        elements.iter().enumerate().for_each(|(at, &element)| number[element] = at);
        let mut members = Bits::new(sets.len(), elements.len());
        let mut sets_of = Bits::new(elements.len(), sets.len());
        for (at, &set) in sets.iter().enumerate() {
            for element in self.members.ones(set) {
                members.set(at, number[element]);
                sets_of.set(number[element], at);
            }
        }
        Self {
            labels: elements.iter().map(|&element| self.labels[element]).collect(),
            members,
            sets_of,
            open: Bits::full(1, sets.len()),
            multipliers: sets.iter().map(|&set| self.multipliers[set]).collect(),
            shrunk_sets: Bits::new(1, sets.len()),
            shrunk_elements: Bits::new(1, elements.len()),
        }
    }
}
