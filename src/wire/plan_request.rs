//! Planning requests, before and after validation.

use core::time::Duration;

use super::finding;
use super::limits::RequestLimits;
use super::path::Path;
use super::problem::WarningItem;
use super::reader::RequestFaults;
use super::settings::StatedSettings;
use singulate_planner::paper::Methods;
use singulate_planner::plan::Settings;
use singulate_planner::scene::{Scene, SceneDraft, SceneLimits};

/// A valid request.
#[derive(Debug, Clone)]
pub struct PlanRequest {
    /// The scene.
    pub scene: Scene,
    /// The caller's id for it.
    pub scene_id: Option<String>,
    /// The planning settings.
    pub settings: Settings,
    /// The methods to plan with.
    pub methods: Methods,
    /// How deep the scene's discs may overlap, m.
    pub overlap_tolerance: f64,
    /// The time limit, queuing included.
    pub time_limit: Duration,
    /// Warnings about the scene.
    pub warnings: Vec<WarningItem>,
}

impl AsRef<PlanRequest> for PlanRequest {
    fn as_ref(&self) -> &PlanRequest {
        self
    }
}

/// A parsed request whose scene is not validated.
pub(super) struct StatedRequest {
    pub(super) scene_id: Option<String>,
    pub(super) draft: SceneDraft,
    pub(super) settings: StatedSettings,
}

impl StatedRequest {
    /// Validate the request at `path`; `None` if it has a fault.
    pub(super) fn sound(self, path: &Path<'_>, limits: &RequestLimits) -> Option<PlanRequest> {
        let mut faults = RequestFaults::default();
        let request = self.checked(path, limits, &mut faults);
        faults.judge(request).ok()
    }

    pub(super) fn checked(
        self,
        path: &Path<'_>,
        limits: &RequestLimits,
        faults: &mut RequestFaults,
    ) -> Option<PlanRequest> {
        let Self { scene_id, draft, settings } = self;
        let overlap_tolerance = settings.overlap_tolerance(limits);
        match Scene::new(draft, &SceneLimits { overlap_tolerance, ..limits.scene }) {
            Ok((scene, warnings)) => {
                let warnings = warnings.iter().map(|warning| finding::item(path, warning)).collect();
                let (settings, methods, time_limit) = settings.on(scene.table(), limits, path, faults)?;
                Some(PlanRequest { scene, scene_id, settings, methods, overlap_tolerance, time_limit, warnings })
            }
            Err(findings) => {
                findings.iter().for_each(|fault| finding::note(path, fault, faults));
                None
            }
        }
    }
}
