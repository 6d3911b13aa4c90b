//! What has to be moved, by the search that was asked for.

use super::answer::LowerBound;
use super::settings::{GraspModel, SearchMethod};
use crate::budget::{Budget, Interrupted};
use crate::knowledge::{KnowledgeBase, NoBase, complete, relevant};
use crate::paper::{Conclusion, forward_astar, lobs};
use crate::scene::{ObjectIndex, Scene};
use crate::search::{Derivation, LeastSet, Memory, Outcome, Progress, Restriction, SILENT, least_within};

/// How much the paper's searches may keep in memory.
#[derive(Debug, Clone, Copy)]
pub struct SearchLimits {
    /// The most objects in OPEN, or in one product of premises, of LOBS.
    pub lobs_members: usize,
    /// The most states of A*.
    pub astar_states: usize,
    /// The most words of all of A*'s sets together, which matters where there are many objects.
    pub astar_words: usize,
}

/// For a request: some 20 MB, and some 20 ms to give them back; some 50 MB for a scene of 64 objects.
const LIMITS: SearchLimits = SearchLimits { lobs_members: 2_000_000, astar_states: 500_000, astar_words: 4_000_000 };

/// What a search says.
pub enum Sought {
    /// A least set, with proof.
    Least(LeastSet),
    /// The best set so far; the budget ended.
    Best(LeastSet),
    /// A sequence without proof.
    Sequence(Derivation),
    /// There is none.
    Nothing,
    /// The budget ended.
    TooLate,
    /// The memory ended.
    TooLarge,
}

impl From<&LeastSet> for LowerBound {
    fn from(known: &LeastSet) -> Self {
        Self { cost: known.proven, landmarks: known.landmarks.clone() }
    }
}

impl SearchMethod {
    /// The base that the search needs. The forward search may relocate what has nothing to do with the target.
    pub(super) fn base(self, scene: &Scene, model: GraspModel, budget: &Budget<'_>) -> Result<KnowledgeBase, NoBase> {
        match self {
            Self::Landmarks | Self::Lobs => relevant(scene, scene.target(), model.options_of(), budget),
            Self::ForwardAstar => complete(scene, model.options_of(), budget),
        }
    }
}

/// Search for what frees the target, within the limits of a request.
pub(super) fn seek(
    method: SearchMethod,
    base: &KnowledgeBase,
    target: ObjectIndex,
    budget: &Budget<'_>,
    progress: Progress<'_>,
) -> Sought {
    by_method(method, base, target, &LIMITS, budget, progress)
}

/// Search for what frees the target.
pub fn seek_within(
    method: SearchMethod,
    base: &KnowledgeBase,
    target: ObjectIndex,
    limits: &SearchLimits,
    budget: &Budget<'_>,
) -> Sought {
    by_method(method, base, target, limits, budget, SILENT)
}

/// The paper's searches have no incumbents to tell of.
fn by_method(
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
                Outcome::Least(known) => Sought::Least(known),
                Outcome::Underivable => Sought::Nothing,
                Outcome::Interrupted(Some(known)) => Sought::Best(known),
                Outcome::Interrupted(None) => Sought::TooLate,
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
