//! New landmarks: from a chaining that fails, and from the rules alone.

use super::forward_chaining::ForwardChaining;
use super::problem::{HornRules, Node};
use crate::budget::{Interrupted, Ticker};

/// Grows the allowed set of a chain that does not reach the goal to a maximal one that still does not. Returns the
/// complement: an inclusion-minimal landmark of the goal, disjoint from the nodes allowed before. The chain is
/// restored.
///
/// Only frontier nodes can be in the complement, since allowing a node that can't be grasped changes nothing. Nodes far
/// from the target are allowed first, so that landmarks lie near the target, where they are small.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub(super) fn extract(
    problem: &HornRules,
    chain: &mut ForwardChaining<'_>,
    goal: Node,
    ticker: &mut Ticker<'_>,
) -> Result<Vec<Node>, Interrupted> {
    ticker.step(1 + problem.movable() / NODES_A_STEP + chain.steps())?;
    let start = chain.mark();
    let mut landmark = Vec::new();
    let mut frontier = Frontier::new(problem.movable());
    (0..problem.target()).filter(|&node| chain.is_frontier(node)).for_each(|node| frontier.push(node));
    while let Some(node) = frontier.pop() {
        if ticker.step(1 + chain.steps()).is_err() {
            chain.undo(start);
            return Err(Interrupted);
        }
        let mark = chain.mark();
        chain.allow(node);
        if chain.is_graspable(goal) {
            chain.undo(mark);
            landmark.push(node);
        } else {
            // The target is in no body.
            let new = chain.graspable_since(mark).filter(|&node| node != problem.target() && chain.is_frontier(node));
            new.for_each(|node| frontier.push(node));
        }
    }
    chain.undo(start);
    landmark.sort_unstable();
    Ok(landmark)
}

/// The landmark of an object whose bodies each have exactly one member that is not `forced`: these members. `None` if
/// some body has none or several, or if all bodies have the same one.
pub(super) fn one_of_each(problem: &HornRules, object: Node, forced: impl Fn(Node) -> bool) -> Option<Vec<Node>> {
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

/// Nodes read per step of the ticker.
const NODES_A_STEP: usize = 256;

/// A priority queue of nodes, least first, as a bit set.
struct Frontier {
    waiting: Vec<u64>,
    /// All words before this one are empty.
    first: usize,
}

impl Frontier {
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
