//! The independent checker: replays a stated answer on the scene with its own arithmetic.

use crate::budget::Budget;
use crate::plan::claim::Claim;
use crate::scene::Scene;

/// One thing that is wrong with a stated answer.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    /// What kind.
    pub code: FaultCode,
    /// The position of the relocation, from 0; `None` for the answer as a whole.
    pub step: Option<usize>,
    /// The id of the object concerned.
    pub object: Option<String>,
    /// One sentence with the figures.
    pub detail: String,
}

/// The kinds of fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FaultCode {
    /// An id names no object of the scene.
    UnknownObject,
}

/// What the checker found.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Report {
    /// Empty for an answer that holds.
    pub faults: Vec<Fault>,
    /// The greatest bound that the landmarks prove, as far as time allowed.
    pub proven_bound: usize,
    /// True if the budget ended before everything was checked.
    pub interrupted: bool,
}

/// Check a stated answer.
pub fn check(_scene: &Scene, _claim: &Claim, _budget: &Budget<'_>) -> Report {
    Report::default()
}
