//! What is asked, and what the search says.

use crate::scene::ObjectIndex;

/// Objects in an order in which each can be moved, after which the target can be grasped. The target is not among them.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Derivation {
    /// In order.
    pub order: Vec<ObjectIndex>,
}

/// What the search knows: a bound with its proof, and the best derivation so far.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct LeastSet {
    /// The shortest derivation known.
    pub derivation: Derivation,
    /// No derivation is shorter.
    pub bound: usize,
    /// As much of the bound as the landmarks prove. On a hard base that may be less: there the search knows more than it
    /// can show.
    pub shown: usize,
    /// Sets of which every derivation holds at least one member, sorted each; a least set that meets all of them has
    /// at least `shown` members. (Not so for a restricted question: there they hold only under the restriction.)
    pub landmarks: Vec<Vec<ObjectIndex>>,
}

/// How the search ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// Bound and derivation meet.
    Least(LeastSet),
    /// The target can't be derived.
    Underivable,
    /// The budget ended first; what is known so far, `None` if not even a derivation.
    Interrupted(Option<LeastSet>),
}

/// A narrower question, to enumerate sets in order of their size.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Restriction {
    /// Objects that must not be moved.
    pub held: Vec<ObjectIndex>,
    /// Objects that must be moved.
    pub required: Vec<ObjectIndex>,
}
