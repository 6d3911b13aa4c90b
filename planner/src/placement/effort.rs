//! Effort: a limit on the places tried. It is counted, not timed, so that the same question always ends at the same
//! point.

use crate::budget::{Budget, Stop, Ticker};

/// The effort left, in tried places of about half a microsecond each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Effort {
    left: u32,
}

impl Effort {
    /// An effort of `places`.
    pub fn new(places: u32) -> Self {
        Self { left: places }
    }

    /// Places left.
    pub fn left(&self) -> u32 {
        self.left
    }

    /// Splits off at most `places`.
    pub fn split(&mut self, places: u32) -> Self {
        let part = places.min(self.left);
        self.left -= part;
        Self { left: part }
    }

    /// Takes back the rest of a part.
    pub fn join(&mut self, part: Self) {
        self.left += part.left;
    }
}

/// Units of effort between two looks at the budget, some 30 µs.
pub(super) const BEAT: usize = 64;

/// Spends effort, and looks at the budget after each [`BEAT`] units.
pub(super) struct EffortMeter<'e> {
    effort: &'e mut Effort,
    ticker: Ticker<'e>,
}

impl<'e> EffortMeter<'e> {
    pub(super) fn new(effort: &'e mut Effort, budget: &'e Budget<'e>) -> Self {
        Self { effort, ticker: Ticker::every(BEAT, budget) }
    }

    /// Looks at the budget now.
    pub(super) fn look(&mut self) -> Result<(), Stop> {
        Ok(self.ticker.look()?)
    }

    pub(super) fn spend(&mut self, effort: usize) -> Result<(), Stop> {
        let left = u32::try_from(effort).ok().and_then(|effort| self.effort.left.checked_sub(effort));
        self.effort.left = left.ok_or(Stop::Spent)?;
        Ok(self.ticker.step(effort)?)
    }
}
