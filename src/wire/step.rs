//! A step of a plan as JSON: its schemas as served and as stated, how it is written, and how it is read.

use nalgebra::Point2;
use serde::Serialize;
use utoipa::ToSchema;

use super::code::ErrorCode;
use super::reader::{FieldNames, JsonNode, RequestFaults};
use singulate_planner::scene::{COORDINATE_RANGE, Pose};
use singulate_planner::statement::{PickDrop, PickPlace, StatedGrasp, Step};

const PICK_PLACE: FieldNames = FieldNames::of(&["action", "object", "from", "to", "grasp", "release", "gap"]);
const PICK_DROP: FieldNames = FieldNames::of(&["action", "object", "from", "grasp", "drop_off"]);
const POINT: FieldNames = FieldNames::of(&["x", "y"]);
const GRASP: FieldNames = FieldNames::of(&["yaw", "slack"]);

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
    /// The object's centre before the move.
    #[schema(value_type = PointBody, required = true)]
    pub from: Option<PointBody>,
    /// The object's centre after the move.
    pub to: PointBody,
    /// The grasp at the old place.
    pub grasp: GraspBody,
    /// The yaw at which the object is let go at the new place.
    pub release: GraspBody,
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
    /// The object's centre before it is taken away.
    #[schema(value_type = PointBody, required = true)]
    pub from: Option<PointBody>,
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

/// A point on the table.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, ToSchema)]
pub struct PointBody {
    /// Along the table's x, m.
    #[schema(example = 0.4)]
    pub x: f64,
    /// Along the table's y, m.
    #[schema(example = 0.2)]
    pub y: f64,
}

/// A free yaw of the gripper, with the free angle beside it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, ToSchema)]
pub struct GraspBody {
    /// Direction of finger 0, rad, counter-clockwise from +x, in [0, 2π/k).
    #[schema(example = 0.31)]
    pub yaw: f64,
    /// The free angle on each side of the yaw, rad. π/k if nothing blocks.
    #[schema(value_type = f64, required = true, example = 0.12)]
    pub slack: Option<f64>,
}

/// A step of an answer to check.
#[derive(Debug, Clone, ToSchema)]
#[serde(untagged)]
pub enum StatedStep {
    /// To another place on the table.
    PickPlace(StatedPickPlace),
    /// To a drop-off.
    PickDrop(StatedPickDrop),
}

/// A step to another place on the table, of an answer to check.
#[derive(Debug, Clone, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct StatedPickPlace {
    /// The kind of step. Default: `pick_place`.
    pub action: Option<PickPlaceWord>,
    /// The id of the object that is moved.
    #[schema(example = "plate-2")]
    pub object: String,
    /// The object's centre before the move.
    pub from: Option<StatedPoint>,
    /// The object's centre after the move.
    pub to: StatedPoint,
    /// The grasp at the old place.
    pub grasp: StatedGraspBody,
    /// The yaw at which the object is let go at the new place.
    pub release: StatedGraspBody,
    /// Least distance to another object at the new place, edge to edge, m.
    #[schema(example = 0.031)]
    pub gap: Option<f64>,
}

/// A step to a drop-off, of an answer to check.
#[derive(Debug, Clone, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct StatedPickDrop {
    /// The kind of step.
    pub action: PickDropWord,
    /// The id of the object that is taken away.
    #[schema(example = "plate-1")]
    pub object: String,
    /// The object's centre before it is taken away.
    pub from: Option<StatedPoint>,
    /// The grasp there.
    pub grasp: StatedGraspBody,
    /// The id of the drop-off that it is taken to.
    #[schema(example = "tray")]
    pub drop_off: String,
}

/// A point of an answer to check.
#[derive(Debug, Clone, Copy, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct StatedPoint {
    /// Along the table's x, m.
    #[schema(minimum = -100000, maximum = 100000, example = 0.4)]
    pub x: f64,
    /// Along the table's y, m.
    #[schema(minimum = -100000, maximum = 100000, example = 0.2)]
    pub y: f64,
}

