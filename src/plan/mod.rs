//! From a scene to a checked answer.

mod answer;
pub mod check;
mod claim;
mod confirm;
mod couple;
mod planner;
mod settings;
mod statement;
mod survey;

pub use crate::geometry::Grasp;
pub use crate::placement::{Objective, Relocation};
pub use answer::{Answer, Deadlock, LowerBound, Plan, Statistics, Unplanned, Verdict};
pub use claim::{Claim, ClaimedDeadlock, ClaimedGrasp, ClaimedRelocation, VerdictName};
pub use confirm::PlanError;
pub use planner::plan;
pub use settings::Settings;
pub use survey::{SurveyEntry, SurveyVerdict, survey};
