//! A stated answer as JSON: its schema, and how it is read.

use core::fmt;

use utoipa::openapi::schema::AdditionalProperties;
use utoipa::openapi::{ObjectBuilder, RefOr, Schema, Type};
use utoipa::{PartialSchema, ToSchema};

use super::answer::VerdictWord;
use super::code::ErrorCode;
use super::limits::RequestLimits;
use super::path::Path;
use super::plan_request::PlanRequest;
use super::problem::Problem;
use super::reader::{FieldNames, JsonNode, RequestFaults, parse};
use super::request::{REQUEST, request};
use super::scene::SceneBody;
use super::stated_step::{self, StatedGraspBody, StatedStep};
use super::typed;
use singulate_planner::check::{POSITION_TOLERANCE_RANGE, Terms};
use singulate_planner::cost::Cost;
use singulate_planner::scene::{Goal, Scene};
use singulate_planner::statement::{Deadlock, Statement, Verdict};

/// A scene and the answer to check.
#[derive(Debug, Clone, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct VerifyBody {
    /// The scene, as in a planning request.
    pub scene: SceneBody,
    /// The answer as it was served, or just its `relocations` and `target_grasp`.
    pub plan: PlanBody,
    /// How far an object may stand from the `from` of its step, m. Everything is checked at the places of `scene`, with the
    /// gripper's axis moved along. Above 0, stated slacks and gaps are not compared. Default: 0.
    #[schema(minimum = 0, maximum = 1, example = 0.002)]
    pub position_tolerance: Option<f64>,
    /// True if `plan` has only the steps that are left, or the next one. Then only `relocations` and `target_grasp` are
    /// checked, without stated slacks and gaps, and `target_grasp` may be absent. Default: false.
    #[schema(example = false)]
    pub partial: Option<bool>,
}

/// The answer to check. Parts that are absent or null are not checked.
#[derive(Debug, Clone, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct PlanBody {
    /// The verdict. If it is absent, `target_grasp` is required, unless the goal is to take objects away.
    pub verdict: Option<VerdictWord>,
    /// Not checked.
    #[schema(example = "cell-4/17")]
    pub scene_id: Option<String>,
    /// The target. It must be the scene's own. With `any_of` it is the candidate that is grasped, and `target_grasp` needs it.
    #[schema(example = "plate-1")]
    pub target: Option<String>,
    /// The steps, in order.
    #[schema(example = json!([{
        "action": "pick_place", "object": "plate-2", "from": {"x": 0.4, "y": 0.2}, "to": {"x": 1.1, "y": 0.6},
        "grasp": {"x": 0.4, "y": 0.2, "yaw": 0.31, "slack": 0.12},
        "release": {"x": 1.1, "y": 0.6, "yaw": 1.02, "slack": 0.5}, "gap": 0.031
    }]))]
    pub relocations: Vec<StatedStep>,
    /// The grasp of the target after all relocations.
    pub target_grasp: Option<StatedGraspBody>,
    /// The number of steps.
    #[schema(minimum = 0, maximum = 1000000000, example = 1)]
    pub cost: Option<u32>,
    /// The claimed bound: no plan has fewer steps.
    #[schema(minimum = 0, maximum = 1000000000, example = 1)]
    pub lower_bound: Option<u32>,
    /// The claim that no plan has fewer steps than this one.
    #[schema(example = true)]
    pub optimal: Option<bool>,
    /// The proof of the bound: every plan moves at least one object of each set.
    #[schema(example = json!([["plate-2", "plate-5"]]))]
    pub landmarks: Option<Vec<Vec<String>>>,
    /// The proof of a deadlock.
    pub deadlock: Option<StatedDeadlock>,
    /// If there is no plan: objects that would reach the goal, moved in this order, if there were places for them.
    #[schema(example = json!(["plate-2"]))]
    pub needed: Option<Vec<String>>,
    /// Of a clearing: the lock of what can never be taken away.
    pub stuck: Option<StatedDeadlock>,
    /// Of a clearing: the ids of the objects that stay, those apart that the scene calls fixed.
    #[schema(example = json!(["plate-3"]))]
    pub left: Option<Vec<String>>,
    /// Of a clearing: the claim that no order takes more away.
    #[schema(example = true)]
    pub proven: Option<bool>,
    /// Not checked.
    #[schema(value_type = Option<Vec<AnyObject>>, example = json!([]))]
    pub warnings: (),
    /// Not checked.
    pub statistics: Option<AnyObject>,
}

