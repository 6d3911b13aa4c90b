//! Why an experiment has no result.

use super::recipe::GenerateError;
use super::timed_search::SearchEnding;
use singulate_planner::knowledge::NoBase;
use singulate_planner::plan::PlanError;

/// One episode failed, and with it the experiment.
#[derive(Debug, thiserror::Error)]
#[error("{objects} objects, seed {seed}: {cause}")]
pub struct ExperimentError {
    /// The column.
    pub objects: usize,
    /// The seed of the scene.
    pub seed: u64,
    /// The cause.
    pub cause: EpisodeError,
}

/// Why an episode failed.
#[derive(Debug, thiserror::Error)]
pub enum EpisodeError {
    /// There is no scene.
    #[error("{0}")]
    Scene(GenerateError),
    /// There is no knowledge base.
    #[error("{0}")]
    Knowledge(NoBase),
    /// The planner failed: a bug of ours.
    #[error("{0}")]
    Plan(PlanError),
    /// Another search refutes our proof on the same base: a bug of ours.
    #[error("a search ends with {ending:?} where ours proves {proven:?}")]
    Refuted {
        /// The other search's result.
        ending: SearchEnding,
        /// Our proven result.
        proven: SearchEnding,
    },
    /// Our search and our planner, which build on the same knowledge, contradict each other: a bug of ours.
    #[error("the planner contradicts the search, which ends with {0:?}")]
    Contradicted(SearchEnding),
}
