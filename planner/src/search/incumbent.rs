//! Upper bounds: good derivations found without search.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::forward_chaining::ForwardChaining;
use super::problem::{HornRules, Node};
use crate::budget::{Interrupted, Ticker};

/// A derivation by h_add (Bonet & Geffner 2001): a node costs 1 plus the costs of all members of its cheapest body. The
/// costs come from Dijkstra's algorithm in Knuth's generalisation (1977), the derivation from the best supporters of
/// the target.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub(super) fn h_add(problem: &HornRules, ticker: &mut Ticker<'_>) -> Result<Vec<Node>, Interrupted> {
    let nodes = problem.movable() + 1;
    let mut support: Vec<Option<u32>> = vec![None; nodes];
    let mut settled = vec![false; nodes];
    let rules = u32::try_from(problem.rules()).unwrap_or(u32::MAX);
    let mut standing: Vec<usize> = (0..rules).map(|rule| problem.body(rule).len()).collect();
    let mut cost_of = vec![0_u64; problem.rules()];
    ticker.step(1 + problem.rules() / 64)?;
    let mut open: BinaryHeap<Reverse<(u64, Node, u32)>> = (0..rules)
        .filter(|&rule| problem.body(rule).is_empty())
        .map(|rule| Reverse((0, problem.head(rule), rule)))
        .collect();
    while let Some(Reverse((cost, node, rule))) = open.pop() {
        if core::mem::replace(&mut settled[node as usize], true) {
            continue;
        }
        ticker.step(1 + problem.condition_of(node).len() / 16)?;
        support[node as usize] = Some(rule);
        if node == problem.target() {
            break;
        }
        for &rule in problem.condition_of(node) {
            standing[rule as usize] -= 1;
            cost_of[rule as usize] = cost_of[rule as usize].saturating_add(cost).saturating_add(1);
            if standing[rule as usize] == 0 {
                open.push(Reverse((cost_of[rule as usize], problem.head(rule), rule)));
            }
        }
    }
    let mut chosen = vec![false; nodes];
    let mut open = vec![problem.target()];
    while let Some(node) = open.pop() {
        for &member in support[node as usize].iter().flat_map(|&rule| problem.body(rule)) {
            if !core::mem::replace(&mut chosen[member as usize], true) {
                open.push(member);
            }
        }
    }
    Ok((0..problem.target()).filter(|&node| chosen[node as usize]).collect())
}

/// Shrinks `set` to an inclusion-minimal subset from which the target still follows, given the nodes that the chain
/// allows already. Returns all moved nodes in order, or `None` if the target does not follow from `set`. Early members
/// are dropped first. The chain is restored. Where the budget ends, the subset may not be minimal.
pub(super) fn derivation(chain: &mut ForwardChaining<'_>, set: &[Node], ticker: &mut Ticker<'_>) -> Option<Vec<Node>> {
    let start = chain.mark();
    set.iter().for_each(|&node| chain.allow(node));
    let follows = chain.reaches_target();
    // Members that can't be moved are useless.
    let movable: Vec<Node> = set.iter().copied().filter(|&node| chain.is_graspable(node)).collect();
    chain.undo(start);
    if !follows {
        return None;
    }
    let mut kept = Vec::new();
    keep(chain, &movable, &mut kept, ticker);
    kept.iter().for_each(|&node| chain.allow(node));
    let moved = chain.moved().collect();
    chain.undo(start);
    Some(moved)
}

/// Adds to `kept` the members of `set` that are needed besides the allowed nodes. Divides and conquers, as QuickXplain
/// (Junker 2004) does, so that many members are dropped at once.
fn keep(chain: &mut ForwardChaining<'_>, set: &[Node], kept: &mut Vec<Node>, ticker: &mut Ticker<'_>) {
    if chain.reaches_target() {
        return;
    }
    if set.len() <= 1 || ticker.step(1 + set.len() / 16 + chain.steps()).is_err() {
        kept.extend(set);
        return;
    }
    let (early, late) = set.split_at(set.len() / 2);
    let (mark, known) = (chain.mark(), kept.len());
    late.iter().for_each(|&node| chain.allow(node));
    keep(chain, early, kept, ticker);
    chain.undo(mark);
    kept[known..].iter().for_each(|&node| chain.allow(node));
    keep(chain, late, kept, ticker);
    chain.undo(mark);
}
