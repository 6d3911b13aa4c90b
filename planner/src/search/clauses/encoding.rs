//! The problem as hard clauses: Clark's completion of the rules, strengthened by landmarks.

use batsat::Lit;

use super::solver::Solver;
use super::unfounded_sets::UnfoundedSets;
use crate::budget::{Interrupted, Ticker};
use crate::search::forward_chaining::ForwardChaining;
use crate::search::landmark;
use crate::search::problem::{HornRules, Node};

/// The most nodes times rules of a problem for which the landmarks of every node are extracted, which takes some tenths
/// of a second.
const MAX_NODES_TIMES_RULES: usize = 1 << 22;

/// The problem, and the facts about its solutions that are known so far.
pub(in crate::search) struct Facts<'p, 'k> {
    pub(in crate::search) problem: &'p HornRules,
    /// The nodes that are in every set.
    pub(in crate::search) forced: &'k [Node],
    /// Forced nodes that a restriction requires: counted even if no rule derives them.
    pub(in crate::search) underived_required: &'k [Node],
    pub(in crate::search) landmarks: &'k [Vec<Node>],
}

/// Adds the clauses that hold for every least set. Returns per node the literal "it is moved", and the theory that cuts
/// off unfounded sets.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub(super) fn encode<'p>(
    facts: &Facts<'p, '_>,
    solver: &mut Solver<'_>,
    ticker: &mut Ticker<'_>,
) -> Result<(Vec<Lit>, UnfoundedSets<'p>), Interrupted> {
    let problem = facts.problem;
    // The first phase is "moved": a wrong guess then conflicts with a totalizer at once, and a clause is learnt.
    let nodes: Vec<Lit> = (0..=problem.target()).map(|_| solver.literal(true)).collect();
    let grasped = nodes[problem.target() as usize];
    solver.add([grasped])?;
    let rules = rules(problem, &nodes, solver)?;
    for node in (0..=problem.target()).filter(|node| !facts.underived_required.contains(node)) {
        let options = problem.rules_of(node).iter().map(|&rule| rules[rule as usize]);
        solver.add(options.chain([!nodes[node as usize]]))?;
    }
    for &node in facts.forced {
        solver.add([nodes[node as usize]])?;
    }
    for landmark in facts.landmarks {
        solver.add(landmark.iter().map(|&node| nodes[node as usize]))?;
    }
    let asked = if nodes.len() * problem.rules() > MAX_NODES_TIMES_RULES { 0 } else { problem.target() };
    for node in (0..asked).filter(|node| !facts.underived_required.contains(node)) {
        encode_landmarks(facts, node, &nodes, solver, ticker)?;
    }
    let unfounded_sets = UnfoundedSets::new(problem, nodes.clone(), rules, facts.underived_required, solver.work());
    Ok((nodes, unfounded_sets))
}

/// Per rule a literal that implies that its whole body is moved.
fn rules(problem: &HornRules, nodes: &[Lit], solver: &mut Solver<'_>) -> Result<Vec<Lit>, Interrupted> {
    let mut rules = Vec::with_capacity(problem.rules());
    for rule in 0..u32::try_from(problem.rules()).unwrap_or(u32::MAX) {
        let literal = match problem.body(rule) {
            // An empty body always holds, and so does the literal of the target.
            [] => nodes[problem.target() as usize],
            [member] => nodes[*member as usize],
            body => {
                let literal = solver.literal(false);
                for &member in body {
                    solver.add([!literal, nodes[member as usize]])?;
                }
                literal
            }
        };
        rules.push(literal);
    }
    Ok(rules)
}

/// Adds disjoint landmarks of a node: the node is not moved, or one member of each is.
fn encode_landmarks(
    facts: &Facts<'_, '_>,
    node: Node,
    nodes: &[Lit],
    solver: &mut Solver<'_>,
    ticker: &mut Ticker<'_>,
) -> Result<(), Interrupted> {
    let mut chain = ForwardChaining::new(facts.problem);
    facts.forced.iter().filter(|&&forced| forced != node).for_each(|&forced| chain.allow(forced));
    ticker.step(1 + chain.steps())?;
    while !chain.is_graspable(node) {
        let landmark = landmark::extract(facts.problem, &mut chain, node, ticker)?;
        landmark.iter().for_each(|&member| chain.allow(member));
        solver.add(landmark.iter().map(|&member| nodes[member as usize]).chain([!nodes[node as usize]]))?;
    }
    Ok(())
}