/// An object whose fields are not described. The schema says so: without a word, some generators admit none.
#[derive(Debug, Clone, Copy)]
pub struct AnyObject(());

impl PartialSchema for AnyObject {
    fn schema() -> RefOr<Schema> {
        let any_field = AdditionalProperties::FreeForm(true);
        let object = ObjectBuilder::new().schema_type(Type::Object).additional_properties(Some(any_field));
        object.description(Some("An object with any fields.")).into()
    }
}

impl ToSchema for AnyObject {}

/// The lock of an answer to check.
#[derive(Debug, Clone, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct StatedDeadlock {
    /// The ids of the greatest lock.
    #[schema(example = json!(["plate-1", "plate-2", "vase"]))]
    pub blocked: Vec<String>,
    /// The ids of a minimal lock within `blocked`.
    #[schema(example = json!(["plate-1", "vase"]))]
    pub core: Vec<String>,
}

/// A valid verification request.
#[derive(Debug, Clone)]
pub struct VerifyRequest {
    /// The scene.
    pub request: PlanRequest,
    /// The stated answer.
    pub statement: Statement,
    /// The terms on which it is checked.
    pub terms: Terms,
}

impl AsRef<PlanRequest> for VerifyRequest {
    fn as_ref(&self) -> &PlanRequest {
        &self.request
    }
}

const VERIFY: FieldNames = FieldNames::of(&["scene", "plan", "position_tolerance", "partial"]);
const PLAN: FieldNames = FieldNames::of(&[
    "verdict",
    "scene_id",
    "target",
    "relocations",
    "target_grasp",
    "cost",
    "lower_bound",
    "optimal",
    "landmarks",
    "deadlock",
    "needed",
    "stuck",
    "left",
    "proven",
    "warnings",
    "statistics",
]);
const DEADLOCK: FieldNames = FieldNames::of(&["blocked", "core"]);

/// The greatest count that may be stated; far above any that can hold.
const MAX_COUNT: u64 = 1_000_000_000;

/// Read a scene and a stated answer.
///
/// # Errors
/// A problem with every fault of the body.
pub fn read_verify(body: &[u8], limits: &RequestLimits) -> Result<VerifyRequest, Problem> {
    sound(body, limits).map_or_else(|| walked(body, limits), Ok)
}

pub(super) fn sound(body: &[u8], limits: &RequestLimits) -> Option<VerifyRequest> {
    let (stated, plan, terms) = typed::verification(body, limits)?;
    let request = stated.sound(&Path::Root.field("scene"), limits)?;
    let statement = read_plan(plan.as_bytes(), &request.scene, terms.partial).ok()?;
    Some(VerifyRequest { request, statement, terms })
}

pub(super) fn walked(body: &[u8], limits: &RequestLimits) -> Result<VerifyRequest, Problem> {
    let (value, mut faults) = parse(body)?;
    let request = verify(JsonNode::root(&value), limits, &mut faults);
    faults.judge(request)
}

/// Read a stated answer alone, or a part of its plan. Its `target`, if any, must be the scene's, or one of its candidates.
///
/// # Errors
/// A problem with every fault of the body.
pub fn read_plan(body: &[u8], scene: &Scene, partial: bool) -> Result<Statement, Problem> {
    let (value, mut faults) = parse(body)?;
    let statement = plan(JsonNode::root(&value), Some(scene), partial, &mut faults);
    faults.judge(statement)
}

fn verify(node: JsonNode<'_>, limits: &RequestLimits, faults: &mut RequestFaults) -> Option<VerifyRequest> {
    let fields = node.fields(&VERIFY, faults)?;
    let request = fields.required("scene", faults, |node, faults| request(node, &REQUEST, limits, faults));
    let scene = request.as_ref().map(|PlanRequest { scene, .. }| scene);
    let position_tolerance = fields
        .optional("position_tolerance", 0.0, faults, |node, faults| node.ranged(POSITION_TOLERANCE_RANGE, faults));
    let partial = fields.optional("partial", false, faults, |node, faults| node.boolean(faults));
    // Where it can't be read, nothing is asked for that a part of a plan may lack.
    let lenient = partial.unwrap_or(true);
    let statement = fields.required("plan", faults, |node, faults| plan(node, scene, lenient, faults));
    let terms = Terms { position_tolerance: position_tolerance?, partial: partial? };
    Some(VerifyRequest { statement: statement?, request: request?, terms })
}

