//! An object of a scene as JSON: its schema, how it is written, and how it is read.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::reader::{FieldNames, JsonNode, RequestFaults};
use singulate_planner::scene::{Object, ObjectDraft, Shape, ShapeDraft};

// Later versions may have other shapes than discs.
const OBJECT: FieldNames = FieldNames { known: &["id", "x", "y", "radius", "fixed"], reserved: &["shape"] };

/// A disc on the table.
#[derive(Debug, Clone, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct ObjectBody {
    /// The caller's name for the object, unique in the scene.
    #[schema(min_length = 1, max_length = 128, example = "plate-1")]
    pub id: String,
    /// Centre, m; on the table.
    #[schema(minimum = -100000, maximum = 100000, example = 0.31)]
    pub x: f64,
    /// Centre, m; on the table.
    #[schema(minimum = -100000, maximum = 100000, example = 0.22)]
    pub y: f64,
    /// Radius, m.
    #[schema(minimum = 0.000001, maximum = 1000, example = 0.075)]
    pub radius: f64,
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
    radius: f64,
    fixed: Option<bool>,
}

impl ObjectBody {
    pub(super) fn new(object: &Object) -> Self {
        let footprint = object.footprint();
        let Shape::Disc { radius } = footprint.shape;
        let fixed = object.fixed().then_some(true);
        Self { id: object.id().to_owned(), x: footprint.at().x, y: footprint.at().y, radius, fixed }
    }
}

impl From<ObjectFields> for ObjectDraft {
    fn from(ObjectFields { id, x, y, radius, fixed }: ObjectFields) -> Self {
        Self { id: Some(id), x: Some(x), y: Some(y), shape: ShapeDraft::disc(radius), fixed: fixed.unwrap_or_default() }
    }
}

/// Read through a JSON value, with every fault.
pub(super) fn read(node: JsonNode<'_>, faults: &mut RequestFaults) -> Option<ObjectDraft> {
    let fields = node.fields(&OBJECT, faults)?;
    Some(ObjectDraft {
        id: fields.required("id", faults, |node, faults| node.text(faults)),
        x: fields.number("x", faults),
        y: fields.number("y", faults),
        shape: ShapeDraft { radius: fields.number("radius", faults) },
        fixed: fields.stated("fixed", faults, |node, faults| node.boolean(faults)).unwrap_or_default(),
    })
}
