//! Planning calls: read a body, compute the answer, and respond if time runs out first. [`Planning`] does this for
//! every [`Computation`] alike; [`calls`] lists them.

pub mod calls;
mod engine;
mod planning;
mod problem;
mod reading;

use std::sync::Arc;

use serde::Serialize;

pub use engine::Engine;
use engine::plan_failed;
pub use planning::{Planning, note_scene};
pub use problem::internal;
pub use reading::KnownRequest;

use crate::metrics::Metrics;
use crate::traces::PlanSpan;
use crate::wire::{PlanRequest, Problem, RequestLimits};
use singulate_planner::budget::Budget;
use singulate_planner::paper::Judged;
use singulate_planner::search::Progress;

/// A kind of planning call. Its value holds the form of the answer, if there is a choice.
pub trait Computation: Copy + Send + Sync + 'static {
    /// A body after reading.
    type Request: AsRef<PlanRequest> + Send + Sync + 'static;

    /// Read a body.
    ///
    /// # Errors
    /// A problem with every fault of the body.
    fn read(body: &[u8], limits: &RequestLimits) -> Result<Self::Request, Problem>;

    /// The answer, computed on a thread of the pool.
    ///
    /// # Errors
    /// A problem if there is no answer.
    fn compute(self, tools: &Tools, request: &Self::Request, budget: &Budget<'_>) -> Served;

    /// The answer if the time limit came first.
    ///
    /// # Errors
    /// A problem if there is none.
    fn too_late(self, known: KnownRequest<'_, Self::Request>) -> Served;
}

/// The tools of a computation besides its request.
#[derive(Clone)]
pub struct Tools {
    /// The computations.
    pub engine: Engine,
    /// The metrics of answers.
    pub metrics: Arc<Metrics>,
}

impl Tools {
    /// Plan for a request, traced and measured.
    ///
    /// # Errors
    /// A problem if there is no answer.
    pub fn answer(
        &self,
        request: &PlanRequest,
        budget: &Budget<'_>,
        progress: Progress<'_>,
    ) -> Result<Judged, Problem> {
        let span = PlanSpan::begin();
        let judged = (self.engine.plan)(request, budget, progress).map_err(|error| plan_failed(request, &error))?;
        span.iter().for_each(|span| span.answered(&judged.answer));
        self.metrics.planned(&judged.answer);
        Ok(judged)
    }
}

/// An answer's bytes.
pub type Served = Result<Vec<u8>, Problem>;

/// The form in which an answer is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// As data.
    Json,
    /// As a drawing.
    Svg,
}

impl Form {
    /// The form's media type.
    pub fn media_type(self) -> &'static str {
        match self {
            Self::Json => "application/json",
            Self::Svg => "image/svg+xml",
        }
    }
}

/// An answer as JSON.
fn json(body: &impl Serialize) -> Served {
    serde_json::to_vec(body).map_err(|error| {
        tracing::error!(%error, "an answer could not be written");
        internal()
    })
}
