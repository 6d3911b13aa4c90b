//! Generated scenes, and the paper's tables run on them.

mod arrange;
mod episode;
mod error;
mod figures;
mod generate;
mod papers_cases;
mod papers_scene;
mod recipe;
mod sample;
mod shaped;
mod table1;
mod table2;
mod timed_search;
mod varied;
mod wanting;
mod workers;

use core::time::Duration;

pub use error::{EpisodeError, ExperimentError};
pub use figures::{MethodFigures, ModelFigures, PlanFigures};
pub use generate::generate;
pub use papers_cases::{PAPERS_CASES, PapersCase, Printed, PrintedReposition, TABLE1_EPISODES, TABLE2_EPISODES};
pub use recipe::{Crowding, GenerateError, Recipe, Wanted};
pub use sample::{ConfidenceInterval, Spread};
pub use shaped::{mixed, shaped};
pub use table1::{Table1Column, table1};
pub use table2::{PlacementFigures, Repositioning, Table2Column, table2};
pub use timed_search::SearchEnding;
pub use varied::varied;
pub use wanting::wanting;

/// The settings of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ExperimentSettings {
    /// Episodes in each column, one or more.
    pub episodes: usize,
    /// The first of them, which the baseline runs too in Table I: it may take the whole time limit for each.
    pub base_episodes: usize,
    /// The same seed gives the same scenes, on any machine.
    pub seed: u64,
    /// For each search of each episode, and for each plan.
    pub time_limit: Duration,
    /// Threads, one or more.
    pub jobs: usize,
}

impl ExperimentSettings {
    /// The time limit in whole milliseconds.
    pub fn time_limit_ms(&self) -> u64 {
        u64::try_from(self.time_limit.as_millis()).unwrap_or(u64::MAX)
    }
}
