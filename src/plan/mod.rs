//! From a scene to a checked answer.

mod answer;
pub mod check;
mod claim;
mod planner;
mod settings;
mod statement;

pub use crate::geometry::Grasp;
pub use crate::placement::{Objective, Relocation};
pub use answer::{Answer, Deadlock, LowerBound, Plan, Statistics, Unplanned, Verdict};
pub use claim::{Claim, ClaimedDeadlock, ClaimedGrasp, ClaimedRelocation, VerdictName};
pub use planner::{PlanError, SurveyEntry, SurveyVerdict, plan, survey};
pub use settings::Settings;
