//! A step of a stated plan as JSON: its schemas, and how it is read.

use nalgebra::Point2;
use utoipa::ToSchema;

use super::code::ErrorCode;
use super::reader::{FieldNames, JsonNode, RequestFaults};
use super::step::{PickDropWord, PickPlaceWord};
use singulate_planner::scene::COORDINATE_RANGE;
use singulate_planner::statement::{PickDrop, PickPlace, StatedGrasp, StatedPose, Step};

const PICK_PLACE: FieldNames = FieldNames::of(&["action", "object", "from", "to", "grasp", "release", "turn", "gap"]);
const PICK_DROP: FieldNames = FieldNames::of(&["action", "object", "from", "grasp", "drop_off"]);
const POSE: FieldNames = FieldNames::of(&["x", "y", "yaw"]);
const GRASP: FieldNames = FieldNames::of(&["x", "y", "yaw", "slack"]);

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
    /// Where the object's own frame stands before the move; of a disc its centre.
    pub from: Option<StatedPoseBody>,
    /// Where the object's own frame stands after the move.
    pub to: StatedPoseBody,
    /// The grasp at the old place.
    pub grasp: StatedGraspBody,
    /// How the gripper stands when the object is let go at the new place.
    pub release: StatedGraspBody,
    /// How far the object turns on the way, rad. Not checked if absent.
    #[schema(example = 1.57)]
    pub turn: Option<f64>,
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
    /// Where the object's own frame stands before it is taken away; of a disc its centre.
    pub from: Option<StatedPoseBody>,
    /// The grasp there.
    pub grasp: StatedGraspBody,
    /// The id of the drop-off that it is taken to.
    #[schema(example = "tray")]
    pub drop_off: String,
}

/// Where an object stands, of an answer to check.
#[derive(Debug, Clone, Copy, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = StatedPose)]
pub struct StatedPoseBody {
    /// The frame's origin along the table's x, m.
    #[schema(minimum = -100000, maximum = 100000, example = 0.4)]
    pub x: f64,
    /// The frame's origin along the table's y, m.
    #[schema(minimum = -100000, maximum = 100000, example = 0.2)]
    pub y: f64,
    /// How far the frame is turned, rad, counter-clockwise. A disc that may be grasped at every yaw needs none.
    #[schema(example = 0.3)]
    pub yaw: Option<f64>,
}

/// A grasp or release of an answer to check.
#[derive(Debug, Clone, Copy, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = StatedGrasp)]
pub struct StatedGraspBody {
    /// The gripper's axis along the table's x, m. Either both this and `y` are there, or neither. Default: the origin of the object's
    /// own frame.
    #[schema(minimum = -100000, maximum = 100000, example = 0.4)]
    pub x: Option<f64>,
    /// The gripper's axis along the table's y, m.
    #[schema(minimum = -100000, maximum = 100000, example = 0.2)]
    pub y: Option<f64>,
    /// Direction of finger 0, rad, counter-clockwise from +x.
    #[schema(example = 0.31)]
    pub yaw: f64,
    /// The free angle on each side of the yaw, rad.
    #[schema(example = 0.12)]
    pub slack: Option<f64>,
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
    let from = fields.stated("from", faults, pose);
    if is_drop {
        let grasp = fields.required("grasp", faults, read_grasp);
        let drop_off = fields.required("drop_off", faults, |node, faults| node.text(faults));
        return Some(Step::PickDrop(PickDrop { object: object?, from, grasp: grasp?, drop_off: drop_off? }));
    }
    let to = fields.required("to", faults, pose);
    let grasp = fields.required("grasp", faults, read_grasp);
    let release = fields.required("release", faults, read_grasp);
    let turn = fields.stated("turn", faults, |node, faults| node.number(faults));
    let gap = fields.stated("gap", faults, |node, faults| node.number(faults));
    Some(Step::PickPlace(PickPlace { object: object?, from, to: to?, grasp: grasp?, release: release?, turn, gap }))
}

fn pose(node: JsonNode<'_>, faults: &mut RequestFaults) -> Option<StatedPose> {
    let fields = node.fields(&POSE, faults)?;
    let x = fields.required("x", faults, coordinate);
    let y = fields.required("y", faults, coordinate);
    let yaw = fields.stated("yaw", faults, |node, faults| node.number(faults));
    Some(StatedPose { at: Point2::new(x?, y?), yaw })
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
    let (x, y) = (fields.stated("x", faults, coordinate), fields.stated("y", faults, coordinate));
    for (name, other) in [("x", "y"), ("y", "x")] {
        if fields.states(other) && !fields.states(name) {
            fields.missing(name, faults);
        }
    }
    let yaw = fields.number("yaw", faults);
    let slack = fields.stated("slack", faults, |node, faults| node.number(faults));
    let at = x.zip(y).map(|(x, y)| Point2::new(x, y));
    Some(StatedGrasp { at, yaw: yaw?, slack })
}
