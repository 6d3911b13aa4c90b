//! The computations that the service offers, and the problems and log lines of their failures.

use crate::wire::{PlanRequest, Problem, ProblemKind, SceneBody, SettingsBody};
use singulate_planner::budget::Budget;
use singulate_planner::check::{Report, Terms, check_on};
use singulate_planner::paper::{Judged, plan_by};
use singulate_planner::plan::{self, PlanError, SurveyEntry};
use singulate_planner::scene::Scene;
use singulate_planner::search::Progress;
use singulate_planner::statement::Statement;

/// The computations: by default the planner's; tests may replace them.
#[derive(Clone, Copy)]
pub struct Engine {
    /// Plan for a request.
    pub plan: fn(&PlanRequest, &Budget<'_>, Progress<'_>) -> Result<Judged, PlanError>,
    /// Survey every movable object as the target.
    pub survey: fn(&Scene, &Budget<'_>) -> Result<Vec<SurveyEntry>, PlanError>,
    /// Check a statement on these terms.
    pub check: fn(&Scene, &Statement, &Terms, &Budget<'_>) -> Report,
}

impl Default for Engine {
    fn default() -> Self {
        Self { plan: planned, survey: plan::survey, check: check_on }
    }
}

fn planned(request: &PlanRequest, budget: &Budget<'_>, progress: Progress<'_>) -> Result<Judged, PlanError> {
    plan_by(&request.methods, &request.scene, &request.settings, budget, progress)
}

impl Engine {
    /// Survey a request's scene.
    ///
    /// # Errors
    /// A problem if there is no answer.
    pub fn survey(&self, request: &PlanRequest, budget: &Budget<'_>) -> Result<Vec<SurveyEntry>, Problem> {
        (self.survey)(&request.scene, budget).map_err(|error| plan_failed(request, &error))
    }
}

/// The scene is too dense, or the planner failed; then logs all that is needed to reproduce it.
pub(super) fn plan_failed(request: &PlanRequest, error: &PlanError) -> Problem {
    let PlanError::Refused(report) = error else { return Problem::too_dense(error.to_string()) };
    let (scene, settings, methods) = (written(request), &request.settings, &request.methods);
    tracing::error!(%scene, ?settings, ?methods, faults = ?report.faults, "an answer failed its check");
    Problem::new(ProblemKind::CheckFailed, "the answer is withheld; the scene is in the log")
}

/// A computation panicked: logs all that is needed to reproduce it.
pub(super) fn panicked(request: &PlanRequest) -> Problem {
    let (scene, settings, methods) = (written(request), &request.settings, &request.methods);
    tracing::error!(%scene, ?settings, ?methods, "a computation panicked");
    Problem::new(ProblemKind::Internal, "the request could not be answered; the scene is in the log")
}

fn written(request: &PlanRequest) -> String {
    // The effective settings are logged; without this one the scene might be refused when it is read again.
    let scene = SceneBody::new(&request.scene, request.scene_id.as_deref());
    let stated = scene.settings.clone().unwrap_or_default();
    let settings = SettingsBody { overlap_tolerance: Some(request.overlap_tolerance), ..stated };
    serde_json::to_string(&SceneBody { settings: Some(settings), ..scene }).unwrap_or_default()
}
