//! How often the checker looks at its budget.

use crate::budget::{Budget, Interrupted};

/// Counts work in units of about a microsecond and asks the budget once per [`BEAT`].
pub(super) struct Meter<'a> {
    budget: &'a Budget<'a>,
    /// Units left before the next look at the budget.
    left: usize,
}

/// Units between two looks at the budget: about 100 µs.
const BEAT: usize = 100;

/// Units that a replay may spend even after the budget has ended, about 50 ms: a plan found at the last moment must
/// still be replayed before it is served. Only plans from outside are longer.
const PATIENCE: usize = 50_000;

impl<'a> Meter<'a> {
    pub(super) fn new(budget: &'a Budget<'a>) -> Self {
        Self { budget, left: BEAT }
    }

    /// A meter that asks only after `PATIENCE`.
    pub(super) fn patient(budget: &'a Budget<'a>) -> Self {
        Self { budget, left: PATIENCE }
    }

    /// Account for `units` of work.
    ///
    /// # Errors
    /// [`Interrupted`] if a look was due and the budget has ended.
    pub(super) fn spend(&mut self, units: usize) -> Result<(), Interrupted> {
        if let Some(left) = self.left.checked_sub(units) {
            self.left = left;
            return Ok(());
        }
        self.left = BEAT;
        self.budget.check()
    }
}
