//! A goal as JSON: its schema, how it is written, and how it is read.

use serde::Serialize;
use utoipa::ToSchema;

use super::code::ErrorCode;
use super::reader::{FieldNames, JsonNode, RequestFaults};
use singulate_planner::scene::{Goal, GoalDraft, ObjectIndex, Scene};

const GOAL: FieldNames = FieldNames::of(&["any_of", "all_of", "clear"]);

/// What is wanted, where it is not one object. Exactly one field is there.
#[derive(Debug, Clone, Default, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(min_properties = 1, max_properties = 1, example = json!({"any_of": ["plate-1", "plate-2"]}))]
pub struct GoalBody {
    /// The ids of objects of which one is to be grasped: the one that takes the fewest steps. Those that are too wide, or
    /// have no grasp, are passed over.
    #[schema(value_type = Vec<String>, required = false, min_items = 1, max_items = 10000,
        example = json!(["plate-1", "plate-2"]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub any_of: Option<Vec<String>>,
    /// The ids of objects that are all to be taken away to drop-offs. Other objects move only if they must.
    #[schema(value_type = Vec<String>, required = false, min_items = 1, max_items = 10000,
        example = json!(["plate-1", "plate-2"]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub all_of: Option<Vec<String>>,
    /// Always true: all that can go is to be taken away to drop-offs.
    #[schema(value_type = bool, required = false, example = true)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clear: Option<bool>,
}

impl GoalBody {
    /// The target's id, or the goal of another kind.
    pub(super) fn of(scene: &Scene) -> (Option<String>, Option<Self>) {
        let id = |object: &ObjectIndex| scene.object(*object).id().to_owned();
        let ids = |objects: &[ObjectIndex]| Some(objects.iter().map(id).collect());
        match scene.goal() {
            Goal::Target(target) => (Some(id(target)), None),
            Goal::AnyOf(objects) => (None, Some(Self { any_of: ids(objects), ..Self::default() })),
            Goal::AllOf(objects) => (None, Some(Self { all_of: ids(objects), ..Self::default() })),
            Goal::Clear => (None, Some(Self { clear: Some(true), ..Self::default() })),
        }
    }
}

pub(super) fn read(node: JsonNode<'_>, faults: &mut RequestFaults) -> Option<GoalDraft> {
    let fields = node.fields(&GOAL, faults)?;
    let stated = GOAL.known.iter().filter(|name| fields.states(name)).count();
    if stated != 1 {
        let code = if stated == 0 { ErrorCode::Missing } else { ErrorCode::ConflictingFields };
        faults.add(code, node.path(), format_args!("a goal has one of: any_of, all_of, clear"));
        return None;
    }
    let any_of = fields.stated("any_of", faults, ids).map(GoalDraft::AnyOf);
    let all_of = fields.stated("all_of", faults, ids).map(GoalDraft::AllOf);
    any_of.or(all_of).or_else(|| fields.stated("clear", faults, clear))
}

fn clear(node: JsonNode<'_>, faults: &mut RequestFaults) -> Option<GoalDraft> {
    if node.boolean(faults)? {
        return Some(GoalDraft::Clear);
    }
    faults.add(ErrorCode::UnknownValue, node.path(), format_args!("false is none of: true"));
    None
}

/// Ids; `None` for one that is no text.
pub(super) fn ids(node: JsonNode<'_>, faults: &mut RequestFaults) -> Option<Vec<Option<String>>> {
    node.list(faults, |node, faults| node.text(faults).map(Some))
}
