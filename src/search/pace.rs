//! How often the search looks at its budget.

use crate::budget::{Budget, Incumbent, Interrupted};

/// Counts steps and asks the budget now and then: reading a clock costs as much as some steps do.
pub(super) struct Pace<'a> {
    budget: &'a Budget<'a>,
    left: usize,
}

/// Steps between two looks, some 50 µs.
const BEAT: usize = 100;

impl<'a> Pace<'a> {
    /// One that asks at its first step.
    pub(super) fn new(budget: &'a Budget<'a>) -> Self {
        Self { budget, left: 0 }
    }

    /// Another one on the same budget.
    pub(super) fn another(&self) -> Self {
        Self::new(self.budget)
    }

    /// Account for so many steps, of about half a microsecond each.
    ///
    /// # Errors
    /// [`Interrupted`] if a look was due and the budget has ended.
    pub(super) fn step(&mut self, steps: usize) -> Result<(), Interrupted> {
        if let Some(left) = self.left.checked_sub(steps) {
            self.left = left;
            return Ok(());
        }
        self.left = BEAT;
        self.budget.check()
    }

    /// Tell whoever watches how far the search has come.
    pub(super) fn note(&self, cost: usize, lower_bound: usize) {
        self.budget.note(Incumbent { cost, lower_bound });
    }
}
