//! Dispatches to the search method that was asked for.

use super::conclusion::Conclusion;
use super::forward_astar::forward_astar;
use super::lobs::lobs;
use super::methods::{Methods, SearchMethod};
use crate::budget::{Budget, Interrupted};
use crate::knowledge::{KnowledgeBase, NoBase, complete, relevant};
use crate::scene::{ObjectIndex, Scene};
use crate::search::{Derivation, LeastSet, Memory, Progress, Restriction, SearchOutcome, least_within};

/// Memory limits of the paper's searches.
#[derive(Debug, Clone, Copy)]
pub struct SearchLimits {
    /// The most objects in OPEN, or in one product of premises, of LOBS.
    pub lobs_members: usize,
    /// The most states of A*.
    pub astar_states: usize,
    /// The most words of all sets of A* together; it matters for many objects.
    pub astar_words: usize,
}

/// For a request: some 20 MB, freed in some 20 ms; some 50 MB for a scene of 64 objects.
impl Default for SearchLimits {
    fn default() -> Self {
        Self { lobs_members: 2_000_000, astar_states: 500_000, astar_words: 4_000_000 }
    }
}

/// The result of a search.
pub enum Sought {
    /// A least set, with proof.
    Least(LeastSet),
    /// The best set so far; the budget ended.
    Best(LeastSet),
    /// A sequence without proof.
    Sequence(Derivation),
    /// A deadlock.
    Nothing,
    /// The budget ended.
    TooLate,
    /// The memory ended.
    TooLarge,
}

/// The base that a search needs. The forward search may relocate objects unrelated to the target.
pub(super) fn base(
    methods: &Methods,
    scene: &Scene,
    target: ObjectIndex,
    budget: &Budget<'_>,
) -> Result<KnowledgeBase, NoBase> {
    let model = methods.grasp_model.model();
    match methods.search {
        SearchMethod::Landmarks | SearchMethod::Lobs => relevant(scene, target, model, budget),
        SearchMethod::ForwardAstar => complete(scene, model, budget),
    }
}

/// Searches for relocations that free the target. The paper's searches report no incumbents.
pub fn seek(
    method: SearchMethod,
    base: &KnowledgeBase,
    target: ObjectIndex,
    limits: &SearchLimits,
    budget: &Budget<'_>,
    progress: Progress<'_>,
) -> Sought {
    match method {
        SearchMethod::Landmarks => {
            match least_within(&Memory::default(), base, target, &Restriction::default(), budget, progress) {
                SearchOutcome::Least(known) => Sought::Least(known),
                SearchOutcome::Underivable => Sought::Nothing,
                SearchOutcome::Interrupted(Some(known)) => Sought::Best(known),
                SearchOutcome::Interrupted(None) => Sought::TooLate,
            }
        }
        SearchMethod::Lobs => concluded(lobs(base, target, limits.lobs_members, budget)),
        SearchMethod::ForwardAstar => {
            let words = base.len().div_ceil(64).max(1);
            concluded(forward_astar(base, target, limits.astar_states.min(limits.astar_words / words), budget))
        }
    }
}

fn concluded(conclusion: Result<Conclusion, Interrupted>) -> Sought {
    match conclusion {
        Ok(Conclusion::Sequence(derivation)) => Sought::Sequence(derivation),
        Ok(Conclusion::Deadlock) => Sought::Nothing,
        Ok(Conclusion::TooLarge) => Sought::TooLarge,
        Err(Interrupted) => Sought::TooLate,
    }
}
