//! A drop-off as JSON: its schema, how it is written, and how it is read.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::goal::ids;
use super::reader::{FieldNames, JsonNode, RequestFaults};
use singulate_planner::scene::{DropOff, DropOffDraft, ObjectIndex, Scene};

const DROP_OFF: FieldNames = FieldNames::of(&["id", "capacity", "accepts"]);

/// A place off the table, to which objects are taken away.
#[derive(Debug, Clone, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct DropOffBody {
    /// The caller's name for it, unique among the drop-offs.
    #[schema(min_length = 1, max_length = 128, example = "tray")]
    pub id: String,
    /// How many more objects it takes. Default: unlimited.
    #[schema(minimum = 1, maximum = 1000000000, example = 4)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub capacity: Option<u32>,
    /// The ids of the objects that it takes. Default: all.
    #[schema(example = json!(["plate-1"]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub accepts: Option<Vec<String>>,
}

/// The fields of a sound drop-off, read straight from its text.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DropOffFields {
    id: String,
    capacity: Option<f64>,
    accepts: Option<Vec<String>>,
}

impl DropOffBody {
    pub(super) fn new(scene: &Scene, drop_off: &DropOff) -> Self {
        let id = |object: &ObjectIndex| scene.object(*object).id().to_owned();
        Self {
            id: drop_off.id().to_owned(),
            capacity: drop_off.capacity().and_then(|capacity| u32::try_from(capacity).ok()),
            accepts: drop_off.accepts().map(|objects| objects.iter().map(id).collect()),
        }
    }
}

impl From<DropOffFields> for DropOffDraft {
    fn from(DropOffFields { id, capacity, accepts }: DropOffFields) -> Self {
        Self { id: Some(id), capacity, accepts: accepts.map(|ids| ids.into_iter().map(Some).collect()) }
    }
}

/// Read through a JSON value, with every fault.
pub(super) fn read(node: JsonNode<'_>, faults: &mut RequestFaults) -> Option<DropOffDraft> {
    let fields = node.fields(&DROP_OFF, faults)?;
    Some(DropOffDraft {
        id: fields.required("id", faults, |node, faults| node.text(faults)),
        capacity: fields.stated("capacity", faults, |node, faults| node.number(faults)),
        accepts: fields.stated("accepts", faults, ids),
    })
}
