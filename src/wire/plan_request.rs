//! Planning requests, before and after validation.

use core::time::Duration;

use super::code::ErrorCode;
use super::finding;
use super::limits::RequestLimits;
use super::path::Path;
use super::problem::WarningItem;
use super::reader::RequestFaults;
use super::settings::StatedSettings;
use singulate_planner::paper::Methods;
use singulate_planner::plan::Settings;
use singulate_planner::scene::{GoalDraft, ObjectDraft, Scene, SceneDraft, SceneLimits, ShapeDraft};

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
    /// How deep the scene's objects may overlap, m.
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
        if self.settings.asks_for_the_paper() {
            self.only_what_the_paper_knows(path, faults);
        }
        let Self { scene_id, draft, settings } = self;
        let draft = SceneDraft { destination: settings.destination(), ..draft };
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

    /// Reports each field that the paper's methods can't take into account; those of objects at the first that has them.
    fn only_what_the_paper_knows(&self, path: &Path<'_>, faults: &mut RequestFaults) {
        let (draft, gripper, settings) = (&self.draft, path.field("gripper"), path.field("settings"));
        let goal = draft.goal.as_ref().is_some_and(|goal| !matches!(goal, GoalDraft::Target(_)));
        let fields = [
            (goal, path.field("goal")),
            (draft.drop_offs.is_some(), path.field("drop_offs")),
            (draft.gripper.max_opening.is_some(), gripper.field("max_opening")),
            (draft.gripper.opening.is_some(), gripper.field("opening")),
            (draft.gripper.finger_length.is_some(), gripper.field("finger_length")),
            (draft.gripper.palm_radius.is_some(), gripper.field("palm_radius")),
            (draft.gripper.tip_height.is_some(), gripper.field("tip_height")),
            (self.settings.destination().is_some(), settings.field("destination")),
        ];
        fields.iter().filter(|(stated, _)| *stated).for_each(|(_, field)| discs_only(field, faults));
        let objects = path.field("objects");
        let of_objects: [(&str, Stated); 4] = [
            ("yaw", |object| object.yaw.is_some()),
            ("shape", |object| !matches!(object.shape, ShapeDraft::Radius(_) | ShapeDraft::Unread)),
            ("height", |object| object.height.is_some()),
            ("grasps", |object| object.grasps.is_some()),
        ];
        for (name, stated) in of_objects {
            if let Some(first) = draft.objects.iter().position(stated) {
                discs_only(&objects.item(first).field(name), faults);
            }
        }
    }
}

/// Whether a field of an object is stated.
type Stated = fn(&ObjectDraft) -> bool;

fn discs_only(field: &Path<'_>, faults: &mut RequestFaults) {
    let detail = format_args!(
        "the paper's methods know only discs that are moved on the table for one target: leave this out, or \
         'grasp_model', 'search' and 'placement'"
    );
    faults.add(ErrorCode::DiscsOnly, field, detail);
}
