//! From a scene to a checked answer.

mod answer;
pub mod check;
mod claim;
mod planner;
mod settings;

pub use crate::geometry::Grasp;
pub use answer::{Answer, Deadlock, LowerBound, Plan, Relocation, Statistics, Unplanned, Verdict};
pub use claim::{Claim, ClaimedDeadlock, ClaimedGrasp, ClaimedRelocation, VerdictName};
pub use planner::{PlanError, SurveyEntry, SurveyVerdict, plan, survey};
pub use settings::{Objective, Settings};
