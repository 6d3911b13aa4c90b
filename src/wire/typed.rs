//! Reads a sound scene straight from its text, without a JSON value in between. All that it refuses is walked as a value,
//! which names every fault; all that it takes the walk takes with the same result.

use serde::Deserialize;
use serde_json::value::RawValue;

use super::drop_off::DropOffFields;
use super::goal;
use super::limits::{MAX_CALLBACK_URL_LENGTH, MAX_SCENE_ID_LENGTH, PRIORITY_RANGE, RequestLimits};
use super::object::ObjectFields;
use super::plan_request::StatedRequest;
use super::reader::{JsonNode, RequestFaults, parse};
use super::scene::OPENINGS;
use super::settings::StatedSettings;
use super::strict::{Object, present};
use super::walk::MAX_DEPTH;
use singulate_planner::check::{POSITION_TOLERANCE_RANGE, Terms};
use singulate_planner::scene::{GoalDraft, GripperDraft, Opening, RectangleDraft, SceneDraft, TableDraft};

/// How deep a plan may be nested: the body of a verification is one level more.
const MAX_PLAN_NESTING: usize = MAX_DEPTH - 1;

/// A planning request. `None` unless it is sound, its scene apart.
pub(super) fn scene(body: &[u8], limits: &RequestLimits) -> Option<StatedRequest> {
    object::<RequestFields<'_>>(body)?.scene(limits)
}

/// A job request: the planning request, the callback URL, the priority. `None` if it has a fault, its scene excepted.
pub(super) fn job(body: &[u8], limits: &RequestLimits) -> Option<(StatedRequest, Option<String>, i64)> {
    let mut fields = object::<RequestFields<'_>>(body)?;
    let url = fields.callback_url.take().flatten();
    let priority = fields.priority.take().flatten().unwrap_or_default();
    let (least, greatest) = PRIORITY_RANGE;
    let short = url.as_ref().is_none_or(|url| url.chars().nth(MAX_CALLBACK_URL_LENGTH).is_none());
    let sound = short && (least..=greatest).contains(&priority);
    sound.then_some((fields.scene(limits)?, url, priority))
}

/// A verification: the planning request, the text of the plan, and the terms. `None` if anything has a fault, scene and plan
/// excepted.
pub(super) fn verification<'t>(body: &'t [u8], limits: &RequestLimits) -> Option<(StatedRequest, &'t str, Terms)> {
    let fields = object::<VerifyFields<'t>>(body)?;
    let plan = fields.plan.get();
    // Read by itself the plan could be nested one deeper than in its body.
    let sound = nesting(plan) <= MAX_PLAN_NESTING;
    let terms = Terms {
        position_tolerance: fields.position_tolerance.unwrap_or_default(),
        partial: fields.partial.unwrap_or_default(),
    };
    let (least, greatest) = POSITION_TOLERANCE_RANGE;
    let sound = sound && (least..=greatest).contains(&terms.position_tolerance);
    sound.then_some((fields.scene.0.scene(limits)?, plan, terms))
}

/// How deep the lists and objects of a JSON text are nested.
fn nesting(text: &str) -> usize {
    let (mut deepest, mut open, mut inside, mut escaped) = (0_usize, 0_usize, false, false);
    for byte in text.bytes() {
        match byte {
            _ if escaped => escaped = false,
            b'\\' => escaped = inside,
            b'"' => inside = !inside,
            b'[' | b'{' if !inside => {
                open += 1;
                deepest = deepest.max(open);
            }
            b']' | b'}' if !inside => open -= 1,
            _ => {}
        }
    }
    deepest
}

fn object<'t, T: Deserialize<'t>>(body: &'t [u8]) -> Option<T> {
    serde_json::from_slice::<Object<T>>(body).ok().map(|Object(fields)| fields)
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct VerifyFields<'t> {
    #[serde(borrow)]
    scene: Object<RequestFields<'t>>,
    #[serde(borrow)]
    plan: &'t RawValue,
    position_tolerance: Option<f64>,
    partial: Option<bool>,
}

