//! Planning settings as JSON: their schema, and how they are read.

use core::time::Duration;

use serde::Serialize;
use utoipa::ToSchema;

use super::code::ErrorCode;
use super::limits::RequestLimits;
use super::path::Path;
use super::reader::{FieldNames, Fields, JsonNode, RequestFaults};
use crate::experiments::Repositioning;
use singulate_planner::paper::{GraspModelName, Methods, PlacementMethod, Raster, SearchMethod};
use singulate_planner::plan::{Objective, Settings};
use singulate_planner::scene::{Destination, Scene, Table};

const SETTINGS: FieldNames = FieldNames::of(&[
    "grasp_model",
    "search",
    "placement",
    "objective",
    "destination",
    "time_limit_ms",
    "overlap_tolerance",
]);

/// How to plan. Each field may be absent.
#[derive(Debug, Clone, Default, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct SettingsBody {
    /// Which yaws an obstacle blocks. Default: `swept_finger`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grasp_model: Option<GraspModelWord>,
    /// How the least set of relocations is found. Default: `landmarks`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub search: Option<SearchWord>,
    /// How new places are found. Default: `exact`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub placement: Option<PlacementWord>,
    /// Which of the free places a relocated object goes to. Default: `far_from_target`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub objective: Option<ObjectiveWord>,
    /// Where objects go that have to move. Default: `table` without drop-offs, `table_then_drop_off` with them. `clear` takes all
    /// to drop-offs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub destination: Option<DestinationWord>,
    /// The time for waiting, planning and checking, from the arrival of the request, ms. Default: 1000.
    #[schema(minimum = 1, maximum = 60000, example = 1000)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time_limit_ms: Option<u32>,
    /// How deep two objects may overlap and still pass as perception noise, m. Default: 0.001. At most 0.01 unless the
    /// operator allows more.
    #[schema(minimum = 0, maximum = 0.01, example = 0.003)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub overlap_tolerance: Option<f64>,
}

/// Where objects go that have to move.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(example = "table_then_drop_off")]
pub enum DestinationWord {
    /// To another place on the table.
    Table,
    /// To a drop-off. What none accepts is as if fixed.
    DropOff,
    /// To another place on the table; to a drop-off only what finds none.
    TableThenDropOff,
}

/// Which yaws an obstacle blocks.
#[derive(Debug, Clone, Copy, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(example = "swept_finger")]
pub enum GraspModelWord {
    /// The exact area that an open finger covers.
    SweptFinger,
    /// The paper's polar histogram (Eq. 1-4, 8-10): wider than the fingers, so that it calls graspable objects blocked.
    Sector,
}

/// How the least set of relocations is found.
#[derive(Debug, Clone, Copy, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(example = "landmarks")]
pub enum SearchWord {
    /// Minimal landmarks and least hitting sets: exact, with a proof.
    Landmarks,
    /// The paper's Algorithm 1, read literally: may call a deadlock what is none, and may move more than is needed.
    Lobs,
    /// The paper's baseline, A* forward from what is graspable: exact, slow.
    ForwardAstar,
}

/// How new places are found.
#[derive(Debug, Clone, Copy, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(example = "exact")]
pub enum PlacementWord {
    /// Candidates in the continuum.
    Exact,
    /// The paper's: section IV.C with Eq. 7 on an image of the table; releases are not checked.
    Raster,
}

/// Which of the free places a relocated object goes to.
#[derive(Debug, Clone, Copy, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(example = "far_from_target")]
pub enum ObjectiveWord {
    /// As far from the target as possible.
    FarFromTarget,
    /// As near to its old place as possible.
    ShortMoves,
}

impl DestinationWord {
    /// The scene's destination, unless it is the default.
    pub(super) fn stated(scene: &Scene) -> Option<Self> {
        match scene.destination() {
            Destination::Table if scene.drop_offs().is_empty() => None,
            Destination::TableThenDropOff if !scene.drop_offs().is_empty() => None,
            Destination::Table => Some(Self::Table),
            Destination::DropOff => Some(Self::DropOff),
            Destination::TableThenDropOff => Some(Self::TableThenDropOff),
        }
    }
}

impl From<GraspModelName> for GraspModelWord {
    fn from(model: GraspModelName) -> Self {
        match model {
            GraspModelName::SweptFinger => Self::SweptFinger,
            GraspModelName::Sector => Self::Sector,
        }
    }
}

impl From<SearchMethod> for SearchWord {
    fn from(method: SearchMethod) -> Self {
        match method {
            SearchMethod::Landmarks => Self::Landmarks,
            SearchMethod::Lobs => Self::Lobs,
            SearchMethod::ForwardAstar => Self::ForwardAstar,
        }
    }
}

impl From<Repositioning> for PlacementWord {
    fn from(repositioning: Repositioning) -> Self {
        match repositioning {
            Repositioning::Raster => Self::Raster,
            Repositioning::Exact => Self::Exact,
        }
    }
}

/// The settings of a request, before its table is known.
#[derive(Debug, Clone, Copy)]
pub(super) struct StatedSettings {
    /// How deep objects may overlap, m; `None` if unreadable.
    overlap_tolerance: Option<f64>,
    /// `None` also if it is unreadable.
    destination: Option<Destination>,
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
        Self { overlap_tolerance: Some(limits.scene.overlap_tolerance), destination: None, planning }
    }

    pub(super) fn read(node: JsonNode<'_>, limits: &RequestLimits, faults: &mut RequestFaults) -> Self {
        let Some(fields) = node.fields(&SETTINGS, faults) else {
            return Self { overlap_tolerance: None, destination: None, planning: None };
        };
        let (default, max) = (limits.scene.overlap_tolerance, limits.greatest_overlap_tolerance());
        let overlap_tolerance =
            fields.optional("overlap_tolerance", default, faults, |node, faults| node.ranged((0.0, max), faults));
        let destinations = [
            ("table", Destination::Table),
            ("drop_off", Destination::DropOff),
            ("table_then_drop_off", Destination::TableThenDropOff),
        ];
        let destination = fields.stated("destination", faults, |node, faults| node.word(&destinations, faults));
        Self { overlap_tolerance, destination, planning: StatedPlanning::read(fields, limits, faults) }
    }

    /// Where objects go that have to move, if the caller says so.
    pub(super) fn destination(&self) -> Option<Destination> {
        self.destination
    }

    /// True if a method of the paper is asked for.
    pub(super) fn asks_for_the_paper(&self) -> bool {
        self.planning.is_some_and(|planning| planning.raster || !planning.methods.proven())
    }

    /// How deep objects may overlap, m. If it is unreadable, the greatest tolerance, so that no overlap is reported that
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
