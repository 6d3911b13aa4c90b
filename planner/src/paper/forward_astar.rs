//! The baseline of section V: A* forward from the objects that are graspable now.
//!
//! A state is the set of objects relocated so far; its successors relocate one more that is graspable by then; h =
//! G_min counts the obstacles at the target's best yaw that still stand, which never overestimates. The paper's nodes
//! hold one object each, and it doesn't say whether a set is recognised that was reached in another order. A* in its
//! source [13] recognises it, and so does this: otherwise the order of n independent moves alone would cost n! nodes.

use std::cmp::Reverse;
use std::collections::hash_map::DefaultHasher;
use std::collections::{BinaryHeap, HashMap};
use std::hash::{BuildHasherDefault, Hash, Hasher};

use super::conclusion::Conclusion;
use crate::budget::{Budget, Interrupted};
use crate::knowledge::KnowledgeBase;
use crate::scene::ObjectIndex;
use crate::search::Derivation;

/// The step that led to a state: the last object relocated, and the state before.
#[derive(Debug, Clone, Copy)]
struct Step {
    object: ObjectIndex,
    before: usize,
}

struct Forward<'a> {
    base: &'a KnowledgeBase,
    target: ObjectIndex,
    steps: Vec<Step>,
    /// (f, h, state): least f first, then least h, then the oldest.
    open: BinaryHeap<Reverse<(usize, usize, usize)>>,
    reached: Reached,
}

/// The sets reached, by the number of the state; one bit an object. All lie in a few large pieces of memory: to free
/// half a million small ones would take ten milliseconds after the answer.
struct Reached {
    /// Words of a set.
    width: usize,
    words: Vec<u64>,
    /// Per hash of a set the latest state with that hash.
    latest: HashMap<u64, usize, BuildHasherDefault<DefaultHasher>>,
    /// Per state the previous one with the same hash; itself if there is none.
    before: Vec<usize>,
}

impl Reached {
    fn new(objects: usize) -> Self {
        Self { width: objects.div_ceil(64).max(1), words: Vec::new(), latest: HashMap::default(), before: Vec::new() }
    }

    fn set(&self, state: usize) -> &[u64] {
        &self.words[state * self.width..][..self.width]
    }

    /// Adds the set of the next state. False if it was reached before.
    fn insert(&mut self, set: &[u64]) -> bool {
        let (digest, state) = (digest(set), self.before.len());
        let latest = self.latest.get(&digest).copied();
        let mut next = latest;
        while let Some(other) = next {
            if self.set(other) == set {
                return false;
            }
            next = Some(self.before[other]).filter(|before| *before != other);
        }
        self.words.extend_from_slice(set);
        self.before.push(latest.unwrap_or(state));
        self.latest.insert(digest, state);
        true
    }
}

fn digest(set: &[u64]) -> u64 {
    let mut hasher = DefaultHasher::default();
    set.hash(&mut hasher);
    hasher.finish()
}

/// The state in which everything stands.
const START: usize = 0;

/// A* for `target`. The base must hold the rules of all objects, since every graspable object is a successor. Gives up
/// after `max_states`.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub fn forward_astar(
    base: &KnowledgeBase,
    target: ObjectIndex,
    max_states: usize,
    budget: &Budget<'_>,
) -> Result<Conclusion, Interrupted> {
    if base.options(target).next().is_none() {
        return Ok(Conclusion::Deadlock);
    }
    let mut reached = Reached::new(base.len());
    reached.insert(&vec![0; reached.width]);
    let h = g_min(base, target, reached.set(START));
    let start = Step { object: target, before: START };
    let mut forward =
        Forward { base, target, steps: vec![start], open: BinaryHeap::from([Reverse((h, h, START))]), reached };
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
    /// Adds the successors of a state.
    fn expand(&mut self, state: usize, g: usize) {
        let mut relocated = self.reached.set(state).to_vec();
        for object in self.base.objects() {
            let graspable = |object| self.base.options(object).any(|option| standing(option, &relocated) == 0);
            if object == self.target || contains(&relocated, object) || !graspable(object) {
                continue;
            }
            set(&mut relocated, object, true);
            if self.reached.insert(&relocated) {
                let h = g_min(self.base, self.target, &relocated);
                self.open.push(Reverse((g + 1 + h, h, self.steps.len())));
                self.steps.push(Step { object, before: state });
            }
            set(&mut relocated, object, false);
        }
    }

    /// The objects relocated to reach a state, in order.
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

/// G_min: the fewest obstacles that still block the target, which has an option, at any yaw.
fn g_min(base: &KnowledgeBase, target: ObjectIndex, relocated: &[u64]) -> usize {
    base.options(target).map(|option| standing(option, relocated)).min().unwrap_or(0)
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
