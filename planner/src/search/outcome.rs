//! The question to the search, and its answer.

use crate::cost::Cost;
use crate::scene::ObjectIndex;

/// Objects in an order in which each can be moved, after which the target can be grasped. The target is not among them.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Derivation {
    /// The objects, in order.
    pub order: Vec<ObjectIndex>,
}

impl Derivation {
    /// The cost of moving each object once. The search minimises it, so each object costs the same there.
    pub fn cost(&self) -> Cost {
        Cost::of_each(self.order.len())
    }
}

/// A lower bound with its proof, and the best derivation so far.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct LeastSet {
    /// The shortest derivation known.
    pub derivation: Derivation,
    /// No derivation is shorter.
    pub bound: Cost,
    /// The part of the bound that the landmarks prove. On a hard base it may be less than the bound, the rest of which
    /// comes from MaxSAT.
    pub proven: Cost,
    /// Landmarks, each sorted: every derivation holds at least one member of each. A least hitting set of them has at
    /// least `proven` members, each of which costs one. (For a restricted question both hold only under the restriction.)
    pub landmarks: Vec<Vec<ObjectIndex>>,
}

/// How the search ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SearchOutcome {
    /// Bound and derivation meet.
    Least(LeastSet),
    /// The target can't be derived.
    Underivable,
    /// The budget ended first. The best so far, or `None` if there is no derivation yet.
    Interrupted(Option<LeastSet>),
}

/// How far the search has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Incumbent {
    /// The cost of the best set known.
    pub cost: Cost,
    /// No set costs less.
    pub lower_bound: Cost,
}

/// A callback for every incumbent. Some are reported twice.
pub type Progress<'a> = &'a dyn Fn(Incumbent);

/// A callback that does nothing.
pub const SILENT: Progress<'static> = &|_| {};

/// A narrower question, to enumerate sets in order of their cost.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Restriction {
    /// Objects that must not be moved.
    pub held: Vec<ObjectIndex>,
    /// Objects that must be moved.
    pub required: Vec<ObjectIndex>,
}

/// Memory limits. Past them the search takes longer and finds the same optimum.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Memory {
    /// The most words of 8 bytes for the open questions of a hitting set search. Past that, instances are forgotten and
    /// computed again.
    pub words: usize,
    /// The most literals of all clauses together. Past that MaxSAT stops, and hitting sets go on alone.
    pub literals: usize,
}

/// Some 32 MB and 100 MB. No generated scene has needed a tenth of either.
impl Default for Memory {
    fn default() -> Self {
        Self { words: 4_000_000, literals: 16_000_000 }
    }
}
