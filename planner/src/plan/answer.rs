//! The planner's answer: a verdict with its plan, its proof, or the bound that was reached.

use core::time::Duration;

use super::warning::Warning;
use crate::geometry::Grasp;
use crate::placement::Relocation;
use crate::scene::ObjectIndex;

/// A lower bound on the relocations of every plan, with its proof.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct LowerBound {
    /// No plan has fewer relocations.
    pub cost: usize,
    /// The proof: every plan moves at least one member of each set, and hitting all sets takes at least `cost` objects.
    pub landmarks: Vec<Vec<ObjectIndex>>,
}

/// The proof that nothing frees the target.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Deadlock {
    /// The greatest lock, in index order, with fixed objects that block a member.
    pub blocked: Vec<ObjectIndex>,
    /// An inclusion-minimal lock within it, in index order.
    pub core: Vec<ObjectIndex>,
}

/// A checked plan.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// In order of execution; empty if the target is graspable at once.
    pub relocations: Vec<Relocation>,
    /// The final grasp of the target.
    pub target_grasp: Grasp,
    /// The proven bound; the plan is optimal if it has as many relocations. `None` if nothing is proven.
    pub bound: Option<LowerBound>,
}

/// The results without a plan.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unplanned {
    /// The proven bound; `None` if nothing is proven.
    pub bound: Option<LowerBound>,
    /// The objects of the best known derivation, in order; `None` if there is none.
    pub needed: Option<Vec<ObjectIndex>>,
}

/// The verdict with its parts.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// The target can be grasped as the table stands.
    Graspable(Grasp),
    /// This plan frees the target.
    Relocate(Plan),
    /// No sequence of pick-and-place frees the target. Without a proof only by the paper's methods.
    Deadlock(Option<Deadlock>),
    /// Effort spent or places exhausted without a checked plan; not a proof.
    NoSpace(Unplanned),
    /// The time limit came first, with no plan in hand.
    TimedOut(Unplanned),
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

/// The planner's answer.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// The verdict.
    pub verdict: Verdict,
    /// Warnings about an answer by the paper's methods.
    pub warnings: Vec<Warning>,
    /// Not part of the answer's identity: it differs between runs.
    pub statistics: Statistics,
}

impl Statistics {
    /// Every phase with its name, in order.
    pub fn phases(&self) -> [(&'static str, Duration); 4] {
        let Self { knowledge, search, placement, check } = *self;
        [("knowledge", knowledge), ("search", search), ("placement", placement), ("check", check)]
    }
}

impl Plan {
    /// The number of relocations.
    pub fn cost(&self) -> usize {
        self.relocations.len()
    }

    /// True if it has as many relocations as are proven to be necessary.
    pub fn optimal(&self) -> bool {
        self.bound.as_ref().is_some_and(|bound| self.cost() == bound.cost)
    }
}

impl Answer {
    /// True if the checker refuses a part of it: only answers by the paper's methods are served then.
    pub fn faulty(&self) -> bool {
        self.warnings.iter().any(|warning| matches!(warning, Warning::Faulty(_)))
    }

    /// True if the plan holds and no plan has fewer relocations; `None` if there is no plan or nothing is proven.
    pub fn optimal(&self) -> Option<bool> {
        match &self.verdict {
            _ if self.faulty() => None,
            Verdict::Graspable(_) => Some(true),
            Verdict::Relocate(plan) => plan.bound.as_ref().map(|_| plan.optimal()),
            Verdict::Deadlock(_) | Verdict::NoSpace(_) | Verdict::TimedOut(_) => None,
        }
    }
}

/// The trivial bound, which needs no proof.
impl Default for Unplanned {
    fn default() -> Self {
        Self { bound: Some(LowerBound::default()), needed: None }
    }
}

impl Verdict {
    /// Its name in answers and logs.
    pub fn as_str(&self) -> &'static str {
        match self {
            Self::Graspable(_) => "graspable",
            Self::Relocate(_) => "relocate",
            Self::Deadlock(_) => "deadlock",
            Self::NoSpace(_) => "no_space",
            Self::TimedOut(_) => "timed_out",
        }
    }

    /// The bound, if the verdict has one to prove.
    pub(super) fn bound_mut(&mut self) -> Option<&mut LowerBound> {
        match self {
            Self::Relocate(plan) => plan.bound.as_mut(),
            Self::NoSpace(rest) | Self::TimedOut(rest) => rest.bound.as_mut(),
            Self::Graspable(_) | Self::Deadlock(_) => None,
        }
    }
}
