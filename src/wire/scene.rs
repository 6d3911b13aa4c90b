//! A scene as JSON: schema and serialisation. The numbers in the descriptions are literals, since the derive accepts no
//! constants; a test compares them with the constants of `scene`.

#![expect(clippy::approx_constant, reason = "the derive takes no constants, and so no PI")]

use serde::Serialize;
use utoipa::ToSchema;

use super::drop_off::DropOffBody;
use super::goal::GoalBody;
use super::object::ObjectBody;
use super::settings::{DestinationWord, SettingsBody};
use singulate_planner::scene::{Gripper, Opening, Rectangle, Scene};

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
    /// The objects on the table, target included. A table that is cleared may be empty.
    #[schema(max_items = 10000, example = json!([
        {"id": "plate-1", "x": 0.31, "y": 0.22, "radius": 0.075},
        {"id": "vase", "x": 0.9, "y": 0.5, "radius": 0.05, "height": 0.3, "fixed": true},
        {"id": "tray", "x": 0.7, "y": 0.2, "yaw": 0.3, "height": 0.03,
            "shape": {"kind": "rectangle", "length": 0.4, "width": 0.3, "corner_radius": 0.02},
            "grasps": [{"x": 0.18, "y": 0, "yaw": 0, "tolerance": 0.1}]},
        {"id": "knife", "x": 0.43, "y": 0.22, "yaw": 1.57, "shape": {"kind": "capsule", "length": 0.2, "radius": 0.01}}
    ]))]
    pub objects: Vec<ObjectBody>,
    /// The id of the object to grasp. It must not be fixed. Either this or `goal` is required.
    #[schema(min_length = 1, max_length = 128, example = "plate-1")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub target: Option<String>,
    /// What is wanted, where it is not one object. Either this or `target` is required.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub goal: Option<GoalBody>,
    /// Places off the table, to which objects can be taken away. Default: none.
    #[schema(max_items = 1000, example = json!([{"id": "tray", "capacity": 4, "accepts": ["plate-1"]}]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drop_offs: Option<Vec<DropOffBody>>,
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
    /// The distance between the inner faces of two open jaws, m; for more fingers twice their distance from the gripper's axis.
    /// A wider object can't be grasped. Default: unlimited.
    #[schema(minimum = 0.000001, maximum = 1000, example = 0.14)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_opening: Option<f64>,
    /// How far the fingers open before a grasp and after a release. Default: `fit`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub opening: Option<OpeningWord>,
    /// From the fingertips to the palm, m. Either both this and `palm_radius` are there, or neither: then nothing can meet the palm.
    #[schema(minimum = 0.000001, maximum = 1000, example = 0.12)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub finger_length: Option<f64>,
    /// The radius of a disc round the gripper's axis that covers the palm, m.
    #[schema(minimum = 0.000001, maximum = 1000, example = 0.06)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub palm_radius: Option<f64>,
    /// How high over the table the fingertips are at a grasp or release, m; higher only where the palm would meet the object that is
    /// held. Default: 0.
    #[schema(minimum = 0, maximum = 1000, example = 0.01)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tip_height: Option<f64>,
}

/// How far the fingers open.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(example = "fit")]
pub enum OpeningWord {
    /// To `clearance` beyond the object's edge.
    Fit,
    /// All the way, whatever the object: to `max_opening` / 2 + `clearance` from the axis. `max_opening` is required.
    Full,
}

/// How far the fingers open, by name.
pub(super) const OPENINGS: [(&str, Opening); 2] = [("fit", Opening::Fit), ("full", Opening::Full)];

impl SceneBody {
    /// A scene for serialisation, with default settings but for the destination.
    pub fn new(scene: &Scene, scene_id: Option<&str>) -> Self {
        let corners = RectangleBody::new(scene.table().top());
        let keep_out: Vec<_> = scene.table().keep_out().iter().copied().map(RectangleBody::new).collect();
        let RectangleBody { x_min, y_min, x_max, y_max } = corners;
        let (target, goal) = GoalBody::of(scene);
        let drop_offs: Vec<_> = scene.drop_offs().iter().map(|drop_off| DropOffBody::new(scene, drop_off)).collect();
        let destination = DestinationWord::stated(scene);
        Self {
            scene_id: scene_id.map(str::to_owned),
            table: TableBody { x_min, y_min, x_max, y_max, keep_out: (!keep_out.is_empty()).then_some(keep_out) },
            gripper: GripperBody::new(scene.gripper()),
            objects: scene.objects().iter().map(ObjectBody::new).collect(),
            target,
            goal,
            drop_offs: (!drop_offs.is_empty()).then_some(drop_offs),
            settings: destination.map(|word| SettingsBody { destination: Some(word), ..SettingsBody::default() }),
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
            max_opening: gripper.max_opening(),
            opening: (gripper.opening() == Opening::Full).then_some(OpeningWord::Full),
            finger_length: gripper.palm().map(|palm| palm.finger_length),
            palm_radius: gripper.palm().map(|palm| palm.radius),
            tip_height: (gripper.tip_height() > 0.0).then(|| gripper.tip_height()),
        }
    }
}
