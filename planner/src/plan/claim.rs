//! A stated answer, the checker's input. Its ids may name no object.

use nalgebra::Point2;

/// A stated grasp or release.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClaimedGrasp {
    /// rad.
    pub yaw: f64,
    /// Stated free angle on each side, rad.
    pub slack: Option<f64>,
}

/// A stated relocation.
#[derive(Debug, Clone, PartialEq)]
pub struct ClaimedRelocation {
    /// The id of the object moved.
    pub object: String,
    /// Its stated place before.
    pub from: Option<Point2<f64>>,
    /// Its stated place after.
    pub to: Point2<f64>,
    /// How it is picked.
    pub grasp: ClaimedGrasp,
    /// How it is let go.
    pub release: ClaimedGrasp,
    /// Stated least distance to another object at the new place, m.
    pub gap: Option<f64>,
}

/// The verdicts by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VerdictName {
    /// The target can be grasped as the table stands.
    Graspable,
    /// A plan frees the target.
    Relocate,
    /// No plan can.
    Deadlock,
    /// No place was found.
    NoSpace,
    /// Time ran out.
    TimedOut,
}

/// A stated lock.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ClaimedDeadlock {
    /// The greatest lock.
    pub blocked: Vec<String>,
    /// A lock within it.
    pub core: Vec<String>,
}

/// A stated answer. Parts that are `None` are not checked.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Claim {
    /// The verdict.
    pub verdict: Option<VerdictName>,
    /// The steps, in order.
    pub relocations: Option<Vec<ClaimedRelocation>>,
    /// The final grasp of the target.
    pub target_grasp: Option<ClaimedGrasp>,
    /// The count of relocations.
    pub cost: Option<u64>,
    /// The stated lower bound on the relocations of every plan.
    pub lower_bound: Option<u64>,
    /// The stated optimality of the plan.
    pub optimal: Option<bool>,
    /// The proof of the bound.
    pub landmarks: Option<Vec<Vec<String>>>,
    /// The proof of a deadlock.
    pub deadlock: Option<ClaimedDeadlock>,
    /// The best known derivation if there is no plan: ids, in order.
    pub needed: Option<Vec<String>>,
}
