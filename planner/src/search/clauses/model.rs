//! The question as clauses.

use batsat::Lit;

use super::founded::Founded;
use super::solver::Asker;
use crate::budget::Interrupted;
use crate::search::chain::Chain;
use crate::search::landmark;
use crate::search::pace::Pace;
use crate::search::problem::{Node, Problem};

/// Nodes times rules of a problem that is not too large to ask what each node needs; some tenths of a second.
const MAX_NEEDS: usize = 1 << 22;

/// What is known of the problem so far.
pub(in crate::search) struct Known<'p, 'k> {
    pub(in crate::search) problem: &'p Problem,
    /// What is in every set.
    pub(in crate::search) forced: &'k [Node],
    /// Those of them that need not be graspable.
    pub(in crate::search) excused: &'k [Node],
    pub(in crate::search) landmarks: &'k [Vec<Node>],
}

/// The clauses that hold for every least set, and per node the literal "it is moved".
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub(super) fn state<'p>(
    known: &Known<'p, '_>,
    asker: &mut Asker<'_>,
    pace: &mut Pace<'_>,
) -> Result<(Vec<Lit>, Founded<'p>), Interrupted> {
    let problem = known.problem;
    // Objects are likely to be moved: whoever is wrong there meets the counters at once, and learns from it.
    let nodes: Vec<Lit> = (0..=problem.target()).map(|_| asker.literal(true)).collect();
    let grasped = nodes[problem.target() as usize];
    asker.add([grasped])?;
    let rules = rules(problem, &nodes, asker)?;
    for node in (0..=problem.target()).filter(|node| !known.excused.contains(node)) {
        let options = problem.rules_of(node).iter().map(|&rule| rules[rule as usize]);
        asker.add(options.chain([!nodes[node as usize]]))?;
    }
    for &node in known.forced {
        asker.add([nodes[node as usize]])?;
    }
    for landmark in known.landmarks {
        asker.add(landmark.iter().map(|&node| nodes[node as usize]))?;
    }
    let asked = if nodes.len() * problem.rules() > MAX_NEEDS { 0 } else { problem.target() };
    for node in (0..asked).filter(|node| !known.excused.contains(node)) {
        state_needs(known, node, &nodes, asker, pace)?;
    }
    let founded = Founded::new(problem, nodes.clone(), rules, known.excused, asker.work());
    Ok((nodes, founded))
}

/// Per rule a literal that holds only if all of its body is moved.
fn rules(problem: &Problem, nodes: &[Lit], asker: &mut Asker<'_>) -> Result<Vec<Lit>, Interrupted> {
    let mut rules = Vec::with_capacity(problem.rules());
    for rule in 0..u32::try_from(problem.rules()).unwrap_or(u32::MAX) {
        let literal = match problem.body(rule) {
            // As true as that the target is grasped.
            [] => nodes[problem.target() as usize],
            [member] => nodes[*member as usize],
            body => {
                let literal = asker.literal(false);
                for &member in body {
                    asker.add([!literal, nodes[member as usize]])?;
                }
                literal
            }
        };
        rules.push(literal);
    }
    Ok(rules)
}

/// Landmarks of a node, disjoint: it is not moved, or one of each is.
fn state_needs(
    known: &Known<'_, '_>,
    node: Node,
    nodes: &[Lit],
    asker: &mut Asker<'_>,
    pace: &mut Pace<'_>,
) -> Result<(), Interrupted> {
    let mut chain = Chain::new(known.problem);
    known.forced.iter().filter(|&&forced| forced != node).for_each(|&forced| chain.allow(forced));
    pace.step(1 + chain.steps())?;
    while !chain.is_graspable(node) {
        let landmark = landmark::extract(known.problem, &mut chain, node, pace)?;
        landmark.iter().for_each(|&member| chain.allow(member));
        asker.add(landmark.iter().map(|&member| nodes[member as usize]).chain([!nodes[node as usize]]))?;
    }
    Ok(())
}
