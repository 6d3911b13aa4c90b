//! Every operation in the interface document, with the access that it needs.

use std::sync::Arc;

use axum::extract::FromRef;
use utoipa_axum::router::UtoipaMethodRouter;
use utoipa_axum::routes;

use super::access::Need;
use super::docs::{self, DocumentText};
use super::jobs::{self, JobCalls};
use super::planning::{self, PlanningCalls};
use super::probes;
use super::running::Running;
use crate::keys::Scope;

const PLAN: Need = Need::OneOf(&[Scope::Plan]);
const JOBS: Need = Need::OneOf(&[Scope::Jobs]);
const READ_JOBS: Need = Need::OneOf(&[Scope::ReadOnly, Scope::Jobs]);
const METRICS: Need = Need::OneOf(&[Scope::Metrics]);

/// The state of the operations. Each extracts the part that it needs.
#[derive(Clone)]
pub(super) struct Parts {
    pub(super) planning: Arc<PlanningCalls>,
    pub(super) jobs: Arc<JobCalls>,
    pub(super) running: Arc<Running>,
    pub(super) document: DocumentText,
}

impl FromRef<Parts> for Arc<PlanningCalls> {
    fn from_ref(parts: &Parts) -> Self {
        Self::clone(&parts.planning)
    }
}

impl FromRef<Parts> for Arc<JobCalls> {
    fn from_ref(parts: &Parts) -> Self {
        Self::clone(&parts.jobs)
    }
}

impl FromRef<Parts> for Arc<Running> {
    fn from_ref(parts: &Parts) -> Self {
        Self::clone(&parts.running)
    }
}

impl FromRef<Parts> for DocumentText {
    fn from_ref(parts: &Parts) -> Self {
        parts.document
    }
}

/// The operations, in the order of the document.
pub(super) fn operations() -> [(Need, UtoipaMethodRouter<Parts>); 16] {
    [
        (PLAN, routes!(planning::plan)),
        (PLAN, routes!(planning::verify)),
        (PLAN, routes!(planning::survey)),
        (PLAN, routes!(planning::knowledge)),
        (JOBS, routes!(jobs::submit)),
        (READ_JOBS, routes!(jobs::list)),
        (JOBS, routes!(jobs::batch)),
        (READ_JOBS, routes!(jobs::show)),
        (JOBS, routes!(jobs::forget)),
        (READ_JOBS, routes!(jobs::events)),
        (JOBS, routes!(jobs::cancel)),
        (Need::Nothing, routes!(probes::livez)),
        (Need::Nothing, routes!(probes::readyz)),
        (Need::AnyKey, routes!(probes::version)),
        (METRICS, routes!(probes::metrics)),
        (Need::Nothing, routes!(docs::document)),
    ]
}
