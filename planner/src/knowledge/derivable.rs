//! Derivable objects: forward chaining over a knowledge base with a counter per rule (Dowling & Gallier 1984), linear
//! in the size of the base.

use super::base::KnowledgeBase;
use crate::budget::{Budget, Interrupted};
use crate::scene::ObjectIndex;

/// The objects that can be grasped, in an order in which they can.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Derivable {
    /// The derived objects, each after all of one of its options.
    pub order: Vec<ObjectIndex>,
    /// Per object whether it is derived.
    pub derived: Vec<bool>,
}

/// Chains forward: relocates every graspable object that is not `held`. A held object can be derived too, but stays
/// where it is, so nothing follows from it.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub fn derivable(
    base: &KnowledgeBase,
    held: impl Fn(ObjectIndex) -> bool,
    budget: &Budget<'_>,
) -> Result<Derivable, Interrupted> {
    let condition_of = ConditionOf::new(base);
    budget.check()?;
    let mut missing: Vec<u32> = Vec::with_capacity(base.rules());
    let mut derivable = Derivable { order: Vec::new(), derived: vec![false; base.len()] };
    for object in base.objects() {
        for rule in base.rules_of(object) {
            missing.push(u32::try_from(base.body(rule).len()).unwrap_or(u32::MAX));
        }
        if base.free_now(object) {
            derivable.derive(object);
        }
    }
    budget.check()?;
    let mut at = 0;
    while let Some(&object) = derivable.order.get(at) {
        at += 1;
        if at % 64 == 0 {
            budget.check()?;
        }
        if held(object) {
            continue;
        }
        for &(rule, head) in condition_of.rules(object) {
            missing[rule as usize] -= 1;
            if missing[rule as usize] == 0 {
                derivable.derive(head);
            }
        }
    }
    Ok(derivable)
}

impl Derivable {
    fn derive(&mut self, object: ObjectIndex) {
        if !core::mem::replace(&mut self.derived[object.get()], true) {
            self.order.push(object);
        }
    }

    /// True if the object is derived.
    pub fn derives(&self, object: ObjectIndex) -> bool {
        self.derived[object.get()]
    }
}

/// Per object the rules that need it, with their heads.
pub(super) struct ConditionOf {
    first: Vec<u32>,
    rules: Vec<(u32, ObjectIndex)>,
}

impl ConditionOf {
    pub(super) fn new(base: &KnowledgeBase) -> Self {
        let mut first = vec![0_u32; base.len() + 1];
        for rule in 0..base.rules() {
            base.body(rule).iter().for_each(|member| first[member.get() + 1] += 1);
        }
        for at in 1..first.len() {
            first[at] += first[at - 1];
        }
        let mut next = first.clone();
        let mut rules = vec![(0, ObjectIndex::new(0)); base.size()];
        for head in base.objects() {
            for rule in base.rules_of(head) {
                for member in base.body(rule) {
                    let slot = &mut next[member.get()];
                    #[expect(clippy::cast_possible_truncation, reason = "a base has fewer than 2^32 rules")]
                    let entry = (rule as u32, head);
                    rules[*slot as usize] = entry;
                    *slot += 1;
                }
            }
        }
        Self { first, rules }
    }

    pub(super) fn rules(&self, object: ObjectIndex) -> &[(u32, ObjectIndex)] {
        &self.rules[self.first[object.get()] as usize..self.first[object.get() + 1] as usize]
    }
}
