//! What no derivation of an object can do without.

use super::bits::Bits;
use super::pace::Pace;
use super::problem::{Node, Problem};
use crate::budget::Interrupted;

/// The most bits that all sets may have together, 8 MB: of larger problems nothing is said.
const MAX_BITS: usize = 1 << 26;

/// Per node all that every derivation of it moves, itself included: the greatest solution of
/// needs(x) = {x} ∪ ⋂ over options of ⋃ over members of needs(m) (Zhu & Givan 2003; Keyder, Richter & Helmert 2010).
pub(super) struct Necessary {
    sets: Bits,
    /// Per rule what its members need together.
    bodies: Bits,
}

impl Necessary {
    /// What is necessary for all nodes in `order`, that of some derivation of them all; the target may be the last. `None` where
    /// there are too many.
    ///
    /// # Errors
    /// [`Interrupted`] when the budget ends.
    pub(super) fn of(problem: &Problem, order: &[Node], pace: &mut Pace<'_>) -> Result<Option<Self>, Interrupted> {
        let nodes = problem.movable() + 1;
        if nodes.saturating_mul(nodes + problem.rules()) > MAX_BITS {
            return Ok(None);
        }
        let mut known = Self { sets: Bits::full(nodes, nodes), bodies: Bits::new(problem.rules(), nodes) };
        let mut stale = vec![true; nodes];
        let (mut common, mut all) = (vec![0; nodes.div_ceil(64)], vec![0; nodes.div_ceil(64)]);
        while stale.contains(&true) {
            for &node in order {
                if !core::mem::replace(&mut stale[node as usize], false) {
                    continue;
                }
                pace.step(1 + problem.rules_of(node).len() * nodes / 2048)?;
                common.fill(u64::MAX);
                for &rule in problem.rules_of(node) {
                    all.fill(0);
                    problem.body(rule).iter().for_each(|&member| known.sets.unite(member as usize, &mut all));
                    known.bodies.replace(rule as usize, &all);
                    common.iter_mut().zip(&all).for_each(|(word, other)| *word &= other);
                }
                common[node as usize / 64] |= 1 << (node % 64);
                if known.sets.replace(node as usize, &common) {
                    problem.condition_of(node).iter().for_each(|&rule| stale[problem.head(rule) as usize] = true);
                }
            }
        }
        Ok(Some(known))
    }

    /// What every derivation of the node moves, the node itself included.
    pub(super) fn of_node(&self, node: Node) -> impl Iterator<Item = usize> + '_ {
        self.sets.ones(node as usize)
    }

    /// True if nobody needs the rule: when all that it asks for has been moved, another option of its head has been
    /// moved as well, or the head itself would have been. Of two that imply each other the first stays.
    pub(super) fn is_idle(&self, problem: &Problem, rule: u32) -> bool {
        let head = problem.head(rule);
        let implies = |rule: u32, other: u32| {
            problem.body(other).iter().all(|&member| self.bodies.has(rule as usize, member as usize))
        };
        self.bodies.has(rule as usize, head as usize)
            || problem
                .rules_of(head)
                .iter()
                .any(|&other| other != rule && implies(rule, other) && (other < rule || !implies(other, rule)))
    }
}
