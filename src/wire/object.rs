//! An object of a scene as JSON: its schema, how it is written, and how it is read.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::listed_grasp::{self, GraspFields, ListedGraspBody};
use super::reader::{FieldNames, Fields, JsonNode, RequestFaults};
use super::shape::ShapeBody;
use super::shape_reader::{self, ShapeFields};
use super::strict;
use singulate_planner::scene::{GraspDraft, Kind, Object, ObjectDraft, ShapeDraft};

const OBJECT: FieldNames = FieldNames::of(&["id", "x", "y", "yaw", "radius", "shape", "height", "grasps", "fixed"]);

/// An object on the table: a disc, or another shape.
#[derive(Debug, Clone, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(example = json!({
    "id": "tray", "x": 0.4, "y": 0.2, "yaw": 0.3, "shape": {"kind": "rectangle", "length": 0.4, "width": 0.3}, "height": 0.03
}))]
pub struct ObjectBody {
    /// The caller's name for the object, unique in the scene.
    #[schema(min_length = 1, max_length = 128, example = "plate-1")]
    pub id: String,
    /// The origin of its own frame, m; on the table. Of disc, rectangle and capsule it is the centre.
    #[schema(minimum = -100000, maximum = 100000, example = 0.31)]
    pub x: f64,
    /// The origin of its own frame, m; on the table.
    #[schema(minimum = -100000, maximum = 100000, example = 0.22)]
    pub y: f64,
    /// How far its own frame is turned, rad, counter-clockwise. Default: 0.
    #[schema(minimum = -1000, maximum = 1000, example = 0.3)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub yaw: Option<f64>,
    /// The radius of a disc, m. Either this or `shape` is required.
    #[schema(minimum = 0.000001, maximum = 1000, example = 0.075)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius: Option<f64>,
    /// What it covers of the table. Either this or `radius` is required.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shape: Option<ShapeBody>,
    /// How high it stands over the table, m. Default: unknown; then it is in the way of fingers and never of the palm.
    #[schema(minimum = 0.000001, maximum = 1000, example = 0.03)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height: Option<f64>,
    /// The only ways to grasp it. Without them: a disc at every yaw; by two fingers a capsule across its middle, rectangle and polygon
    /// across parallel edges; by four fingers a rectangle along its axes; else not at all.
    #[schema(max_items = 64, example = json!([{"x": 0, "y": 0, "yaw": 1.57, "tolerance": 0.05}]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grasps: Option<Vec<ListedGraspBody>>,
    /// True if the object can't be moved. Default: false.
    #[schema(example = false)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fixed: Option<bool>,
}

/// The fields of a sound object, read straight from its text.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ObjectFields {
    id: String,
    x: f64,
    y: f64,
    yaw: Option<f64>,
    radius: Option<f64>,
    shape: Option<strict::Object<ShapeFields>>,
    height: Option<f64>,
    grasps: Option<Vec<strict::Object<GraspFields>>>,
    fixed: Option<bool>,
}

impl ObjectBody {
    pub(super) fn new(object: &Object) -> Self {
        let (pose, shape) = (object.footprint().pose(), object.footprint().shape());
        let disc = shape.kind() == Kind::Disc;
        let listed = object.grasps().listed().filter(|_| object.grasps_stated());
        Self {
            id: object.id().to_owned(),
            x: pose.at.x,
            y: pose.at.y,
            yaw: (pose.yaw != 0.0).then_some(pose.yaw),
            radius: disc.then_some(shape.radius()),
            shape: (!disc).then(|| ShapeBody::new(shape)),
            height: object.height(),
            grasps: listed.map(|list| list.iter().map(ListedGraspBody::new).collect()),
            fixed: object.fixed().then_some(true),
        }
    }
}

impl ObjectFields {
    /// `None` unless there is either a radius or a shape, and that is read.
    pub(super) fn draft(self) -> Option<ObjectDraft> {
        let Self { id, x, y, yaw, radius, shape, height, grasps, fixed } = self;
        let shape = match (radius, shape) {
            (Some(radius), None) => ShapeDraft::disc(radius),
            (None, Some(strict::Object(fields))) => fields.draft()?,
            _ => return None,
        };
        Some(ObjectDraft {
            id: Some(id),
            x: Some(x),
            y: Some(y),
            yaw,
            shape,
            height,
            grasps: grasps.map(|list| list.into_iter().map(GraspDraft::from).collect()),
            fixed: fixed.unwrap_or_default(),
        })
    }
}

/// Read through a JSON value, with every fault.
pub(super) fn read(node: JsonNode<'_>, faults: &mut RequestFaults) -> Option<ObjectDraft> {
    let fields = node.fields(&OBJECT, faults)?;
    let id = fields.required("id", faults, |node, faults| node.text(faults));
    let (x, y) = (fields.number("x", faults), fields.number("y", faults));
    let yaw = fields.optional("yaw", None, faults, |node, faults| node.number(faults).map(Some));
    let shape = shape(&fields, faults);
    Some(ObjectDraft {
        id,
        x,
        y,
        yaw: yaw.flatten(),
        // Where the yaw can't be read, nobody knows what the shape covers.
        shape: if yaw.is_some() { shape } else { ShapeDraft::Unread },
        height: fields.stated("height", faults, |node, faults| node.number(faults)),
        grasps: grasps(&fields, faults),
        fixed: fields.stated("fixed", faults, |node, faults| node.boolean(faults)).unwrap_or_default(),
    })
}

/// The shape, or the radius of a disc.
fn shape(fields: &Fields<'_>, faults: &mut RequestFaults) -> ShapeDraft {
    if fields.states("shape") {
        let shape = fields.stated("shape", faults, shape_reader::read);
        if fields.states("radius") {
            fields.conflict("shape", "radius", faults);
            return ShapeDraft::Unread;
        }
        return shape.unwrap_or_default();
    }
    if !fields.has("radius") {
        fields.missing_one_of(["radius", "shape"], faults);
        return ShapeDraft::Unread;
    }
    ShapeDraft::Radius(fields.number("radius", faults))
}

/// The listed grasps. What can't be read becomes a list with an unreadable one: with the grasps of the shape there could be faults
/// that nobody made.
fn grasps(fields: &Fields<'_>, faults: &mut RequestFaults) -> Option<Vec<GraspDraft>> {
    let list = fields.stated("grasps", faults, |node, faults| node.list(faults, listed_grasp::read));
    let unread = fields.states("grasps") && list.is_none();
    if unread { Some(vec![GraspDraft::default()]) } else { list }
}
