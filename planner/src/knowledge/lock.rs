//! Locks: sets of objects that block each other.
//!
//! A set is a lock if every option of every movable member holds a member: then no member can be the first to be
//! grasped. The objects that forward chaining does not derive are the greatest lock.

use std::collections::VecDeque;

use super::base::KnowledgeBase;
use super::derivable::Derivable;
use crate::budget::{Budget, Interrupted};
use crate::scene::ObjectIndex;

/// The greatest lock and an inclusion-minimal one within it, both in index order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Locks {
    /// The greatest lock: the underived objects that have options. (The caller adds those without options, since it
    /// knows why they have none.)
    pub blocked: Vec<ObjectIndex>,
    /// A lock with what is wanted; inclusion-minimal unless the budget ended first.
    pub core: Vec<ObjectIndex>,
}

/// The locks around `wanted` objects, none of which may be `derivable` (from the same base). An object without options may be
/// a member as it is. `wanted` is in index order.
///
/// # Errors
/// [`Interrupted`] when the budget ends before there is a lock at all.
pub fn locks(
    base: &KnowledgeBase,
    derivable: &Derivable,
    wanted: &[ObjectIndex],
    budget: &Budget<'_>,
) -> Result<Locks, Interrupted> {
    let mut grown = GrowingLock::grow(base, derivable, wanted, budget)?;
    grown.minimise(budget);
    let movable = |object: &ObjectIndex| !base.rules_of(*object).is_empty();
    let blocked = base.objects().filter(|object| !derivable.derives(*object)).filter(movable).collect();
    Ok(Locks { blocked, core: grown.members() })
}

/// A lock under construction.
struct GrowingLock<'a> {
    base: &'a KnowledgeBase,
    /// The members that stay, in index order.
    wanted: &'a [ObjectIndex],
    member: Vec<bool>,
    /// The members in the order in which they entered.
    entered: Vec<ObjectIndex>,
    /// Per rule of a member the number of members in its body.
    holders: Vec<u32>,
    /// Per object the rules of members that have it in their bodies.
    condition_of: Vec<Vec<(u32, ObjectIndex)>>,
}

impl<'a> GrowingLock<'a> {
    /// Grows a lock from the wanted objects outwards. For each option of a member that holds no member, an underived object of
    /// that option enters.
    fn grow(
        base: &'a KnowledgeBase,
        derivable: &Derivable,
        wanted: &'a [ObjectIndex],
        budget: &Budget<'_>,
    ) -> Result<Self, Interrupted> {
        let mut core = Self {
            base,
            wanted,
            member: vec![false; base.len()],
            entered: Vec::new(),
            holders: vec![0; base.rules()],
            condition_of: vec![Vec::new(); base.len()],
        };
        let mut open: VecDeque<ObjectIndex> = wanted.iter().copied().collect();
        wanted.iter().for_each(|&object| core.enter(object));
        while let Some(object) = open.pop_front() {
            budget.check()?;
            while let Some(holder) = core.best_holder(object, derivable) {
                core.enter(holder);
                open.push_back(holder);
            }
        }
        Ok(core)
    }

    fn enter(&mut self, object: ObjectIndex) {
        self.member[object.get()] = true;
        self.entered.push(object);
        for rule in self.base.rules_of(object) {
            for &other in self.base.body(rule) {
                #[expect(clippy::cast_possible_truncation, reason = "a base has fewer than 2^32 rules")]
                self.condition_of[other.get()].push((rule as u32, object));
                self.holders[rule] += u32::from(self.member[other.get()]);
            }
        }
        for at in 0..self.condition_of[object.get()].len() {
            let (rule, head) = self.condition_of[object.get()][at];
            // Its own rules were counted above.
            self.holders[rule as usize] += u32::from(head != object);
        }
    }

    /// The underived object in most of those options of `object` that hold no member yet. An object without options is
    /// best, since it needs no holder itself.
    fn best_holder(&self, object: ObjectIndex, derivable: &Derivable) -> Option<ObjectIndex> {
        let open: Vec<usize> = self.base.rules_of(object).filter(|&rule| self.holders[rule] == 0).collect();
        let mut candidates: Vec<ObjectIndex> =
            open.iter().flat_map(|&rule| self.base.body(rule)).copied().filter(|o| !derivable.derives(*o)).collect();
        candidates.sort_unstable();
        let runs = candidates.chunk_by(|a, b| a == b);
        let rank =
            |run: &&[ObjectIndex]| (self.base.rules_of(run[0]).is_empty(), run.len(), core::cmp::Reverse(run[0]));
        runs.max_by_key(rank).map(|run| run[0])
    }

