//! New landmarks from a chain that fails, and those that need none.

use super::chain::Chain;
use super::pace::Pace;
use super::problem::{Node, Problem};
use crate::budget::Interrupted;

/// Grow the allowed set of a chain that does not reach the goal to a maximal one that still does not; return its
/// complement, a landmark of the goal that is inclusion-minimal and disjoint from what was allowed. The chain comes back as
/// it was.
///
/// Only frontier nodes can be in the complement: permission for a node that can't be grasped changes nothing. Nodes far
/// from the target are let go first, so that its landmarks lie near it, where they are small.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub(super) fn extract(
    problem: &Problem,
    chain: &mut Chain<'_>,
    goal: Node,
    pace: &mut Pace<'_>,
) -> Result<Vec<Node>, Interrupted> {
    pace.step(1 + problem.movable() / NODES_A_STEP + chain.steps())?;
    let start = chain.mark();
    let mut landmark = Vec::new();
    let mut frontier = Queue::new(problem.movable());
    (0..problem.target()).filter(|&node| chain.is_frontier(node)).for_each(|node| frontier.push(node));
    while let Some(node) = frontier.pop() {
        if pace.step(1 + chain.steps()).is_err() {
            chain.undo(start);
            return Err(Interrupted);
        }
        let mark = chain.mark();
        chain.allow(node);
        if chain.is_graspable(goal) {
            chain.undo(mark);
            landmark.push(node);
        } else {
            // Nothing follows from the target.
            let new = chain.graspable_since(mark).filter(|&node| node != problem.target() && chain.is_frontier(node));
            new.for_each(|node| frontier.push(node));
        }
    }
    chain.undo(start);
    landmark.sort_unstable();
    Ok(landmark)
}

/// Where every option of an object has one member that is not `forced`, these are a landmark for whoever has to grasp it.
pub(super) fn one_of_each(problem: &Problem, object: Node, forced: impl Fn(Node) -> bool) -> Option<Vec<Node>> {
    let mut landmark = Vec::new();
    for &rule in problem.rules_of(object) {
        let mut open = problem.body(rule).iter().filter(|&&node| !forced(node));
        landmark.push(*open.next()?);
        if open.next().is_some() {
            return None;
        }
    }
    landmark.sort_unstable();
    landmark.dedup();
    (landmark.len() > 1).then_some(landmark)
}

/// How many nodes are looked at in the time of one step.
const NODES_A_STEP: usize = 256;

/// Nodes that wait, the least first.
struct Queue {
    waiting: Vec<u64>,
    /// Nothing waits in the words before.
    first: usize,
}

impl Queue {
    fn new(nodes: usize) -> Self {
        Self { waiting: vec![0; nodes.div_ceil(64)], first: 0 }
    }

    fn push(&mut self, node: Node) {
        let word = node as usize / 64;
        self.waiting[word] |= 1 << (node % 64);
        self.first = self.first.min(word);
    }

    fn pop(&mut self) -> Option<Node> {
        while *self.waiting.get(self.first)? == 0 {
            self.first += 1;
        }
        let word = &mut self.waiting[self.first];
        let bit = word.trailing_zeros();
        *word &= *word - 1;
        #[expect(clippy::cast_possible_truncation, reason = "counts nodes")]
        let base = (self.first * 64) as Node;
        Some(base + bit)
    }
}
