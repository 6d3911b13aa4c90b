//! From a scene to a checked answer.

mod answer;
pub mod check;
mod claim;
mod confirm;
mod couple;
mod judge;
mod known;
mod planner;
mod settings;
mod sought;
mod statement;
mod survey;
mod verdicts;
mod warning;

pub use crate::geometry::Grasp;
pub use crate::placement::{Objective, Relocation};
pub use answer::{Answer, Deadlock, LowerBound, Plan, Statistics, Unplanned, Verdict};
pub use claim::{Claim, ClaimedDeadlock, ClaimedGrasp, ClaimedRelocation, VerdictName};
pub use confirm::PlanError;
pub use known::{Known, KnownOption, known};
pub use planner::{plan, plan_reporting};
pub use settings::{GraspModel, PlacementMethod, SearchMethod, Settings};
pub use sought::{SearchLimits, Sought, seek_within};
pub use survey::{SurveyEntry, SurveyVerdict, survey};
pub use warning::{Cause, Warning};
