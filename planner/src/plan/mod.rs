//! From a scene to a checked answer.

mod answer;
mod attempt;
mod choice;
mod clearing;
mod confirm;
mod couple;
mod planner;
mod reasons;
mod settings;
mod shares;
mod stated;
mod survey;

pub use crate::placement::Objective;
pub use answer::{Answer, Statistics};
pub use confirm::PlanError;
pub use planner::{nothing_in_time, plan};
pub use settings::Settings;
pub use survey::{SurveyEntry, SurveyVerdict, survey};

// What the paper's own planner shares with this one: the parts of the main loop.
pub(crate) use answer::timed;
pub(crate) use attempt::Question;
pub(crate) use confirm::confirmed_part;
pub(crate) use couple::{arrange_least, arrange_one};
pub(crate) use planner::placed;
pub(crate) use reasons::{graspable_now, prove_deadlock};
pub(crate) use shares::{PLACEMENT_SHARE, SEARCH_SHARE};
pub(crate) use stated::ids;