/// A planning request's fields, and two of jobs.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(clippy::option_option, reason = "absent, null or a value")]
struct RequestFields<'t> {
    scene_id: Option<String>,
    table: Object<TableFields>,
    gripper: Object<GripperFields>,
    objects: Vec<Object<ObjectFields>>,
    target: Option<String>,
    #[serde(borrow)]
    goal: Option<&'t RawValue>,
    drop_offs: Option<Vec<Object<DropOffFields>>>,
    #[serde(borrow)]
    settings: Option<&'t RawValue>,
    #[serde(default, deserialize_with = "present")]
    callback_url: Option<Option<String>>,
    #[serde(default, deserialize_with = "present")]
    priority: Option<Option<i64>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct TableFields {
    x_min: f64,
    y_min: f64,
    x_max: f64,
    y_max: f64,
    keep_out: Option<Vec<Object<RectangleFields>>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RectangleFields {
    x_min: f64,
    y_min: f64,
    x_max: f64,
    y_max: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct GripperFields {
    fingers: f64,
    finger_width: f64,
    clearance: f64,
    margin: Option<f64>,
    yaw_tolerance: Option<f64>,
    max_opening: Option<f64>,
    opening: Option<String>,
    finger_length: Option<f64>,
    palm_radius: Option<f64>,
    tip_height: Option<f64>,
}

impl RequestFields<'_> {
    /// `None` if it has fields of a job, or faulty settings.
    fn scene(self, limits: &RequestLimits) -> Option<StatedRequest> {
        let Self { scene_id, table, gripper, objects, target, goal, drop_offs, settings, callback_url, priority } =
            self;
        let named = scene_id.as_ref().is_none_or(|id| id.chars().nth(MAX_SCENE_ID_LENGTH).is_none());
        if !named || callback_url.is_some() || priority.is_some() || objects.len() > limits.scene.max_objects {
            return None;
        }
        let settings = match settings {
            Some(text) => self::settings(text, limits)?,
            None => StatedSettings::absent(limits),
        };
        let draft = SceneDraft {
            table: table.0.into(),
            gripper: gripper.0.draft()?,
            objects: objects.into_iter().map(|Object(fields)| fields.draft()).collect::<Option<_>>()?,
            goal: Some(wanted(target, goal)?),
            drop_offs: drop_offs.map(|list| list.into_iter().map(|Object(fields)| fields.into()).collect()),
            destination: None,
        };
        Some(StatedRequest { scene_id, draft, settings })
    }
}

/// Settings are few and have many rules, so they are read by the walk here too.
fn settings(text: &RawValue, limits: &RequestLimits) -> Option<StatedSettings> {
    walked(text, |node, faults| Some(StatedSettings::read(node, limits, faults)))
}

/// The target, or the goal of another kind; `None` unless one of them is there.
fn wanted(target: Option<String>, goal: Option<&RawValue>) -> Option<GoalDraft> {
    match (target, goal) {
        (Some(target), None) => Some(GoalDraft::Target(target)),
        (None, Some(text)) => walked(text, goal::read),
        _ => None,
    }
}

/// A part of the body, read by the walk.
fn walked<T>(text: &RawValue, read: impl FnOnce(JsonNode<'_>, &mut RequestFaults) -> Option<T>) -> Option<T> {
    let (value, mut faults) = parse(text.get().as_bytes()).ok()?;
    let stated = read(JsonNode::root(&value), &mut faults);
    faults.judge(stated).ok()
}

impl From<TableFields> for TableDraft {
    fn from(TableFields { x_min, y_min, x_max, y_max, keep_out }: TableFields) -> Self {
        let keep_out = keep_out.into_iter().flatten().map(|Object(fields)| fields.into()).collect();
        Self { top: RectangleFields { x_min, y_min, x_max, y_max }.into(), keep_out }
    }
}

impl From<RectangleFields> for RectangleDraft {
    fn from(RectangleFields { x_min, y_min, x_max, y_max }: RectangleFields) -> Self {
        Self { x_min: Some(x_min), y_min: Some(y_min), x_max: Some(x_max), y_max: Some(y_max) }
    }
}

impl GripperFields {
    /// `None` if a word is unknown.
    fn draft(self) -> Option<GripperDraft> {
        let fields = self;
        let known = |word: String| OPENINGS.iter().find(|(name, _)| *name == word).map(|(_, opening)| *opening);
        let opening: Option<Opening> = match fields.opening {
            Some(word) => Some(known(word)?),
            None => None,
        };
        Some(GripperDraft {
            fingers: Some(fields.fingers),
            finger_width: Some(fields.finger_width),
            clearance: Some(fields.clearance),
            margin: Some(fields.margin.unwrap_or_default()),
            yaw_tolerance: Some(fields.yaw_tolerance.unwrap_or_default()),
            max_opening: fields.max_opening,
            opening,
            finger_length: fields.finger_length,
            palm_radius: fields.palm_radius,
            tip_height: fields.tip_height,
        })
    }
}
