//! One search on one base, by the clock.

use core::time::Duration;

use super::workers::Patience;
use singulate_planner::budget::{Budget, Clock};
use singulate_planner::knowledge::KnowledgeBase;
use singulate_planner::plan::{SearchLimits, SearchMethod, Sought, seek_within};
use singulate_planner::scene::ObjectIndex;

/// Some 100 bytes a state of the baseline for the paper's scenes, whose sets of objects fit into one word; some 50 MB for
/// LOBS.
const LIMITS: SearchLimits = SearchLimits { lobs_members: 5_000_000, astar_states: 5_000_000, astar_words: 5_000_000 };

/// How a search ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// With a sequence of so many relocations, the target not counted.
    Sequence(usize),
    /// It says that there is none.
    Deadlock,
    /// The time limit came first.
    Late,
    /// The limit of memory came first.
    TooLarge,
}

/// One search with its time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TimedSearch {
    pub(super) ending: Ending,
    /// The time limit for one that did not end by itself: with more memory it would have gone on.
    pub(super) time: Duration,
}

/// Search `base`, a complete one, for what frees `target`.
pub(super) fn timed_search(
    method: SearchMethod,
    base: &KnowledgeBase,
    target: ObjectIndex,
    patience: &Patience<'_>,
) -> TimedSearch {
    let watch = patience.watch();
    let budget = Budget::new(&watch, patience.limit);
    let ending = match seek_within(method, base, target, &LIMITS, &budget) {
        Sought::Least(known) => Ending::Sequence(known.bound),
        Sought::Sequence(derivation) => Ending::Sequence(derivation.order.len()),
        Sought::Nothing => Ending::Deadlock,
        Sought::Best(_) | Sought::TooLate => Ending::Late,
        Sought::TooLarge => Ending::TooLarge,
    };
    let time = match ending {
        Ending::Sequence(_) | Ending::Deadlock => watch.elapsed(),
        Ending::Late | Ending::TooLarge => patience.limit,
    };
    TimedSearch { ending, time }
}
