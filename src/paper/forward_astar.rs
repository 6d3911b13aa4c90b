//! The baseline of section V: A* forward from the objects that are graspable now.
//!
//! A state is the set of objects relocated so far; its successors relocate one more that is graspable by then; h = G_min
//! counts the obstacles at the target's best yaw that still stand, which never overestimates. The paper's nodes hold one
//! object each and it doesn't say whether it knows a set again that was reached in another order; A* as its source [13]
//! has it does, and so does this: without that, the order of n independent moves alone would cost n! nodes.

use std::cmp::Reverse;
use std::collections::hash_map::DefaultHasher;
use std::collections::{BinaryHeap, HashSet};
use std::hash::BuildHasherDefault;

use super::conclusion::Conclusion;
use crate::budget::{Budget, Interrupted};
use crate::knowledge::KnowledgeBase;
use crate::scene::ObjectIndex;
use crate::search::Derivation;

/// A set of objects, one bit each.
type Relocated = Box<[u64]>;

/// How a state was reached: the last object relocated, and the state before.
#[derive(Debug, Clone, Copy)]
struct Step {
    object: ObjectIndex,
    before: usize,
}

struct Forward<'a> {
    base: &'a KnowledgeBase,
    target: ObjectIndex,
    steps: Vec<Step>,
    /// Cheapest f first, of those the one nearest to the goal, of those the oldest: (f, h, state).
    open: BinaryHeap<Reverse<(usize, usize, usize)>>,
    reached: HashSet<Relocated, BuildHasherDefault<DefaultHasher>>,
}

/// The state in which everything stands.
const START: usize = 0;

/// A* for `target` over a base of all objects, for every graspable object is a successor. Gives up after `max_states`.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub fn forward_astar(
    base: &KnowledgeBase,
    target: ObjectIndex,
    max_states: usize,
    budget: &Budget<'_>,
) -> Result<Conclusion, Interrupted> {
    let nothing: Relocated = vec![0; base.len().div_ceil(64)].into();
    let Some(h) = g_min(base, target, &nothing) else { return Ok(Conclusion::Deadlock) };
    let start = Step { object: target, before: START };
    let mut forward = Forward {
        base,
        target,
        steps: vec![start],
        open: BinaryHeap::from([Reverse((h, h, START))]),
        reached: HashSet::from_iter([nothing]),
    };
    while let Some(Reverse((f, h, state))) = forward.open.pop() {
        budget.check()?;
        if h == 0 {
            return Ok(Conclusion::Sequence(Derivation { order: forward.sequence(state) }));
        }
        forward.expand(state, f - h);
        if forward.steps.len() > max_states {
            return Ok(Conclusion::TooLarge);
        }
    }
    Ok(Conclusion::Deadlock)
}

impl Forward<'_> {
    /// Relocate one more object.
    fn expand(&mut self, state: usize, g: usize) {
        let mut relocated: Relocated = vec![0; self.base.len().div_ceil(64)].into();
        self.sequence(state).into_iter().for_each(|object| set(&mut relocated, object, true));
        for object in self.base.objects() {
            let graspable = |object| self.base.options(object).any(|option| standing(option, &relocated) == 0);
            if object == self.target || contains(&relocated, object) || !graspable(object) {
                continue;
            }
            set(&mut relocated, object, true);
            if !self.reached.contains(&relocated)
                && let Some(h) = g_min(self.base, self.target, &relocated)
            {
                self.reached.insert(relocated.clone());
                self.open.push(Reverse((g + 1 + h, h, self.steps.len())));
                self.steps.push(Step { object, before: state });
            }
            set(&mut relocated, object, false);
        }
    }

    /// What was relocated, in order.
    fn sequence(&self, mut state: usize) -> Vec<ObjectIndex> {
        let mut order = Vec::new();
        while state != START {
            order.push(self.steps[state].object);
            state = self.steps[state].before;
        }
        order.reverse();
        order
    }
}

/// G_min: the fewest obstacles that still block the target at any yaw. `None` if it has no option at all.
fn g_min(base: &KnowledgeBase, target: ObjectIndex, relocated: &[u64]) -> Option<usize> {
    base.options(target).map(|option| standing(option, relocated)).min()
}

fn standing(option: &[ObjectIndex], relocated: &[u64]) -> usize {
    option.iter().filter(|member| !contains(relocated, **member)).count()
}

fn contains(relocated: &[u64], object: ObjectIndex) -> bool {
    relocated[object.get() / 64] >> (object.get() % 64) & 1 == 1
}

fn set(relocated: &mut [u64], object: ObjectIndex, on: bool) {
    let bit = 1 << (object.get() % 64);
    if on {
        relocated[object.get() / 64] |= bit;
    } else {
        relocated[object.get() / 64] &= !bit;
    }
}
