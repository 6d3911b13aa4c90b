//! A family of sets to be hit, with reductions that keep the size of a least hitting set.

use crate::budget::{Interrupted, Ticker};

/// A sorted set of small numbers.
#[derive(Debug, Clone)]
pub(super) struct Set {
    members: Vec<usize>,
    /// One bit for each residue modulo 64, as a fast test: most pairs that are not subsets fail it.
    signature: u64,
    /// Its Lagrange multiplier, see [`super::multipliers`]; 0 at first.
    pub(super) multiplier: f64,
}

impl Set {
    /// `members` in increasing order.
    pub(super) fn new(members: Vec<usize>) -> Self {
        let signature = members.iter().fold(0, |bits, member| bits | 1 << (member % 64));
        Self { members, signature, multiplier: 0.0 }
    }

    /// A set of other members with the same multiplier.
    fn with(&self, members: Vec<usize>) -> Self {
        Self { multiplier: self.multiplier, ..Self::new(members) }
    }

    pub(super) fn members(&self) -> &[usize] {
        &self.members
    }

    /// True if this set is a subset of `other`. Adds the number of members compared, plus one, to `compared`.
    fn is_within(&self, other: &Self, compared: &mut usize) -> bool {
        *compared += 1;
        if self.signature & !other.signature != 0 || self.members.len() > other.members.len() {
            return false;
        }
        *compared += other.members.len();
        let mut rest = other.members.iter();
        self.members.iter().all(|member| rest.by_ref().any(|candidate| candidate == member))
    }
}

/// Sets over the elements 0 to `width` − 1; none is empty.
#[derive(Debug, Clone)]
pub(super) struct Family {
    pub(super) sets: Vec<Set>,
    pub(super) width: usize,
}

/// A reduced family.
pub(super) struct Reduced {
    /// The number of elements decided: single members, and one for each fold.
    pub(super) forced: usize,
    /// The rest: sets of two or more members, no supersets, no dominated elements.
    pub(super) rest: Family,
}

impl Family {
    /// The element that hits most sets, where small sets count more; `None` if there is no set.
    pub(super) fn most_frequent(&self) -> Option<usize> {
        let mut weight = vec![0_usize; self.width];
        for set in &self.sets {
            let each = 8 >> (set.members().len().clamp(2, 5) - 2);
            set.members().iter().for_each(|member| weight[*member] += each);
        }
        let best = (0..self.width).rev().max_by_key(|element| weight[*element])?;
        (weight[best] > 0).then_some(best)
    }

    /// Greedy set packing: the number of disjoint sets found, smallest sets first. It is a lower bound.
    pub(super) fn packing(&self) -> usize {
        let mut order: Vec<&Set> = self.sets.iter().collect();
        order.sort_by_key(|set| set.members.len());
        let mut used = vec![false; self.width];
        let mut count = 0;
        for set in order {
            if set.members.iter().all(|member| !used[*member]) {
                set.members.iter().for_each(|member| used[*member] = true);
                count += 1;
            }
        }
        count
    }

    /// Per element the positions of its sets.
    pub(super) fn columns(&self) -> Vec<Vec<usize>> {
        let mut columns = vec![Vec::new(); self.width];
        for (at, set) in self.sets.iter().enumerate() {
            for member in &set.members {
                columns[*member].push(at);
            }
        }
        columns
    }

    /// The number of members of all sets together.
    pub(super) fn size(&self) -> usize {
        self.sets.iter().map(|set| set.members.len()).sum()
    }

    /// The work of one pass over all members, in steps of the ticker.
    pub(super) fn units(&self) -> usize {
        1 + (self.size() + self.width) / 200
    }

    /// Drops supersets, takes single members, drops dominated elements and folds, until nothing changes. The size of a
    /// least hitting set is `forced` plus that of the rest.
    pub(super) fn reduce(mut self, ticker: &mut Ticker<'_>) -> Result<Reduced, Interrupted> {
        let mut forced = 0;
        loop {
            self.drop_supersets(ticker)?;
            let before = self.sets.len();
            // The supersets of a single member are dropped already, so it hits no other set.
            self.sets.retain(|set| set.members.len() > 1);
            forced += before - self.sets.len();
            if self.drop_dominated(ticker)? {
                continue;
            }
            let folds = self.fold(ticker)?;
            forced += folds;
            if folds == 0 {
                return Ok(Reduced { forced, rest: self });
            }
        }
    }

    /// Drops supersets: an element that hits a set hits its supersets.
    fn drop_supersets(&mut self, ticker: &mut Ticker<'_>) -> Result<(), Interrupted> {
        self.sets.sort_by(|a, b| a.members.len().cmp(&b.members.len()).then_with(|| a.members.cmp(&b.members)));
        let mut kept: Vec<Set> = Vec::with_capacity(self.sets.len());
        for set in self.sets.drain(..) {
            let mut compared = 0;
            if !kept.iter().any(|smaller| smaller.is_within(&set, &mut compared)) {
                kept.push(set);
            }
            ticker.step(1 + compared / 200)?;
        }
        self.sets = kept;
        Ok(())
    }

