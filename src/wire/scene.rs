//! A scene as JSON: schema and serialisation. The numbers in the descriptions are literals, since the derive accepts no
//! constants; a test compares them with the constants of `scene`.

#![expect(clippy::approx_constant, reason = "the derive takes no constants, and so no PI")]

use serde::Serialize;
use utoipa::ToSchema;

use super::object::ObjectBody;
use crate::experiments::Repositioning;
use singulate_planner::paper::{GraspModelName, SearchMethod};
use singulate_planner::scene::{Gripper, Rectangle, Scene};

/// A scene and how to plan for it: the body of a planning request.
#[derive(Debug, Clone, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(example = json!({
    "scene_id": "cell-4/17",
    "table": {"x_min": 0, "y_min": 0, "x_max": 0.8, "y_max": 0.5},
    "gripper": {"fingers": 3, "finger_width": 0.02, "clearance": 0.05},
    "objects": [
        {"id": "cup", "x": 0.4, "y": 0.25, "radius": 0.04},
        {"id": "plate-1", "x": 0.5, "y": 0.29, "radius": 0.06},
        {"id": "plate-2", "x": 0.4, "y": 0.36, "radius": 0.06},
        {"id": "plate-3", "x": 0.31, "y": 0.2, "radius": 0.06},
        {"id": "vase", "x": 0.44, "y": 0.16, "radius": 0.05, "fixed": true}
    ],
    "target": "cup",
    "settings": {"objective": "far_from_target", "time_limit_ms": 1000}
}))]
pub struct SceneBody {
    /// The caller's name for the scene. It comes back in the answer, and is logged.
    #[schema(max_length = 256, example = "cell-4/17")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scene_id: Option<String>,
    /// The table.
    pub table: TableBody,
    /// The gripper.
    pub gripper: GripperBody,
    /// The objects on the table, target included.
    #[schema(min_items = 1, max_items = 10000, example = json!([
        {"id": "plate-1", "x": 0.31, "y": 0.22, "radius": 0.075},
        {"id": "vase", "x": 0.9, "y": 0.5, "radius": 0.05, "fixed": true}
    ]))]
    pub objects: Vec<ObjectBody>,
    /// The id of the object to grasp. It must not be fixed.
    #[schema(min_length = 1, max_length = 128, example = "plate-1")]
    pub target: String,
    /// How to plan.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub settings: Option<SettingsBody>,
}

/// The table top, an axis-parallel rectangle.
#[derive(Debug, Clone, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct TableBody {
    /// Left side, m.
    #[schema(minimum = -100000, maximum = 100000, example = 0.0)]
    pub x_min: f64,
    /// Lower side, m.
    #[schema(minimum = -100000, maximum = 100000, example = 0.0)]
    pub y_min: f64,
    /// Right side, m; above `x_min`.
    #[schema(minimum = -100000, maximum = 100000, example = 1.2)]
    pub x_max: f64,
    /// Upper side, m; above `y_min`.
    #[schema(minimum = -100000, maximum = 100000, example = 0.7)]
    pub y_max: f64,
    /// Rectangles where nothing may be placed. Fingers may pass over them. Default: none.
    #[schema(example = json!([{"x_min": 0, "y_min": 0, "x_max": 0.2, "y_max": 0.1}]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub keep_out: Option<Vec<RectangleBody>>,
}

/// An axis-parallel rectangle.
#[derive(Debug, Clone, Copy, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct RectangleBody {
    /// Left side, m.
    #[schema(minimum = -100000, maximum = 100000, example = 0.0)]
    pub x_min: f64,
    /// Lower side, m.
    #[schema(minimum = -100000, maximum = 100000, example = 0.0)]
    pub y_min: f64,
    /// Right side, m; above `x_min`.
    #[schema(minimum = -100000, maximum = 100000, example = 0.2)]
    pub x_max: f64,
    /// Upper side, m; above `y_min`.
    #[schema(minimum = -100000, maximum = 100000, example = 0.1)]
    pub y_max: f64,
}

/// An overhead gripper with evenly spaced fingers.
#[derive(Debug, Clone, Copy, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct GripperBody {
    /// The number of fingers.
    #[schema(minimum = 2, maximum = 12, example = 3)]
    pub fingers: u32,
    /// The width of a finger across its radial direction, m.
    #[schema(minimum = 0.000001, maximum = 1000, example = 0.02)]
    pub finger_width: f64,
    /// How far beyond the object's edge an open finger reaches, m.
    #[schema(minimum = 0.000001, maximum = 1000, example = 0.05)]
    pub clearance: f64,
    /// Extra gap between fingers and obstacles, and between a new place and other objects, m. Default: 0.
    #[schema(minimum = 0, maximum = 1000, example = 0.0)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub margin: Option<f64>,
    /// How far the real yaw may be off the planned one, rad. Default: 0.
    #[schema(minimum = 0, maximum = 3.141592653589793, example = 0.0)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub yaw_tolerance: Option<f64>,
}

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
    /// The time for waiting, planning and checking, from the arrival of the request, ms. Default: 1000.
    #[schema(minimum = 1, maximum = 60000, example = 1000)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time_limit_ms: Option<u32>,
    /// How deep two discs may overlap and still pass as perception noise, m. Default: 0.001. At most 0.01 unless the
    /// operator allows more.
    #[schema(minimum = 0, maximum = 0.01, example = 0.003)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub overlap_tolerance: Option<f64>,
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

impl SceneBody {
    /// A scene for serialisation, with default settings.
    pub fn new(scene: &Scene, scene_id: Option<&str>) -> Self {
        let corners = RectangleBody::new(scene.table().top());
        let keep_out: Vec<_> = scene.table().keep_out().iter().copied().map(RectangleBody::new).collect();
        let RectangleBody { x_min, y_min, x_max, y_max } = corners;
        Self {
            scene_id: scene_id.map(str::to_owned),
            table: TableBody { x_min, y_min, x_max, y_max, keep_out: (!keep_out.is_empty()).then_some(keep_out) },
            gripper: GripperBody::new(scene.gripper()),
            objects: scene.objects().iter().map(ObjectBody::new).collect(),
            target: scene.object(scene.target()).id().to_owned(),
            settings: None,
        }
    }
}

impl RectangleBody {
    fn new(rectangle: Rectangle) -> Self {
        let (min, max) = (rectangle.min(), rectangle.max());
        Self { x_min: min.x, y_min: min.y, x_max: max.x, y_max: max.y }
    }
}

impl GripperBody {
    fn new(gripper: &Gripper) -> Self {
        Self {
            fingers: gripper.fingers(),
            finger_width: gripper.finger_width(),
            clearance: gripper.clearance(),
            margin: Some(gripper.margin()),
            yaw_tolerance: Some(gripper.yaw_tolerance()),
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
