//! Core-guided MaxSAT (OLL, Andres et al. 2012): assume every soft literal; relax each unsatisfiable core with a
//! totalizer.

use batsat::Lit;

use super::encoding::{Facts, encode};
use super::solver::{Reply, Solver};
use super::totalizer::Totalizer;
use super::unfounded_sets::UnfoundedSets;
use crate::budget::{Interrupted, Ticker};
use crate::search::problem::Node;

/// The most rounds in which a core is trimmed by solving it again.
const TRIMMING_ROUNDS: usize = 5;
/// The most conflicts for the attempt to drop one literal from a core.
const CONFLICTS_TO_MINIMISE: u64 = 1000;
/// The most conflicts for one trimming round, and for the attempt to show that one more literal of a core fails.
const CONFLICTS_TO_TRIM: u64 = 2000;

/// An assumption that costs 1 where it fails: an object is not moved, or at most so many literals of a core fail.
struct SoftLiteral {
    literal: Lit,
    /// For a core: the position of its totalizer, and how many literals may fail.
    counted: Option<(usize, usize)>,
}

/// The search by core-guided MaxSAT. Each call of [`MaxSat::raise`] goes on where the last one stopped.
pub(in crate::search) struct MaxSat<'p, 'b> {
    solver: Solver<'b>,
    unfounded_sets: UnfoundedSets<'p>,
    /// Per node the literal "it is moved".
    nodes: Vec<Lit>,
    soft: Vec<SoftLiteral>,
    totalizers: Vec<Totalizer>,
    bound: usize,
}

/// Takes a set from which the target follows and returns the size of the best known one.
pub(in crate::search) type Adopt<'f> = &'f mut dyn FnMut(&[Node]) -> usize;

impl<'p, 'b> MaxSat<'p, 'b> {
    /// Encodes the problem, with one soft literal for each node that is not forced. All clauses together hold at most
    /// `max_literals`.
    ///
    /// # Errors
    /// [`Interrupted`] when the budget ends.
    pub(in crate::search) fn new(
        facts: &Facts<'p, '_>,
        max_literals: usize,
        ticker: &mut Ticker<'b>,
    ) -> Result<Self, Interrupted> {
        let mut solver = Solver::new(max_literals, ticker.another());
        let (nodes, unfounded_sets) = encode(facts, &mut solver, ticker)?;
        let mut is_forced = vec![false; nodes.len()];
        facts.forced.iter().for_each(|&node| is_forced[node as usize] = true);
        let soft = (0..facts.problem.target())
            .filter(|&node| !is_forced[node as usize])
            .map(|node| SoftLiteral { literal: !nodes[node as usize], counted: None })
            .collect();
        Ok(Self { solver, unfounded_sets, nodes, soft, totalizers: Vec::new(), bound: facts.forced.len() })
    }

    /// The lower bound: no set is smaller.
    pub(in crate::search) fn bound(&self) -> usize {
        self.bound
    }

    /// Raises the bound until it meets the best set, or until `conflicts` are spent.
    ///
    /// # Errors
    /// [`Interrupted`] when the budget ends.
    pub(in crate::search) fn raise(
        &mut self,
        conflicts: u64,
        best: usize,
        adopt: Adopt<'_>,
    ) -> Result<(), Interrupted> {
        let last = self.solver.conflicts().saturating_add(conflicts);
        let mut best = best;
        while self.bound < best {
            let assumptions: Vec<Lit> = self.soft.iter().map(|soft| soft.literal).collect();
            let left = last.saturating_sub(self.solver.conflicts());
            match self.solver.solve(&mut self.unfounded_sets, &assumptions, left) {
                Reply::Sat => {
                    adopt(&self.model());
                    return Ok(());
                }
                Reply::Unknown => return self.solver.check(),
                // The hard clauses alone are satisfiable.
                Reply::Unsat(core) if core.is_empty() => return Ok(()),
                Reply::Unsat(core) => {
                    let core = self.smaller(core, &mut best, adopt);
                    self.relax(&core, &mut best, adopt)?;
                }
            }
        }
        Ok(())
    }

    /// The moved nodes of the last model.
    fn model(&self) -> Vec<Node> {
        let nodes = self.nodes.iter().zip(0..).take(self.nodes.len() - 1);
        nodes.filter(|(literal, _)| self.solver.is_true(**literal)).map(|(_, node)| node).collect()
    }

    /// A smaller core within this one: first by trimming, then by dropping one literal after the other. It need not be
    /// minimal.
    fn smaller(&mut self, mut core: Vec<Lit>, best: &mut usize, adopt: Adopt<'_>) -> Vec<Lit> {
        for _ in 0..TRIMMING_ROUNDS {
            let Reply::Unsat(trimmed) = self.solver.solve(&mut self.unfounded_sets, &core, CONFLICTS_TO_TRIM) else {
                break;
            };
            if trimmed.len() >= core.len() || trimmed.is_empty() {
                break;
            }
            core = trimmed;
        }
        let mut at = 0;
        while at < core.len() && core.len() > 1 {
            let mut without = core.clone();
            without.remove(at);
            match self.solver.solve(&mut self.unfounded_sets, &without, CONFLICTS_TO_MINIMISE) {
                Reply::Unsat(within) if !within.is_empty() => {
                    without.retain(|literal| within.contains(literal));
                    core = without;
                }
                Reply::Sat => {
                    *best = adopt(&self.model());
                    at += 1;
                }
                Reply::Unsat(_) | Reply::Unknown => at += 1,
            }
        }
        core
    }

    /// Replaces the soft literals of a core by one on its totalizer: no more of them fail than must. Raises the bound
    /// by the number that must fail.
    fn relax(&mut self, core: &[Lit], best: &mut usize, adopt: Adopt<'_>) -> Result<(), Interrupted> {
        let (failing, kept) = core::mem::take(&mut self.soft)
            .into_iter()
            .partition::<Vec<SoftLiteral>, _>(|soft| core.contains(&soft.literal));
        self.soft = kept;
        self.bound += 1;
        for (totalizer, allowed) in failing.iter().filter_map(|soft| soft.counted) {
            self.assume_at_most(totalizer, allowed + 1)?;
        }
        let failed: Vec<Lit> = failing.iter().map(|soft| !soft.literal).collect();
        self.solver.add(failed.iter().copied())?;
        if failed.len() == 1 {
            return Ok(());
        }
        self.totalizers.push(Totalizer::new(&failed));
        let (totalizer, mut must) = (self.totalizers.len() - 1, 1);
        while self.bound < *best {
            let Some(more) = self.totalizers[totalizer].more_than(must, &mut self.solver)? else { return Ok(()) };
            match self.solver.solve(&mut self.unfounded_sets, &[!more], CONFLICTS_TO_TRIM) {
                Reply::Unsat(_) => {
                    self.solver.add([more])?;
                    (self.bound, must) = (self.bound + 1, must + 1);
                }
                Reply::Sat => {
                    *best = adopt(&self.model());
                    break;
                }
                Reply::Unknown => break,
            }
        }
        self.assume_at_most(totalizer, must)
    }

    /// Adds the soft literal "at most `allowed` of the totalizer's literals hold".
    fn assume_at_most(&mut self, totalizer: usize, allowed: usize) -> Result<(), Interrupted> {
        let more = self.totalizers[totalizer].more_than(allowed, &mut self.solver)?;
        self.soft.extend(more.map(|more| SoftLiteral { literal: !more, counted: Some((totalizer, allowed)) }));
        Ok(())
    }
}
