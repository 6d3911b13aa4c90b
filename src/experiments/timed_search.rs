//! One timed search on one base.

use core::time::Duration;

use super::workers::Patience;
use singulate_planner::budget::{Budget, Clock};
use singulate_planner::knowledge::KnowledgeBase;
use singulate_planner::paper::{SearchLimits, SearchMethod, Sought, seek};
use singulate_planner::scene::ObjectIndex;
use singulate_planner::search::SILENT;

/// Some 100 bytes per state of the baseline for the paper's scenes, whose sets of objects fit into one word; some 50 MB
/// for LOBS.
const LIMITS: SearchLimits = SearchLimits { lobs_members: 5_000_000, astar_states: 5_000_000, astar_words: 5_000_000 };

/// The end of a search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SearchEnding {
    /// A sequence of this many relocations, without the target.
    Sequence(u64),
    /// A deadlock.
    Deadlock,
    /// The time limit.
    Late,
    /// The memory limit.
    TooLarge,
}

/// One search with its time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TimedSearch {
    pub(super) ending: SearchEnding,
    /// The time limit for a search that did not finish, since with more memory it would have gone on.
    pub(super) time: Duration,
}

/// Search `base`, which is complete, for relocations that free `target`.
pub(super) fn timed_search(
    method: SearchMethod,
    base: &KnowledgeBase,
    target: ObjectIndex,
    patience: &Patience<'_>,
) -> TimedSearch {
    let watch = patience.watch();
    let budget = Budget::new(&watch, patience.limit);
    let ending = match seek(method, base, target, &LIMITS, &budget, SILENT) {
        Sought::Least(known) => SearchEnding::Sequence(known.bound.get()),
        Sought::Sequence(derivation) => SearchEnding::Sequence(derivation.cost().get()),
        Sought::Nothing => SearchEnding::Deadlock,
        Sought::Best(_) | Sought::TooLate => SearchEnding::Late,
        Sought::TooLarge => SearchEnding::TooLarge,
    };
    let time = match ending {
        SearchEnding::Sequence(_) | SearchEnding::Deadlock => watch.elapsed(),
        SearchEnding::Late | SearchEnding::TooLarge => patience.limit,
    };
    TimedSearch { ending, time }
}
