//! Good derivations, found without search.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::chain::Chain;
use super::problem::{Node, Problem};
use crate::budget::{Budget, Interrupted};

/// A derivation by the additive estimate: an object costs one more than the members of its cheapest option together.
/// Dijkstra's algorithm in Knuth's generalisation, then the support of the target.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub(super) fn greedy(problem: &Problem, budget: &Budget<'_>) -> Result<Vec<Node>, Interrupted> {
    let nodes = problem.movable() + 1;
    let mut support: Vec<Option<u32>> = vec![None; nodes];
    let mut settled = vec![false; nodes];
    let rules = u32::try_from(problem.rules()).unwrap_or(u32::MAX);
    let mut standing: Vec<usize> = (0..rules).map(|rule| problem.body(rule).len()).collect();
    let mut price = vec![0_u64; problem.rules()];
    let mut open: BinaryHeap<Reverse<(u64, Node, u32)>> = (0..rules)
        .filter(|&rule| problem.body(rule).is_empty())
        .map(|rule| Reverse((0, problem.head(rule), rule)))
        .collect();
    while let Some(Reverse((cost, node, rule))) = open.pop() {
        if core::mem::replace(&mut settled[node as usize], true) {
            continue;
        }
        budget.check()?;
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

/// An inclusion-minimal part of `set` that still derives the target, in an order in which its members can be moved;
/// `None` if `set` does not derive it. Nodes far from the target are left out first. Where the budget ends, the part
/// reached so far.
pub(super) fn derivation(problem: &Problem, set: &[Node], budget: &Budget<'_>) -> Option<Vec<Node>> {
    let run = |set: &[Node], without: Option<Node>| {
        let mut chain = Chain::new(problem);
        set.iter().filter(|&&node| Some(node) != without).for_each(|&node| chain.allow(node));
        chain.reaches_target().then(|| chain.moved().collect::<Vec<_>>())
    };
    let mut moved = run(set, None)?;
    let mut by_distance = moved.clone();
    by_distance.sort_unstable();
    for node in by_distance {
        if budget.check().is_err() {
            break;
        }
        if moved.contains(&node)
            && let Some(fewer) = run(&moved, Some(node))
        {
            moved = fewer;
        }
    }
    Some(moved)
}
