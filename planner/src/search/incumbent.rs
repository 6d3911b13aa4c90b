//! Good derivations, found without search.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::chain::Chain;
use super::pace::Pace;
use super::problem::{Node, Problem};
use crate::budget::Interrupted;

/// A derivation by the additive estimate: an object costs one more than the members of its cheapest option together.
/// Dijkstra's algorithm in Knuth's generalisation, then the support of the target.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub(super) fn greedy(problem: &Problem, pace: &mut Pace<'_>) -> Result<Vec<Node>, Interrupted> {
    let nodes = problem.movable() + 1;
    let mut support: Vec<Option<u32>> = vec![None; nodes];
    let mut settled = vec![false; nodes];
    let rules = u32::try_from(problem.rules()).unwrap_or(u32::MAX);
    let mut standing: Vec<usize> = (0..rules).map(|rule| problem.body(rule).len()).collect();
    let mut price = vec![0_u64; problem.rules()];
    pace.step(1 + problem.rules() / 64)?;
    let mut open: BinaryHeap<Reverse<(u64, Node, u32)>> = (0..rules)
        .filter(|&rule| problem.body(rule).is_empty())
        .map(|rule| Reverse((0, problem.head(rule), rule)))
        .collect();
    while let Some(Reverse((cost, node, rule))) = open.pop() {
        if core::mem::replace(&mut settled[node as usize], true) {
            continue;
        }
        pace.step(1 + problem.condition_of(node).len() / 16)?;
        support[node as usize] = Some(rule);
        if node == problem.target() {
            break;
        }
        for &rule in problem.condition_of(node) {
            standing[rule as usize] -= 1;
            price[rule as usize] = price[rule as usize].saturating_add(cost).saturating_add(1);
            if standing[rule as usize] == 0 {
                open.push(Reverse((price[rule as usize], problem.head(rule), rule)));
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

/// An inclusion-minimal part of `set` from which the target follows, together with what the chain allows already, in an
/// order in which its members can be moved; `None` if the target does not follow from `set`. What comes early in `set` is
/// left out first. The chain comes back as it was. Where the budget ends, the part reached so far.
pub(super) fn derivation(chain: &mut Chain<'_>, set: &[Node], pace: &mut Pace<'_>) -> Option<Vec<Node>> {
    let start = chain.mark();
    set.iter().for_each(|&node| chain.allow(node));
    let follows = chain.reaches_target();
    // What can't be moved is of no use.
    let movable: Vec<Node> = set.iter().copied().filter(|&node| chain.is_graspable(node)).collect();
    chain.undo(start);
    if !follows {
        return None;
    }
    let mut kept = Vec::new();
    keep(chain, &movable, &mut kept, pace);
    kept.iter().for_each(|&node| chain.allow(node));
    let moved = chain.moved().collect();
    chain.undo(start);
    Some(moved)
}

/// Which of `set` are needed besides what the chain allows, by halves: much of it is left out at one stroke.
fn keep(chain: &mut Chain<'_>, set: &[Node], kept: &mut Vec<Node>, pace: &mut Pace<'_>) {
    if chain.reaches_target() {
        return;
    }
    if set.len() <= 1 || pace.step(1 + set.len() / 16 + chain.steps()).is_err() {
        kept.extend(set);
        return;
    }
    let (early, late) = set.split_at(set.len() / 2);
    let (mark, known) = (chain.mark(), kept.len());
    late.iter().for_each(|&node| chain.allow(node));
    keep(chain, early, kept, pace);
    chain.undo(mark);
    kept[known..].iter().for_each(|&node| chain.allow(node));
    keep(chain, late, kept, pace);
    chain.undo(mark);
}
