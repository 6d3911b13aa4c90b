//! New landmarks from a chain that fails.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::chain::Chain;
use super::problem::{Node, Problem};
use crate::budget::{Budget, Interrupted};

/// Grow the allowed set of a chain that does not reach the target to a maximal one that still does not; return its
/// complement, a landmark that is inclusion-minimal and disjoint from what was allowed. The chain comes back as it was.
///
/// Only frontier nodes can be in the complement: permission for a node that can't be grasped changes nothing. Nodes far
/// from the target are let go first, so that the landmark lies near the target, where it is small.
pub(super) fn extract(problem: &Problem, chain: &mut Chain<'_>, budget: &Budget<'_>) -> Result<Vec<Node>, Interrupted> {
    let start = chain.mark();
    let mut landmark = Vec::new();
    let mut frontier: BinaryHeap<Reverse<Node>> =
        (0..problem.target()).filter(|&node| chain.is_frontier(node)).map(Reverse).collect();
    while let Some(Reverse(node)) = frontier.pop() {
        if budget.check().is_err() {
            chain.undo(start);
            return Err(Interrupted);
        }
        let mark = chain.mark();
        chain.allow(node);
        if chain.reaches_target() {
            chain.undo(mark);
            landmark.push(node);
        } else {
            frontier.extend(chain.graspable_since(mark).filter(|&node| chain.is_frontier(node)).map(Reverse));
        }
    }
    chain.undo(start);
    landmark.sort_unstable();
    Ok(landmark)
}