/// A yaw of an answer to check.
#[derive(Debug, Clone, Copy, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = StatedGrasp)]
pub struct StatedGraspBody {
    /// Direction of finger 0, rad, counter-clockwise from +x.
    #[schema(example = 0.31)]
    pub yaw: f64,
    /// The free angle on each side of the yaw, rad.
    #[schema(example = 0.12)]
    pub slack: Option<f64>,
}

impl<'a> StepBody<'a> {
    pub(super) fn new(step: &'a Step) -> Self {
        match step {
            Step::PickPlace(PickPlace { object, from, to, grasp, release, gap }) => Self::PickPlace(PickPlaceBody {
                action: PickPlaceWord::PickPlace,
                object,
                from: from.map(PointBody::from),
                to: (*to).into(),
                grasp: (*grasp).into(),
                release: (*release).into(),
                gap: *gap,
            }),
            Step::PickDrop(PickDrop { object, from, grasp, drop_off }) => Self::PickDrop(PickDropBody {
                action: PickDropWord::PickDrop,
                object,
                from: from.map(PointBody::from),
                grasp: (*grasp).into(),
                drop_off,
            }),
        }
    }
}

impl From<Pose> for PointBody {
    fn from(Pose { at }: Pose) -> Self {
        Self { x: at.x, y: at.y }
    }
}

impl From<StatedGrasp> for GraspBody {
    fn from(StatedGrasp { yaw, slack }: StatedGrasp) -> Self {
        Self { yaw, slack }
    }
}

/// An action that may be stated.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Action {
    PickPlace,
    PickDrop,
}

pub(super) fn read(node: JsonNode<'_>, faults: &mut RequestFaults) -> Option<Step> {
    let actions = [("pick_place", Action::PickPlace), ("pick_drop", Action::PickDrop)];
    // Where no action is named, or none that is known, it is the oldest one.
    let is_drop = node.peek("action").is_some_and(|action| action == "pick_drop");
    let fields = node.fields(if is_drop { &PICK_DROP } else { &PICK_PLACE }, faults)?;
    fields.stated("action", faults, |node, faults| node.word(&actions, faults));
    let object = fields.required("object", faults, |node, faults| node.text(faults));
    let from = fields.stated("from", faults, point);
    if is_drop {
        let grasp = fields.required("grasp", faults, read_grasp);
        let drop_off = fields.required("drop_off", faults, |node, faults| node.text(faults));
        return Some(Step::PickDrop(PickDrop { object: object?, from, grasp: grasp?, drop_off: drop_off? }));
    }
    let to = fields.required("to", faults, point);
    let grasp = fields.required("grasp", faults, read_grasp);
    let release = fields.required("release", faults, read_grasp);
    let gap = fields.stated("gap", faults, |node, faults| node.number(faults));
    Some(Step::PickPlace(PickPlace { object: object?, from, to: to?, grasp: grasp?, release: release?, gap }))
}

fn point(node: JsonNode<'_>, faults: &mut RequestFaults) -> Option<Pose> {
    let fields = node.fields(&POINT, faults)?;
    let x = fields.required("x", faults, coordinate);
    let y = fields.required("y", faults, coordinate);
    Some(Point2::new(x?, y?).into())
}

fn coordinate(node: JsonNode<'_>, faults: &mut RequestFaults) -> Option<f64> {
    let value = node.number(faults)?;
    let (min, max) = COORDINATE_RANGE;
    if !(min..=max).contains(&value) {
        faults.add(ErrorCode::OutOfRange, node.path(), format_args!("{value} is not between {min} and {max}"));
    }
    Some(value)
}

pub(super) fn read_grasp(node: JsonNode<'_>, faults: &mut RequestFaults) -> Option<StatedGrasp> {
    let fields = node.fields(&GRASP, faults)?;
    let yaw = fields.number("yaw", faults);
    let slack = fields.stated("slack", faults, |node, faults| node.number(faults));
    Some(StatedGrasp { yaw: yaw?, slack })
}
