//! Reads planning settings from JSON.

use core::time::Duration;

use super::code::ErrorCode;
use super::limits::RequestLimits;
use super::path::Path;
use super::reader::{FieldNames, Fields, JsonNode, RequestFaults};
use singulate_planner::paper::{GraspModelName, Methods, PlacementMethod, Raster, SearchMethod};
use singulate_planner::plan::{Objective, Settings};
use singulate_planner::scene::Table;

const SETTINGS: FieldNames =
    FieldNames::of(&["grasp_model", "search", "placement", "objective", "time_limit_ms", "overlap_tolerance"]);

/// The settings of a request, before its table is known.
#[derive(Debug, Clone, Copy)]
pub(super) struct StatedSettings {
    /// How deep discs may overlap, m; `None` if unreadable.
    overlap_tolerance: Option<f64>,
    /// The other settings; `None` if any is unreadable.
    planning: Option<StatedPlanning>,
}

#[derive(Debug, Clone, Copy)]
struct StatedPlanning {
    settings: Settings,
    methods: Methods,
    raster: bool,
    time_limit: Duration,
}

impl StatedSettings {
    /// The defaults.
    pub(super) fn absent(limits: &RequestLimits) -> Self {
        let planning = Some(StatedPlanning::absent(limits));
        Self { overlap_tolerance: Some(limits.scene.overlap_tolerance), planning }
    }

    pub(super) fn read(node: JsonNode<'_>, limits: &RequestLimits, faults: &mut RequestFaults) -> Self {
        let Some(fields) = node.fields(&SETTINGS, faults) else {
            return Self { overlap_tolerance: None, planning: None };
        };
        let (default, max) = (limits.scene.overlap_tolerance, limits.greatest_overlap_tolerance());
        let overlap_tolerance =
            fields.optional("overlap_tolerance", default, faults, |node, faults| node.ranged((0.0, max), faults));
        Self { overlap_tolerance, planning: StatedPlanning::read(fields, limits, faults) }
    }

    /// How deep discs may overlap, m. If it is unreadable, the greatest tolerance, so that no overlap is reported that
    /// a valid value could allow; the fault itself has been noted.
    pub(super) fn overlap_tolerance(&self, limits: &RequestLimits) -> f64 {
        self.overlap_tolerance.unwrap_or_else(|| limits.greatest_overlap_tolerance())
    }

    /// The settings for their table; `request` is the path of their request.
    pub(super) fn on(
        self,
        table: &Table,
        limits: &RequestLimits,
        request: &Path<'_>,
        faults: &mut RequestFaults,
    ) -> Option<(Settings, Methods, Duration)> {
        let StatedPlanning { settings, methods, raster, time_limit } = self.overlap_tolerance.and(self.planning)?;
        if !raster {
            return Some((settings, methods, time_limit));
        }
        match Raster::new(limits.raster_resolution, table) {
            Ok(raster) => {
                let methods = Methods { placement: PlacementMethod::Raster(raster), ..methods };
                Some((settings, methods, time_limit))
            }
            Err(too_fine) => {
                let settings = request.field("settings");
                faults.add(ErrorCode::TooFine, &settings.field("placement"), format_args!("{too_fine}"));
                None
            }
        }
    }
}

impl StatedPlanning {
    fn absent(limits: &RequestLimits) -> Self {
        let time_limit = limits.default_time_limit.min(limits.max_time_limit);
        Self { settings: Settings::default(), methods: Methods::default(), raster: false, time_limit }
    }

    fn read(fields: Fields<'_>, limits: &RequestLimits, faults: &mut RequestFaults) -> Option<Self> {
        let absent = Self::absent(limits);
        let grasp_models = [("swept_finger", GraspModelName::SweptFinger), ("sector", GraspModelName::Sector)];
        let grasp_model = fields.optional("grasp_model", absent.methods.grasp_model, faults, |node, faults| {
            node.word(&grasp_models, faults)
        });
        let searches = [
            ("landmarks", SearchMethod::Landmarks),
            ("lobs", SearchMethod::Lobs),
            ("forward_astar", SearchMethod::ForwardAstar),
        ];
        let search =
            fields.optional("search", absent.methods.search, faults, |node, faults| node.word(&searches, faults));
        let placements = [("exact", false), ("raster", true)];
        let raster = fields.optional("placement", absent.raster, faults, |node, faults| node.word(&placements, faults));
        let objectives = [("far_from_target", Objective::FarFromTarget), ("short_moves", Objective::ShortMoves)];
        let objective = fields
            .optional("objective", absent.settings.objective, faults, |node, faults| node.word(&objectives, faults));
        let max = u64::try_from(limits.max_time_limit.as_millis()).unwrap_or(u64::MAX);
        let time_limit = fields.optional("time_limit_ms", absent.time_limit, faults, |node, faults| {
            node.whole((1, max), faults).map(Duration::from_millis)
        });
        let settings = Settings { objective: objective? };
        let methods = Methods { grasp_model: grasp_model?, search: search?, placement: PlacementMethod::Exact };
        Some(Self { settings, methods, raster: raster?, time_limit: time_limit? })
    }
}
