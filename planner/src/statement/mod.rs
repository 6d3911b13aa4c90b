//! The statement of an answer: what the checker reads and what is served. Anybody may state one, so its ids may name no
//! object.

mod step;

use crate::cost::Cost;

pub use step::{PickDrop, PickPlace, StatedGrasp, StatedPose, Step};

/// A stated answer. Parts that are `None` are not checked.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Statement {
    /// The verdict.
    pub verdict: Option<Verdict>,
    /// The steps, in order of execution.
    pub relocations: Option<Vec<Step>>,
    /// The id of the object that is grasped in the end, where the goal leaves the choice.
    pub target: Option<String>,
    /// The final grasp of the target.
    pub target_grasp: Option<StatedGrasp>,
    /// The cost of the steps.
    pub cost: Option<Cost>,
    /// No plan costs less.
    pub lower_bound: Option<Cost>,
    /// True if the plan costs no more than the bound.
    pub optimal: Option<bool>,
    /// The proof of the bound: every plan moves at least one member of each set.
    pub landmarks: Option<Vec<Vec<String>>>,
    /// The proof of a deadlock.
    pub deadlock: Option<Deadlock>,
    /// The best known derivation if there is no plan: ids, in order.
    pub needed: Option<Vec<String>>,
    /// Of a clearing: the lock of what can never be taken away.
    pub stuck: Option<Deadlock>,
    /// Of a clearing: the ids of the objects that stay, those apart that the caller calls fixed.
    pub left: Option<Vec<String>>,
    /// Of a clearing: true if no order takes more away.
    pub proven: Option<bool>,
}

/// The verdicts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// The target can be grasped as the table stands.
    Graspable,
    /// The plan reaches the goal.
    Relocate,
    /// No sequence of steps reaches the goal; proven only if the statement's `deadlock` says why.
    Deadlock,
    /// Effort spent or places exhausted without a checked plan; not a proof.
    NoSpace,
    /// The time limit came first, with no plan in hand.
    TimedOut,
    /// The steps take away all but what the caller calls fixed.
    Cleared,
    /// The steps take some of it away, or none.
    PartlyCleared,
}

/// Two locks, the proof of a deadlock: no movable member can be picked while the others stand.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Deadlock {
    /// The ids of the greatest lock, with fixed objects that block a member.
    pub blocked: Vec<String>,
    /// The ids of an inclusion-minimal lock within it.
    pub core: Vec<String>,
}

impl Statement {
    /// Nothing is known in time but the trivial bound, which needs no proof.
    pub fn timed_out() -> Self {
        Self {
            verdict: Some(Verdict::TimedOut),
            relocations: Some(Vec::new()),
            lower_bound: Some(Cost::ZERO),
            landmarks: Some(Vec::new()),
            ..Self::default()
        }
    }

    /// The steps; none where none are stated.
    pub fn steps(&self) -> &[Step] {
        self.relocations.as_deref().unwrap_or_default()
    }

    /// The name of the verdict in logs and metrics.
    pub fn verdict_name(&self) -> &'static str {
        self.verdict.map_or("unstated", Verdict::as_str)
    }
}

impl Verdict {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Graspable,
        Self::Relocate,
        Self::Deadlock,
        Self::NoSpace,
        Self::TimedOut,
        Self::Cleared,
        Self::PartlyCleared,
    ];

    /// Its name in answers and logs.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Graspable => "graspable",
            Self::Relocate => "relocate",
            Self::Deadlock => "deadlock",
            Self::NoSpace => "no_space",
            Self::TimedOut => "timed_out",
            Self::Cleared => "cleared",
            Self::PartlyCleared => "partly_cleared",
        }
    }
}
