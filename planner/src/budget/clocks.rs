//! A clock for tests.

use core::cell::Cell;
use core::time::Duration;

use super::{Budget, Clock};

/// Counts the looks at a budget, and ends it after some of them. No time passes.
pub(crate) struct Looks {
    seen: Cell<usize>,
    /// The looks that find time left.
    most: usize,
}

impl Looks {
    /// The budget ends after `most` looks.
    pub(crate) fn ending_after(most: usize) -> Self {
        Self { seen: Cell::new(0), most }
    }

    /// The number of looks at the budget that `work` takes.
    pub(crate) fn of(work: impl FnOnce(&Budget<'_>)) -> usize {
        let looks = Self::ending_after(usize::MAX);
        work(&looks.budget());
        looks.seen()
    }

    pub(crate) fn budget(&self) -> Budget<'_> {
        Budget::new(self, Duration::MAX)
    }

    pub(crate) fn seen(&self) -> usize {
        self.seen.get()
    }
}

impl Clock for Looks {
    fn elapsed(&self) -> Duration {
        Duration::ZERO
    }

    fn cancelled(&self) -> bool {
        self.seen.set(self.seen.get() + 1);
        self.seen.get() > self.most
    }
}
