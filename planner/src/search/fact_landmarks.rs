//! Fact landmarks: for each node, the nodes that every derivation of it moves (Zhu & Givan 2003; Keyder, Richter &
//! Helmert 2010).

use super::bits::Bits;
use super::problem::{HornRules, Node};
use crate::budget::{Interrupted, Ticker};

/// The most bits of all sets together, 8 MB. Larger problems get no fact landmarks.
const MAX_BITS: usize = 1 << 26;

/// Per node its fact landmarks, itself included: the greatest fixpoint of
/// landmarks(x) = {x} ∪ ⋂ over rules of ⋃ over body members of landmarks(m).
pub(super) struct FactLandmarks {
    sets: Bits,
    /// Per rule the fact landmarks of its whole body.
    bodies: Bits,
}

impl FactLandmarks {
    /// The fact landmarks of all nodes in `order`, which is a derivation of them all; the target may come last. `None`
    /// if the problem is too large.
    ///
    /// # Errors
    /// [`Interrupted`] when the budget ends.
    pub(super) fn of(
        problem: &HornRules,
        order: &[Node],
        ticker: &mut Ticker<'_>,
    ) -> Result<Option<Self>, Interrupted> {
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
                ticker.step(1 + problem.rules_of(node).len() * nodes / 2048)?;
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

    /// The fact landmarks of a node, itself included.
    pub(super) fn of_node(&self, node: Node) -> impl Iterator<Item = usize> + '_ {
        self.sets.ones(node as usize)
    }

    /// True if the rule is dominated: moving its body takes moving the body of another rule of the same head, or the
    /// head itself. Of two rules that dominate each other the first stays.
    pub(super) fn is_dominated(&self, problem: &HornRules, rule: u32) -> bool {
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
