//! The CDCL solver (batsat) with assumptions, under our budget.

use core::cell::{Cell, RefCell};
use std::rc::Rc;

use batsat::{Callbacks, ClauseKind, Lit, SolverInterface, SolverOpts, lbool};

use super::unfounded_sets::UnfoundedSets;
use crate::budget::{Interrupted, Ticker};

/// Learnt clauses that are always kept. On problems this small a deleted clause is soon learnt again.
const KEPT: i32 = 5000;
/// Steps of a [`Ticker`] for one round of propagation.
const STEPS: usize = 4;
/// Literals of all clauses that add one step to each round.
const LITERALS_A_STEP: usize = 1000;
/// Rules read by [`UnfoundedSets`] that cost one step.
const RULES_A_STEP: usize = 100;

/// What the solver says to a list of assumptions.
pub(super) enum Reply {
    /// There is a model, see [`Solver::is_true`].
    Sat,
    /// There is none: the core, assumptions of which at least one fails.
    Unsat(Vec<Lit>),
    /// The conflicts, the memory or the budget ran out first.
    Unknown,
}

/// An incremental solver: it keeps its learnt clauses from call to call.
pub(super) struct Solver<'b> {
    solver: batsat::Solver<Limits<'b>>,
}

impl<'b> Solver<'b> {
    /// A solver without clauses. All clauses together may hold `max_literals`.
    pub(super) fn new(max_literals: usize, ticker: Ticker<'b>) -> Self {
        let limits = Limits {
            ticker: RefCell::new(ticker),
            steps: STEPS,
            work: Rc::default(),
            ended: Cell::new(false),
            conflicts: 0,
            last: 0,
            literals: 0,
            max_literals,
        };
        let options = SolverOpts { min_learnts_lim: KEPT, ..SolverOpts::default() };
        Self { solver: batsat::Solver::new(options, limits) }
    }

    /// The literal of a new variable. Its first phase is true if it is `likely`.
    pub(super) fn literal(&mut self, likely: bool) -> Lit {
        let likely = if likely { lbool::TRUE } else { lbool::UNDEF };
        Lit::new(self.solver.new_var(likely, true), true)
    }

    /// Adds a clause.
    ///
    /// # Errors
    /// [`Interrupted`] when the budget ends.
    pub(super) fn add(&mut self, clause: impl IntoIterator<Item = Lit>) -> Result<(), Interrupted> {
        let mut clause: Vec<Lit> = clause.into_iter().collect();
        let limits = self.solver.cb_mut();
        limits.literals += clause.len();
        limits.steps = STEPS + limits.literals / LITERALS_A_STEP;
        limits.ticker.get_mut().step(1 + clause.len() / 8)?;
        self.solver.add_clause_reuse(&mut clause);
        Ok(())
    }

    /// Solves under assumptions, with at most so many `conflicts`.
    pub(super) fn solve(
        &mut self,
        unfounded_sets: &mut UnfoundedSets<'_>,
        assumptions: &[Lit],
        conflicts: u64,
    ) -> Reply {
        let limits = self.solver.cb_mut();
        limits.last = limits.conflicts.saturating_add(conflicts);
        let answer = self.solver.solve_limited_th(unfounded_sets, assumptions);
        if answer == lbool::TRUE {
            Reply::Sat
        } else if answer == lbool::FALSE {
            // batsat returns the final conflict clause: the negations of the core's literals.
            Reply::Unsat(self.solver.unsat_core().iter().map(|&lit| !lit).collect())
        } else {
            Reply::Unknown
        }
    }

    /// The literal's value in the last model.
    pub(super) fn is_true(&self, literal: Lit) -> bool {
        self.solver.value_lit(literal) == lbool::TRUE
    }

    /// The counter of rules read between two rounds of propagation.
    pub(super) fn work(&self) -> Rc<Cell<usize>> {
        Rc::clone(&self.solver.cb().work)
    }

    /// The number of clauses learnt so far.
    pub(super) fn conflicts(&self) -> u64 {
        self.solver.cb().conflicts
    }

    /// # Errors
    /// [`Interrupted`] if the budget has ended.
    pub(super) fn check(&self) -> Result<(), Interrupted> {
        if self.solver.cb().ended.get() { Err(Interrupted) } else { Ok(()) }
    }
}

/// The limits at which the solver stops. It asks after each round of propagation.
struct Limits<'b> {
    ticker: RefCell<Ticker<'b>>,
    /// The cost of one round.
    steps: usize,
    /// Rules read since the last round.
    work: Rc<Cell<usize>>,
    /// True once the budget has ended.
    ended: Cell<bool>,
    conflicts: u64,
    /// The conflict at which the current call stops.
    last: u64,
    /// The literals of all clauses together.
    literals: usize,
    max_literals: usize,
}

impl Callbacks for Limits<'_> {
    fn on_new_clause(&mut self, clause: &[Lit], kind: ClauseKind) {
        self.conflicts += 1;
        // The solver keeps a loop nogood beside the clause that it learns from it.
        self.literals += if kind == ClauseKind::Theory { 2 * clause.len() } else { clause.len() };
    }

    fn on_delete_clause(&mut self, clause: &[Lit]) {
        self.literals = self.literals.saturating_sub(clause.len());
    }

    fn stop(&self) -> bool {
        if self.ticker.borrow_mut().step(self.steps + self.work.take() / RULES_A_STEP).is_err() {
            self.ended.set(true);
        }
        self.ended.get() || self.conflicts >= self.last || self.literals > self.max_literals
    }
}
