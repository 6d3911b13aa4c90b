//! Reads planning requests from JSON.

use super::code::ErrorCode;
use super::limits::{MAX_SCENE_ID_LENGTH, RequestLimits};
use super::path::Path;
use super::plan_request::{PlanRequest, StatedRequest};
use super::problem::Problem;
use super::reader::{FieldNames, Fields, JsonNode, RequestFaults, parse};
use super::scene::OPENINGS;
use super::settings::StatedSettings;
use super::typed;
use super::{drop_off, goal, object};
use singulate_planner::scene::{Flaw, GoalDraft, GripperDraft, ObjectDraft, RectangleDraft, SceneDraft, TableDraft};

/// Read a planning request.
///
/// # Errors
/// A problem with every fault of the body.
pub fn read_scene(body: &[u8], limits: &RequestLimits) -> Result<PlanRequest, Problem> {
    sound(body, limits).map_or_else(|| walked(body, limits), Ok)
}

/// Parse a valid body directly; see [`typed`].
pub(super) fn sound(body: &[u8], limits: &RequestLimits) -> Option<PlanRequest> {
    typed::scene(body, limits)?.sound(&Path::Root, limits)
}

/// Read any body through a JSON value.
pub(super) fn walked(body: &[u8], limits: &RequestLimits) -> Result<PlanRequest, Problem> {
    let (value, mut faults) = parse(body)?;
    let request = request(JsonNode::root(&value), &REQUEST, limits, &mut faults);
    faults.judge(request)
}

pub(super) const REQUEST: FieldNames =
    FieldNames::of(&["scene_id", "table", "gripper", "objects", "target", "goal", "drop_offs", "settings"]);
const TABLE: FieldNames = FieldNames::of(&["x_min", "y_min", "x_max", "y_max", "keep_out"]);
const RECTANGLE: FieldNames = FieldNames::of(&["x_min", "y_min", "x_max", "y_max"]);
const GRIPPER: FieldNames = FieldNames::of(&[
    "fingers",
    "finger_width",
    "clearance",
    "margin",
    "yaw_tolerance",
    "max_opening",
    "opening",
    "finger_length",
    "palm_radius",
    "tip_height",
]);

/// A planning request; `names` includes its own fields.
pub(super) fn request(
    node: JsonNode<'_>,
    names: &FieldNames,
    limits: &RequestLimits,
    faults: &mut RequestFaults,
) -> Option<PlanRequest> {
    let fields = node.fields(names, faults)?;
    let scene_id = fields.optional("scene_id", None, faults, scene_id);
    let table = fields.required("table", faults, table);
    let gripper = fields.required("gripper", faults, gripper);
    let objects = fields.required("objects", faults, |node, faults| objects(node, limits, faults));
    let goal = wanted(&fields, faults);
    let drop_offs = fields.stated("drop_offs", faults, |node, faults| node.list(faults, drop_off::read));
    let settings = fields.optional("settings", StatedSettings::absent(limits), faults, |node, faults| {
        Some(StatedSettings::read(node, limits, faults))
    });
    let draft = SceneDraft {
        table: table.unwrap_or_default(),
        gripper: gripper.unwrap_or_default(),
        // Without the objects, or the drop-offs that are stated, the goal can't be checked.
        goal: goal.filter(|_| objects.is_some() && fields.states("drop_offs") == drop_offs.is_some()),
        objects: objects.unwrap_or_default(),
        drop_offs,
        destination: None,
    };
    let named = scene_id.is_some();
    let stated = StatedRequest { scene_id: scene_id.flatten(), draft, settings: settings? };
    stated.checked(node.path(), limits, faults).filter(|_| named)
}