    /// Drops members, the latest first, as long as all that is wanted stays locked.
    fn minimise(&mut self, budget: &Budget<'_>) {
        for at in (0..self.entered.len()).rev() {
            if budget.check().is_err() {
                return;
            }
            let object = self.entered[at];
            if self.member[object.get()] && self.wanted.binary_search(&object).is_err() {
                self.leave_unless_a_wanted_one_falls(object);
            }
        }
    }

    /// Drops a member, and then each member with an option that no longer holds one. If a wanted one would be dropped,
    /// all are restored.
    fn leave_unless_a_wanted_one_falls(&mut self, object: ObjectIndex) {
        let mut left = vec![object];
        self.member[object.get()] = false;
        let mut at = 0;
        while at < left.len() {
            let gone = left[at];
            at += 1;
            for &(rule, head) in &self.condition_of[gone.get()] {
                self.holders[rule as usize] -= 1;
                if self.holders[rule as usize] == 0 && core::mem::replace(&mut self.member[head.get()], false) {
                    left.push(head);
                }
            }
        }
        if self.wanted.iter().all(|object| self.member[object.get()]) {
            return;
        }
        for object in left {
            self.member[object.get()] = true;
            for &(rule, _) in &self.condition_of[object.get()] {
                self.holders[rule as usize] += 1;
            }
        }
    }

    fn members(&self) -> Vec<ObjectIndex> {
        self.base.objects().filter(|object| self.member[object.get()]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::derivable;
    use super::*;
    use proptest::prelude::*;

    fn base(options: Vec<Vec<Vec<usize>>>) -> KnowledgeBase {
        let set = |members: Vec<usize>| members.into_iter().map(ObjectIndex::new).collect();
        options.into_iter().map(|list| list.into_iter().map(set).collect()).collect()
    }

    fn is_lock(base: &KnowledgeBase, members: &[ObjectIndex]) -> bool {
        members.iter().all(|&member| base.options(member).all(|option| option.iter().any(|o| members.contains(o))))
    }

    fn check(base: &KnowledgeBase) -> Option<Locks> {
        let target = ObjectIndex::new(0);
        let derivable = derivable(base, |_| false, &Budget::unlimited()).expect("unlimited");
        if derivable.derives(target) {
            return None;
        }
        let lock = locks(base, &derivable, &[target], &Budget::unlimited()).expect("unlimited");
        assert!(lock.core.contains(&target) && is_lock(base, &lock.core));
        let with_stuck: Vec<_> = base.objects().filter(|object| !derivable.derives(*object)).collect();
        assert!(is_lock(base, &with_stuck) && lock.blocked.iter().all(|object| with_stuck.contains(object)));
        let n = lock.core.len();
        for subset in 0..(1_u32 << n) - 1 {
            let part: Vec<_> = (0..n).filter(|at| subset >> at & 1 == 1).map(|at| lock.core[at]).collect();
            assert!(!part.contains(&target) || !is_lock(base, &part), "{part:?} of {lock:?}");
        }
        Some(lock)
    }

    #[test]
    fn one_fixed_object_locks_alone() {
        let lock = check(&base(vec![vec![vec![1], vec![1, 2]], vec![], vec![vec![]]])).expect("a deadlock");
        assert_eq!(lock.core, [ObjectIndex::new(0), ObjectIndex::new(1)]);
        assert_eq!(lock.blocked, [ObjectIndex::new(0)]);
    }

    #[test]
    fn the_core_is_a_part_of_the_greatest_lock() {
        let lock = check(&base(vec![vec![vec![1, 3]], vec![vec![2]], vec![vec![1]], vec![vec![0]]]));
        assert_eq!(lock.map(|lock| (lock.core.len(), lock.blocked.len())), Some((3, 4)));
    }

    proptest! {
        #[test]
        fn a_core_is_a_lock_and_no_part_of_it_is(
            options in proptest::collection::vec(
                proptest::collection::vec(proptest::collection::vec(0_usize..9, 1..4), 0..4), 9),
        ) {
            check(&base(options));
        }
    }
}
