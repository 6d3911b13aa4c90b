//! The grasps that are listed for an object, as JSON: their schema, how they are written, and how they are read.

#![expect(clippy::approx_constant, reason = "the derive takes no constants, and so no π/2")]

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::reader::{FieldNames, JsonNode, RequestFaults};
use super::strict::Object;
use singulate_planner::scene::{GraspDraft, ListedGrasp};

/// One way to grasp an object, in the object's own frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(example = json!({"x": 0, "y": 0, "yaw": 1.57, "tolerance": 0.05}))]
pub struct ListedGraspBody {
    /// The gripper's axis along x of the object's frame, m. Default: 0.
    #[schema(minimum = -1000, maximum = 1000, example = 0.0)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x: Option<f64>,
    /// The gripper's axis along y of the object's frame, m. Default: 0.
    #[schema(minimum = -1000, maximum = 1000, example = 0.0)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y: Option<f64>,
    /// The direction of finger 0, rad, counter-clockwise from x of the object's frame.
    #[schema(minimum = -1000, maximum = 1000, example = 1.57)]
    pub yaw: f64,
    /// How far the real yaw may be off, rad; below π/k. All of this band must be free, or that of `yaw_tolerance` where it is wider.
    /// Default: 0.05.
    #[schema(minimum = 0, maximum = 1.5707963267948966, example = 0.05)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
}

/// The fields of a sound grasp, read straight from its text.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GraspFields {
    x: Option<f64>,
    y: Option<f64>,
    yaw: f64,
    tolerance: Option<f64>,
}

impl ListedGraspBody {
    pub(super) fn new(grasp: &ListedGrasp) -> Self {
        let at = grasp.at();
        Self { x: Some(at.x), y: Some(at.y), yaw: grasp.yaw(), tolerance: Some(grasp.tolerance()) }
    }
}

impl From<Object<GraspFields>> for GraspDraft {
    fn from(Object(GraspFields { x, y, yaw, tolerance }): Object<GraspFields>) -> Self {
        Self { x, y, yaw: Some(yaw), tolerance }
    }
}

const GRASP: FieldNames = FieldNames::of(&["x", "y", "yaw", "tolerance"]);

/// Read through a JSON value, with every fault.
pub(super) fn read(node: JsonNode<'_>, faults: &mut RequestFaults) -> Option<GraspDraft> {
    let fields = node.fields(&GRASP, faults)?;
    let mut stated = |name| fields.optional(name, None, faults, |node, faults| node.number(faults).map(Some));
    let (x, y, tolerance) = (stated("x"), stated("y"), stated("tolerance"));
    let readable = x.is_some() && y.is_some() && tolerance.is_some();
    // Where one can't be read, its default would be another grasp.
    let yaw = fields.number("yaw", faults).filter(|_| readable);
    Some(GraspDraft { x: x.flatten(), y: y.flatten(), yaw, tolerance: tolerance.flatten() })
}