/// The target, or the goal of another kind.
fn wanted(fields: &Fields<'_>, faults: &mut RequestFaults) -> Option<GoalDraft> {
    if !fields.states("goal") && !fields.has("target") {
        fields.missing_one_of(["target", "goal"], faults);
        return None;
    }
    if !fields.states("goal") {
        return fields.required("target", faults, |node, faults| node.text(faults)).map(GoalDraft::Target);
    }
    let goal = fields.stated("goal", faults, goal::read);
    if fields.states("target") {
        fields.conflict("goal", "target", faults);
        return None;
    }
    goal
}

fn scene_id(node: JsonNode<'_>, faults: &mut RequestFaults) -> Option<Option<String>> {
    let text = node.text(faults)?;
    let length = text.chars().count();
    if length > MAX_SCENE_ID_LENGTH {
        let detail = format_args!("a scene id has at most {MAX_SCENE_ID_LENGTH} characters, this one has {length}");
        faults.add(ErrorCode::IdLength, node.path(), detail);
        return None;
    }
    Some(Some(text))
}

fn table(node: JsonNode<'_>, faults: &mut RequestFaults) -> Option<TableDraft> {
    let fields = node.fields(&TABLE, faults)?;
    let top = RectangleDraft {
        x_min: fields.number("x_min", faults),
        y_min: fields.number("y_min", faults),
        x_max: fields.number("x_max", faults),
        y_max: fields.number("y_max", faults),
    };
    let keep_out = fields.optional("keep_out", Vec::new(), faults, |node, faults| node.list(faults, rectangle));
    Some(TableDraft { top, keep_out: keep_out.unwrap_or_default() })
}

fn rectangle(node: JsonNode<'_>, faults: &mut RequestFaults) -> Option<RectangleDraft> {
    let fields = node.fields(&RECTANGLE, faults)?;
    Some(RectangleDraft {
        x_min: fields.number("x_min", faults),
        y_min: fields.number("y_min", faults),
        x_max: fields.number("x_max", faults),
        y_max: fields.number("y_max", faults),
    })
}

fn gripper(node: JsonNode<'_>, faults: &mut RequestFaults) -> Option<GripperDraft> {
    let fields = node.fields(&GRIPPER, faults)?;
    let draft = GripperDraft {
        fingers: fields.number("fingers", faults),
        finger_width: fields.number("finger_width", faults),
        clearance: fields.number("clearance", faults),
        margin: fields.optional("margin", 0.0, faults, |node, faults| node.number(faults)),
        yaw_tolerance: fields.optional("yaw_tolerance", 0.0, faults, |node, faults| node.number(faults)),
        max_opening: fields.stated("max_opening", faults, |node, faults| node.number(faults)),
        opening: fields.stated("opening", faults, |node, faults| node.word(&OPENINGS, faults)),
        finger_length: fields.stated("finger_length", faults, |node, faults| node.number(faults)),
        palm_radius: fields.stated("palm_radius", faults, |node, faults| node.number(faults)),
        tip_height: fields.stated("tip_height", faults, |node, faults| node.number(faults)),
    };
    // Where the greatest opening, or a half of the palm, can't be read, nobody asks for it.
    let readable = |name, value: Option<f64>| fields.states(name) == value.is_some();
    let opens = readable("max_opening", draft.max_opening);
    let palm = readable("finger_length", draft.finger_length) && readable("palm_radius", draft.palm_radius);
    Some(GripperDraft {
        opening: draft.opening.filter(|_| opens),
        finger_length: draft.finger_length.filter(|_| palm),
        palm_radius: draft.palm_radius.filter(|_| palm),
        ..draft
    })
}

fn objects(node: JsonNode<'_>, limits: &RequestLimits, faults: &mut RequestFaults) -> Option<Vec<ObjectDraft>> {
    let (count, max) = (node.length(), limits.scene.max_objects);
    if count > max {
        // Reading them is not worth the work.
        faults.add(ErrorCode::TooManyObjects, node.path(), format_args!("{}", Flaw::TooManyObjects { count, max }));
        return None;
    }
    node.list(faults, object::read)
}
