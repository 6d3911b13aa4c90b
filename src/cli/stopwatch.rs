//! The clock of a command. It is never cancelled: an impatient user kills the process.

use core::time::Duration;
use std::time::Instant;

use singulate_planner::budget::Clock;

/// Measures time from its start.
#[derive(Debug)]
pub(super) struct Stopwatch(Instant);

impl Stopwatch {
    pub(super) fn start() -> Self {
        Self(Instant::now())
    }
}

impl Clock for Stopwatch {
    fn elapsed(&self) -> Duration {
        self.0.elapsed()
    }

    fn cancelled(&self) -> bool {
        false
    }
}
