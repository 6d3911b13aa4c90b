//! Derivable objects: forward chaining over a knowledge base with a counter per rule (Dowling & Gallier 1984), linear
//! in the size of the base.

use super::base::KnowledgeBase;
use super::rows::Rows;
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

/// Chains forward: moves every graspable object that is not `held`. A held object can be derived too, but stays
/// where it is, so nothing follows from it.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub fn derivable(
    base: &KnowledgeBase,
    held: impl Fn(ObjectIndex) -> bool,
    budget: &Budget<'_>,
) -> Result<Derivable, Interrupted> {
    let mut chaining = Chaining::new(base, budget)?;
    let mut at = 0;
    while let Some(&object) = chaining.known.order.get(at) {
        at += 1;
        if at % 64 == 0 {
            budget.check()?;
        }
        if !held(object) {
            chaining.move_away(object);
        }
    }
    Ok(chaining.known)
}

/// Forward chaining in an order of the caller's choice.
pub struct Chaining {
    condition_of: Rows<(u32, ObjectIndex)>,
    /// Per rule the members of its body that still stand.
    missing: Vec<u32>,
    known: Derivable,
}

impl Chaining {
    /// Nothing is moved yet.
    ///
    /// # Errors
    /// [`Interrupted`] when the budget ends.
    pub fn new(base: &KnowledgeBase, budget: &Budget<'_>) -> Result<Self, Interrupted> {
        let condition_of = condition_of(base);
        budget.check()?;
        let mut missing: Vec<u32> = Vec::with_capacity(base.rules());
        let mut known = Derivable { order: Vec::new(), derived: vec![false; base.len()] };
        for object in base.objects() {
            for rule in base.rules_of(object) {
                missing.push(u32::try_from(base.body(rule).len()).unwrap_or(u32::MAX));
            }
            if base.free_now(object) {
                known.derive(object);
            }
        }
        budget.check()?;
        Ok(Self { condition_of, missing, known })
    }

    /// Moves an object, at most once, and derives what follows.
    pub fn move_away(&mut self, object: ObjectIndex) {
        for &(rule, head) in self.condition_of.get(object.get()) {
            self.missing[rule as usize] -= 1;
            if self.missing[rule as usize] == 0 {
                self.known.derive(head);
            }
        }
    }

    /// What is derived so far.
    pub fn known(&self) -> &Derivable {
        &self.known
    }
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
fn condition_of(base: &KnowledgeBase) -> Rows<(u32, ObjectIndex)> {
    let needs = base.objects().flat_map(|head| {
        base.rules_of(head).flat_map(move |rule| {
            #[expect(clippy::cast_possible_truncation, reason = "a base has fewer than 2^32 rules")]
            let entry = (rule as u32, head);
            base.body(rule).iter().map(move |member| (member.get() as u32, entry))
        })
    });
    Rows::from_pairs(base.len(), needs)
}