    /// Drops dominated elements: those whose sets are all hit by another element. True if any was dropped.
    fn drop_dominated(&mut self, ticker: &mut Ticker<'_>) -> Result<bool, Interrupted> {
        let columns: Vec<Set> = self.columns().into_iter().map(Set::new).collect();
        let mut dropped = vec![false; self.width];
        for (element, column) in columns.iter().enumerate() {
            let Some(&first) = column.members.first() else { continue };
            let rivals = &self.sets[first].members;
            let mut compared = rivals.len();
            dropped[element] = rivals
                .iter()
                .any(|&rival| rival != element && !dropped[rival] && column.is_within(&columns[rival], &mut compared));
            ticker.step(1 + compared / 100)?;
        }
        if !dropped.contains(&true) {
            return Ok(false);
        }
        for set in &mut self.sets {
            *set = set.with(set.members.iter().copied().filter(|member| !dropped[*member]).collect());
        }
        Ok(true)
    }

    /// The connected components: parts that share no element, each with its elements renumbered.
    pub(super) fn components(&self) -> Vec<Self> {
        let columns = self.columns();
        let mut numbers: Vec<Option<usize>> = vec![None; self.width];
        let mut seen = vec![false; self.sets.len()];
        let mut components = Vec::new();
        for first in 0..self.sets.len() {
            if seen[first] {
                continue;
            }
            seen[first] = true;
            let (mut found, mut at, mut width) = (vec![first], 0, 0);
            while at < found.len() {
                for &member in &self.sets[found[at]].members {
                    if numbers[member].is_some() {
                        continue;
                    }
                    numbers[member] = Some(width);
                    width += 1;
                    for &other in &columns[member] {
                        if !core::mem::replace(&mut seen[other], true) {
                            found.push(other);
                        }
                    }
                }
                at += 1;
            }
            components.push(self.part(&found, &numbers, width));
        }
        components
    }

    fn part(&self, found: &[usize], numbers: &[Option<usize>], width: usize) -> Self {
        let renumbered = found.iter().map(|&at| {
            let mut members: Vec<usize> = self.sets[at].members.iter().filter_map(|member| numbers[*member]).collect();
            members.sort_unstable();
            self.sets[at].with(members)
        });
        Self { sets: renumbered.collect(), width }
    }

    /// The sets left once all of `taken` are taken and all of `refused` are refused. `None` if a set has no member
    /// left.
    pub(super) fn after(&self, taken: &[usize], refused: &[usize]) -> Option<Self> {
        let (is_taken, is_refused) = (self.mask(taken), self.mask(refused));
        let open = self.sets.iter().filter(|set| !set.members.iter().any(|member| is_taken[*member]));
        let left = open.map(|set| {
            let members: Vec<usize> = set.members.iter().copied().filter(|member| !is_refused[*member]).collect();
            (!members.is_empty()).then(|| set.with(members))
        });
        Some(Self { sets: left.collect::<Option<_>>()?, width: self.width })
    }

    /// Per element whether it is one of `elements`.
    fn mask(&self, elements: &[usize]) -> Vec<bool> {
        let mut mask = vec![false; self.width];
        elements.iter().for_each(|element| mask[*element] = true);
        mask
    }

    /// Folds elements of degree two (Chen, Kanj & Jia 2001). Where an element hits two pairs and nothing else, some
    /// least hitting set holds either it alone or both of its partners. Dropping the pairs and merging the partners
    /// lowers the size by one. Returns the number of folds.
    fn fold(&mut self, ticker: &mut Ticker<'_>) -> Result<usize, Interrupted> {
        ticker.step(self.units())?;
        let columns = self.columns();
        let mut touched = vec![false; self.width];
        let mut gone = vec![false; self.sets.len()];
        let mut becomes: Vec<usize> = (0..self.width).collect();
        let mut folds = 0;
        for (centre, column) in columns.iter().enumerate() {
            let [first, second] = column[..] else { continue };
            let partner = |at: usize| match self.sets[at].members[..] {
                [a, b] => Some(if a == centre { b } else { a }),
                _ => None,
            };
            let (Some(one), Some(two)) = (partner(first), partner(second)) else { continue };
            if [centre, one, two].iter().any(|element| touched[*element]) {
                continue;
            }
            [centre, one, two].iter().for_each(|element| touched[*element] = true);
            (gone[first], gone[second]) = (true, true);
            becomes[two] = one;
            folds += 1;
        }
        if folds > 0 {
            let mut gone = gone.into_iter();
            self.sets.retain(|_| gone.next() != Some(true));
            for set in &mut self.sets {
                let mut members: Vec<usize> = set.members.iter().map(|member| becomes[*member]).collect();
                members.sort_unstable();
                members.dedup();
                *set = set.with(members);
            }
        }
        Ok(folds)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::budget::clocks::Looks;

    #[test]
    fn a_reduction_costs_as_much_as_the_members_that_are_compared() {
        // 300 sets of `size` members each; no set holds another one.
        let looks = |size: usize| {
            let sets = (0..300).map(|at| Set::new((at..at + size).collect())).collect();
            let mut family = Family { sets, width: 300 + size };
            let looks = Looks::of(|budget| family.drop_supersets(&mut Ticker::new(budget)).unwrap());
            assert_eq!(family.sets.len(), 300);
            looks
        };
        let (small, large) = (looks(8), looks(1024));
        assert!(large > 10 * small, "{small} {large}");
    }
}
