//! One search on one base, by the clock.

use core::time::Duration;

use super::workers::Patience;
use crate::budget::{Budget, Clock};
use crate::knowledge::KnowledgeBase;
use crate::paper::{Conclusion, forward_astar, lobs};
use crate::plan::SearchMethod;
use crate::scene::ObjectIndex;
use crate::search::{Outcome, Restriction, least};

/// The most states of the baseline, some 100 bytes each for the paper's scenes, whose sets of objects fit into one word.
const MAX_ASTAR_STATES: usize = 5_000_000;
/// The most objects in OPEN, or in one product of premises, of LOBS: some 50 MB.
const MAX_LOBS_MEMBERS: usize = 5_000_000;

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
    let concluded = |conclusion| match conclusion {
        Ok(Conclusion::Sequence(derivation)) => Ending::Sequence(derivation.order.len()),
        Ok(Conclusion::Deadlock) => Ending::Deadlock,
        Ok(Conclusion::TooLarge) => Ending::TooLarge,
        Err(_) => Ending::Late,
    };
    let ending = match method {
        SearchMethod::ForwardAstar => concluded(forward_astar(base, target, MAX_ASTAR_STATES, &budget)),
        SearchMethod::Lobs => concluded(lobs(base, target, MAX_LOBS_MEMBERS, &budget)),
        SearchMethod::Landmarks => match least(base, target, &Restriction::default(), &budget) {
            Outcome::Least(known) => Ending::Sequence(known.bound),
            Outcome::Underivable => Ending::Deadlock,
            Outcome::Interrupted(_) => Ending::Late,
        },
    };
    let time = match ending {
        Ending::Sequence(_) | Ending::Deadlock => watch.elapsed(),
        Ending::Late | Ending::TooLarge => patience.limit,
    };
    TimedSearch { ending, time }
}