fn plan(node: JsonNode<'_>, scene: Option<&Scene>, partial: bool, faults: &mut RequestFaults) -> Option<Statement> {
    let fields = node.fields(&PLAN, faults)?;
    let verdict = fields.stated("verdict", faults, |node, faults| {
        node.word(&Verdict::ALL.map(|verdict| (verdict.as_str(), verdict)), faults)
    });
    fields.stated("scene_id", faults, |node, faults| node.text(faults));
    let target = fields.stated("target", faults, |node, faults| target(node, scene, faults));
    let grasps = scene.is_none_or(|scene| !scene.goal().candidates().is_empty());
    let relocations = fields.required("relocations", faults, |node, faults| {
        // Unreadable steps are missing from this list, but their faults refuse the whole body.
        Some(
            node.list(faults, |node, faults| stated_step::read(node, faults).map(Some))?
                .into_iter()
                .flatten()
                .collect(),
        )
    });
    // Without a verdict, only the steps and the last grasp can be checked.
    if !partial && grasps && !fields.states("verdict") && !fields.states("target_grasp") {
        fields.missing("target_grasp", faults);
    }
    fields.stated("warnings", faults, |node, faults| node.list(faults, |node, faults| node.any_object(faults)));
    fields.stated("statistics", faults, |node, faults| node.any_object(faults));
    let count = |node: JsonNode<'_>, faults: &mut RequestFaults| node.whole((0, MAX_COUNT), faults).map(Cost::new);
    Some(Statement {
        verdict,
        relocations,
        target: target.filter(|_| scene.is_none_or(|scene| scene.target().is_none())),
        target_grasp: fields.stated("target_grasp", faults, stated_step::read_grasp),
        cost: fields.stated("cost", faults, count),
        lower_bound: fields.stated("lower_bound", faults, count),
        optimal: fields.stated("optimal", faults, |node, faults| node.boolean(faults)),
        landmarks: fields.stated("landmarks", faults, |node, faults| node.list(faults, ids)),
        deadlock: fields.stated("deadlock", faults, deadlock),
        needed: fields.stated("needed", faults, ids),
        stuck: fields.stated("stuck", faults, deadlock),
        left: fields.stated("left", faults, ids),
        proven: fields.stated("proven", faults, |node, faults| node.boolean(faults)),
    })
}

/// The target of a plan, which must go with the goal of the scene, if that is known.
fn target(node: JsonNode<'_>, scene: Option<&Scene>, faults: &mut RequestFaults) -> Option<String> {
    let stated = node.text(faults)?;
    let Some(scene) = scene else { return Some(stated) };
    let mut mismatch = |detail: fmt::Arguments<'_>| faults.add(ErrorCode::TargetMismatch, node.path(), detail);
    match scene.goal() {
        Goal::Target(wanted) => {
            let wanted = scene.object(*wanted).id();
            if wanted != stated {
                mismatch(format_args!("the plan is for '{stated}', the scene's target is '{wanted}'"));
            }
        }
        Goal::AnyOf(candidates) => {
            if !candidates.iter().any(|candidate| scene.object(*candidate).id() == stated) {
                mismatch(format_args!("the plan is for '{stated}', which is no candidate of the scene"));
            }
        }
        Goal::AllOf(_) | Goal::Clear => {
            mismatch(format_args!("the plan is for '{stated}', and the scene's goal is to take objects away"));
        }
    }
    Some(stated)
}

fn deadlock(node: JsonNode<'_>, faults: &mut RequestFaults) -> Option<Deadlock> {
    let fields = node.fields(&DEADLOCK, faults)?;
    let blocked = fields.required("blocked", faults, ids);
    let core = fields.required("core", faults, ids);
    Some(Deadlock { blocked: blocked?, core: core? })
}

fn ids(node: JsonNode<'_>, faults: &mut RequestFaults) -> Option<Vec<String>> {
    node.list(faults, |node, faults| node.text(faults))
}
