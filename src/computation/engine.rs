//! The computations that the service offers, and what it says where one of them fails.

use crate::traces::PlanSpan;
use crate::wire::{PlanRequest, Problem, ProblemKind, SceneBody, SettingsBody};
use singulate_planner::budget::Budget;
use singulate_planner::plan::check::{self, Report};
use singulate_planner::plan::{self, Answer, Claim, PlanError, Settings, SurveyEntry};
use singulate_planner::scene::Scene;
use singulate_planner::search::Progress;

/// The computations. The default is the planner; a test may stand in another.
#[derive(Clone, Copy)]
pub struct Engine {
    /// Plan for the scene's target.
    pub plan: fn(&Scene, &Settings, &Budget<'_>, Progress<'_>) -> Result<Answer, PlanError>,
    /// Every movable object as the target.
    pub survey: fn(&Scene, &Budget<'_>) -> Result<Vec<SurveyEntry>, PlanError>,
    /// Check a stated answer.
    pub check: fn(&Scene, &Claim, &Budget<'_>) -> Report,
}

impl Default for Engine {
    fn default() -> Self {
        Self { plan: plan::plan_reporting, survey: plan::survey, check: check::check }
    }
}

impl Engine {
    /// Plan for a request.
    ///
    /// # Errors
    /// A problem where there is no answer.
    pub fn answer(
        &self,
        request: &PlanRequest,
        budget: &Budget<'_>,
        progress: Progress<'_>,
    ) -> Result<Answer, Problem> {
        let span = PlanSpan::begin();
        let answer = (self.plan)(&request.scene, &request.settings, budget, progress);
        if let (Some(span), Ok(answer)) = (&span, &answer) {
            span.answered(answer);
        }
        answer.map_err(|error| plan_failed(request, &error))
    }

    /// Survey a request's scene.
    ///
    /// # Errors
    /// A problem where there is no answer.
    pub fn survey(&self, request: &PlanRequest, budget: &Budget<'_>) -> Result<Vec<SurveyEntry>, Problem> {
        (self.survey)(&request.scene, budget).map_err(|error| plan_failed(request, &error))
    }
}

/// There is no answer: the scene is too dense, or the planner failed; then log all that is needed to see it fail again.
fn plan_failed(request: &PlanRequest, error: &PlanError) -> Problem {
    let PlanError::Refused(report) = error else { return Problem::too_dense(error.to_string()) };
    let (scene, settings) = (written(request), &request.settings);
    tracing::error!(%scene, ?settings, faults = ?report.faults, "an answer failed its check");
    Problem::new(ProblemKind::CheckFailed, "the answer is withheld; the scene is in the log")
}

/// A computation panicked: log all that is needed to see it panic again.
pub(super) fn panicked(request: &PlanRequest) -> Problem {
    let (scene, settings) = (written(request), &request.settings);
    tracing::error!(%scene, ?settings, "a computation panicked");
    Problem::new(ProblemKind::Internal, "the request could not be answered; the scene is in the log")
}

fn written(request: &PlanRequest) -> String {
    // The settings are logged as they are understood; without this one the scene might not be read again.
    let settings = SettingsBody { overlap_tolerance: Some(request.overlap_tolerance), ..SettingsBody::default() };
    let scene = SceneBody::new(&request.scene, request.scene_id.as_deref());
    serde_json::to_string(&SceneBody { settings: Some(settings), ..scene }).unwrap_or_default()
}
