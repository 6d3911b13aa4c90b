//! The planner's answer.

use core::time::Duration;

use crate::budget::Budget;
use crate::statement::Statement;

/// A statement, and how long it took.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// As it is served. By our own methods: as the checker confirmed it.
    pub statement: Statement,
    /// Not part of the answer's identity: it differs between runs.
    pub statistics: Statistics,
}

/// How long each phase took.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Shadows, options, locks.
    pub knowledge: Duration,
    /// The least relocation set with its proof.
    pub search: Duration,
    /// Places.
    pub placement: Duration,
    /// The independent check; for the paper's methods also our own search, which judges them.
    pub check: Duration,
}

impl Statistics {
    /// Every phase with its name, in order.
    pub fn phases(&self) -> [(&'static str, Duration); 4] {
        let Self { knowledge, search, placement, check } = *self;
        [("knowledge", knowledge), ("search", search), ("placement", placement), ("check", check)]
    }
}

/// Runs a part of a phase, and adds its time.
pub(crate) fn timed<T>(phase: &mut Duration, budget: &Budget<'_>, part: impl FnOnce() -> T) -> T {
    let started = budget.elapsed();
    let result = part();
    *phase += budget.elapsed().saturating_sub(started);
    result
}
