//! A step of a plan as JSON: its schemas as served, and how it is written.

use serde::Serialize;
use utoipa::ToSchema;

use singulate_planner::statement::{PickDrop, PickPlace, StatedGrasp, StatedPose, Step};

/// One step of a plan. A client must refuse an action that it doesn't know.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
#[serde(untagged)]
pub enum StepBody<'a> {
    /// To another place on the table.
    PickPlace(PickPlaceBody<'a>),
    /// To a drop-off.
    PickDrop(PickDropBody<'a>),
}

/// Pick an object up and place it elsewhere on the table.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct PickPlaceBody<'a> {
    /// The kind of step.
    pub action: PickPlaceWord,
    /// The id of the object that is moved.
    #[schema(example = "plate-2")]
    pub object: &'a str,
    /// Where the object's own frame stands before the move; of a disc its centre.
    #[schema(value_type = PoseBody, required = true)]
    pub from: Option<PoseBody>,
    /// Where the object's own frame stands after the move.
    pub to: PoseBody,
    /// The grasp at the old place.
    pub grasp: GraspBody,
    /// How the gripper stands when the object is let go at the new place. An object with listed grasps is held as it was grasped.
    pub release: GraspBody,
    /// How far the object, and the gripper with it, turns on the way, rad, counter-clockwise, in (-π, π]. Absent for a disc that may
    /// be grasped at every yaw.
    #[schema(value_type = f64, required = false, example = 1.57)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turn: Option<f64>,
    /// Least distance to another object at the new place, edge to edge, m.
    #[schema(value_type = f64, required = true, example = 0.031)]
    pub gap: Option<f64>,
}

/// Pick an object up and take it away to a drop-off.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct PickDropBody<'a> {
    /// The kind of step.
    pub action: PickDropWord,
    /// The id of the object that is taken away.
    #[schema(example = "plate-1")]
    pub object: &'a str,
    /// Where the object's own frame stands before it is taken away; of a disc its centre.
    #[schema(value_type = PoseBody, required = true)]
    pub from: Option<PoseBody>,
    /// The grasp there.
    pub grasp: GraspBody,
    /// The id of the drop-off that it is taken to.
    #[schema(example = "tray")]
    pub drop_off: &'a str,
}

/// The action of a step to another place on the table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(example = "pick_place")]
pub enum PickPlaceWord {
    /// Pick an object up and place it elsewhere.
    PickPlace,
}

/// The action of a step to a drop-off.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(example = "pick_drop")]
pub enum PickDropWord {
    /// Pick an object up and take it away.
    PickDrop,
}

/// Where an object stands: its own frame, or the centre of a disc.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, ToSchema)]
pub struct PoseBody {
    /// The frame's origin along the table's x, m.
    #[schema(example = 0.4)]
    pub x: f64,
    /// The frame's origin along the table's y, m.
    #[schema(example = 0.2)]
    pub y: f64,
    /// How far the frame is turned, rad, counter-clockwise. Absent for a disc that may be grasped at every yaw.
    #[schema(value_type = f64, required = false, example = 0.3)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub yaw: Option<f64>,
}

/// A free way for the gripper to stand, with the free angle beside it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, ToSchema)]
pub struct GraspBody {
    /// The gripper's axis along the table's x, m.
    #[schema(value_type = f64, required = true, example = 0.4)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x: Option<f64>,
    /// The gripper's axis along the table's y, m.
    #[schema(value_type = f64, required = true, example = 0.2)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y: Option<f64>,
    /// Direction of finger 0, rad, counter-clockwise from +x, in [0, 2π/k); for an object with listed grasps in [0, 2π).
    #[schema(example = 0.31)]
    pub yaw: f64,
    /// The free angle on each side of the yaw, rad. π/k if nothing blocks; for an object with listed grasps the grasp's tolerance or
    /// `yaw_tolerance`, whichever is greater.
    #[schema(value_type = f64, required = true, example = 0.12)]
    pub slack: Option<f64>,
}

impl<'a> StepBody<'a> {
    pub(super) fn new(step: &'a Step) -> Self {
        match step {
            Step::PickPlace(PickPlace { object, from, to, grasp, release, turn, gap }) => {
                Self::PickPlace(PickPlaceBody {
                    action: PickPlaceWord::PickPlace,
                    object,
                    from: from.map(PoseBody::from),
                    to: (*to).into(),
                    grasp: (*grasp).into(),
                    release: (*release).into(),
                    turn: *turn,
                    gap: *gap,
                })
            }
            Step::PickDrop(PickDrop { object, from, grasp, drop_off }) => Self::PickDrop(PickDropBody {
                action: PickDropWord::PickDrop,
                object,
                from: from.map(PoseBody::from),
                grasp: (*grasp).into(),
                drop_off,
            }),
        }
    }
}

impl From<StatedPose> for PoseBody {
    fn from(StatedPose { at, yaw }: StatedPose) -> Self {
        Self { x: at.x, y: at.y, yaw }
    }
}

impl From<StatedGrasp> for GraspBody {
    fn from(StatedGrasp { at, yaw, slack }: StatedGrasp) -> Self {
        Self { x: at.map(|at| at.x), y: at.map(|at| at.y), yaw, slack }
    }
}
