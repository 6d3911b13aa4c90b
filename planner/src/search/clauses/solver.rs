//! The SAT solver, under our budget.

use core::cell::{Cell, RefCell};
use std::rc::Rc;

use batsat::{Callbacks, ClauseKind, Lit, Solver, SolverInterface, SolverOpts, lbool};

use super::founded::Founded;
use crate::budget::Interrupted;
use crate::search::pace::Pace;

/// Learnt clauses that are kept in any case. So small a problem soon asks again for what it forgot.
const KEPT: i32 = 5000;
/// Steps of a [`Pace`] for one round of propagation, one more for as many literals, and for as many rules that
/// [`Founded`] looks at.
const STEPS: usize = 4;
const LITERALS_A_STEP: usize = 1000;
const RULES_A_STEP: usize = 100;

/// What the solver says to some wishes.
pub(super) enum Reply {
    /// All can be granted, see [`Asker::is_true`].
    Granted,
    /// These can't, nor can any set that holds them.
    Clash(Vec<Lit>),
    /// The conflicts are spent, or the memory, or the budget.
    Spent,
}

/// A solver that can be asked again and again, and that remembers what it has learnt.
pub(super) struct Asker<'b> {
    solver: Solver<Limits<'b>>,
}

impl<'b> Asker<'b> {
    /// No clauses yet, and that many literals in all of them at the most.
    pub(super) fn new(max_literals: usize, pace: Pace<'b>) -> Self {
        let limits = Limits {
            pace: RefCell::new(pace),
            steps: STEPS,
            work: Rc::default(),
            ended: Cell::new(false),
            conflicts: 0,
            last: 0,
            literals: 0,
            max_literals,
        };
        let options = SolverOpts { min_learnts_lim: KEPT, ..SolverOpts::default() };
        Self { solver: Solver::new(options, limits) }
    }

    /// A literal for something new. Where nothing speaks for either, it is taken to be `likely`.
    pub(super) fn literal(&mut self, likely: bool) -> Lit {
        let likely = if likely { lbool::TRUE } else { lbool::UNDEF };
        Lit::new(self.solver.new_var(likely, true), true)
    }

    /// One of these holds.
    ///
    /// # Errors
    /// [`Interrupted`] when the budget ends.
    pub(super) fn add(&mut self, clause: impl IntoIterator<Item = Lit>) -> Result<(), Interrupted> {
        let mut clause: Vec<Lit> = clause.into_iter().collect();
        let limits = self.solver.cb_mut();
        limits.literals += clause.len();
        limits.steps = STEPS + limits.literals / LITERALS_A_STEP;
        limits.pace.get_mut().step(1 + clause.len() / 8)?;
        self.solver.add_clause_reuse(&mut clause);
        Ok(())
    }

    /// Can all wishes be granted? Learns no more than so many clauses for it.
    pub(super) fn ask(&mut self, founded: &mut Founded<'_>, wishes: &[Lit], conflicts: u64) -> Reply {
        let limits = self.solver.cb_mut();
        limits.last = limits.conflicts.saturating_add(conflicts);
        let answer = self.solver.solve_limited_th(founded, wishes);
        if answer == lbool::TRUE {
            Reply::Granted
        } else if answer == lbool::FALSE {
            // The solver gives the clause that it learnt, which denies the wishes.
            Reply::Clash(self.solver.unsat_core().iter().map(|&lit| !lit).collect())
        } else {
            Reply::Spent
        }
    }

    /// Does it hold in what was granted last?
    pub(super) fn is_true(&self, literal: Lit) -> bool {
        self.solver.value_lit(literal) == lbool::TRUE
    }

    /// Where rules are counted that are looked at between two rounds of propagation.
    pub(super) fn work(&self) -> Rc<Cell<usize>> {
        Rc::clone(&self.solver.cb().work)
    }

    /// How many clauses were learnt in all.
    pub(super) fn conflicts(&self) -> u64 {
        self.solver.cb().conflicts
    }

    /// # Errors
    /// [`Interrupted`] if the budget has ended.
    pub(super) fn check(&self) -> Result<(), Interrupted> {
        if self.solver.cb().ended.get() { Err(Interrupted) } else { Ok(()) }
    }
}

/// When the solver has to stop. It asks after each round of propagation.
struct Limits<'b> {
    pace: RefCell<Pace<'b>>,
    /// What one round costs.
    steps: usize,
    /// Rules looked at besides.
    work: Rc<Cell<usize>>,
    /// The budget has.
    ended: Cell<bool>,
    conflicts: u64,
    /// The last conflict for the question at hand.
    last: u64,
    /// Of all clauses together.
    literals: usize,
    max_literals: usize,
}

impl Callbacks for Limits<'_> {
    fn on_new_clause(&mut self, clause: &[Lit], kind: ClauseKind) {
        self.conflicts += 1;
        // What `founded` found is kept besides what follows from it.
        self.literals += if kind == ClauseKind::Theory { 2 * clause.len() } else { clause.len() };
    }

    fn on_delete_clause(&mut self, clause: &[Lit]) {
        self.literals = self.literals.saturating_sub(clause.len());
    }

    fn stop(&self) -> bool {
        if self.pace.borrow_mut().step(self.steps + self.work.take() / RULES_A_STEP).is_err() {
            self.ended.set(true);
        }
        self.ended.get() || self.conflicts >= self.last || self.literals > self.max_literals
    }
}
