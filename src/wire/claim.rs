//! Reads a stated answer from JSON.

use nalgebra::Point2;

use super::code::ErrorCode;
use super::limits::RequestLimits;
use super::path::Path;
use super::plan_request::PlanRequest;
use super::problem::Problem;
use super::reader::{Faults, Names, Node, parse};
use super::request::{REQUEST, request};
use super::typed;
use singulate_planner::plan::{Claim, ClaimedDeadlock, ClaimedGrasp, ClaimedRelocation, VerdictName};
use singulate_planner::scene::{COORDINATE_RANGE, Scene};

/// A valid verification request.
#[derive(Debug, Clone)]
pub struct VerifyRequest {
    /// The scene.
    pub request: PlanRequest,
    /// The stated answer.
    pub claim: Claim,
}

impl AsRef<PlanRequest> for VerifyRequest {
    fn as_ref(&self) -> &PlanRequest {
        &self.request
    }
}

const VERIFY: Names = Names::of(&["scene", "plan"]);
const PLAN: Names = Names::of(&[
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
    "warnings",
    "statistics",
]);
const RELOCATION: Names = Names::of(&["action", "object", "from", "to", "grasp", "release", "gap"]);
const POINT: Names = Names::of(&["x", "y"]);
const GRASP: Names = Names::of(&["yaw", "slack"]);
const DEADLOCK: Names = Names::of(&["blocked", "core"]);

/// The greatest count that may be stated; far above any that can hold.
const MAX_COUNT: u64 = 1_000_000_000;

const VERDICTS: [(&str, VerdictName); 5] = [
    ("graspable", VerdictName::Graspable),
    ("relocate", VerdictName::Relocate),
    ("deadlock", VerdictName::Deadlock),
    ("no_space", VerdictName::NoSpace),
    ("timed_out", VerdictName::TimedOut),
];

/// Read a scene and a stated answer.
///
/// # Errors
/// A problem with every fault of the body.
pub fn read_verify(body: &[u8], limits: &RequestLimits) -> Result<VerifyRequest, Problem> {
    sound(body, limits).map_or_else(|| walked(body, limits), Ok)
}

pub(super) fn sound(body: &[u8], limits: &RequestLimits) -> Option<VerifyRequest> {
    let (stated, plan) = typed::verification(body, limits)?;
    let request = stated.sound(&Path::Root.field("scene"), limits)?;
    let claim = read_plan(plan.as_bytes(), &request.scene).ok()?;
    Some(VerifyRequest { request, claim })
}

pub(super) fn walked(body: &[u8], limits: &RequestLimits) -> Result<VerifyRequest, Problem> {
    let (value, mut faults) = parse(body)?;
    let request = verify(Node::root(&value), limits, &mut faults);
    faults.judge(request)
}

/// Read a stated answer alone. Its `target`, if any, must be the scene's.
///
/// # Errors
/// A problem with every fault of the body.
pub fn read_plan(body: &[u8], scene: &Scene) -> Result<Claim, Problem> {
    let (value, mut faults) = parse(body)?;
    let target = scene.object(scene.target()).id();
    let claim = plan(Node::root(&value), Some(target), &mut faults);
    faults.judge(claim)
}

fn verify(node: Node<'_>, limits: &RequestLimits, faults: &mut Faults) -> Option<VerifyRequest> {
    let fields = node.fields(&VERIFY, faults)?;
    let request = fields.required("scene", faults, |node, faults| request(node, &REQUEST, limits, faults));
    let target = request.as_ref().map(|PlanRequest { scene, .. }| scene.object(scene.target()).id());
    let claim = fields.required("plan", faults, |node, faults| plan(node, target, faults));
    Some(VerifyRequest { claim: claim?, request: request? })
}

fn plan(node: Node<'_>, scene_target: Option<&str>, faults: &mut Faults) -> Option<Claim> {
    let fields = node.fields(&PLAN, faults)?;
    let verdict = fields.stated("verdict", faults, |node, faults| node.word(&VERDICTS, faults));
    fields.stated("scene_id", faults, |node, faults| node.text(faults));
    fields.stated("target", faults, |node, faults| target(node, scene_target, faults));
    let relocations = fields.required("relocations", faults, |node, faults| {
        // Unreadable steps are missing from this list, but their faults refuse the whole body.
        Some(node.list(faults, |node, faults| relocation(node, faults).map(Some))?.into_iter().flatten().collect())
    });
    // Without a verdict, only the steps and the last grasp can be checked.
    if !fields.states("verdict") && !fields.states("target_grasp") {
        fields.missing("target_grasp", faults);
    }
    fields.stated("warnings", faults, |node, faults| node.list(faults, |node, faults| node.any_object(faults)));
    fields.stated("statistics", faults, |node, faults| node.any_object(faults));
    let count = |node: Node<'_>, faults: &mut Faults| node.whole((0, MAX_COUNT), faults);
    Some(Claim {
        verdict,
        relocations,
        target_grasp: fields.stated("target_grasp", faults, grasp),
        cost: fields.stated("cost", faults, count),
        lower_bound: fields.stated("lower_bound", faults, count),
        optimal: fields.stated("optimal", faults, |node, faults| node.boolean(faults)),
        landmarks: fields.stated("landmarks", faults, |node, faults| node.list(faults, ids)),
        deadlock: fields.stated("deadlock", faults, deadlock),
        needed: fields.stated("needed", faults, ids),
    })
}

fn target(node: Node<'_>, scene_target: Option<&str>, faults: &mut Faults) -> Option<()> {
    let stated = node.text(faults)?;
    if let Some(wanted) = scene_target.filter(|wanted| *wanted != stated) {
        let detail = format_args!("the plan is for '{stated}', the scene's target is '{wanted}'");
        faults.add(ErrorCode::TargetMismatch, node.path(), detail);
    }
    Some(())
}

fn relocation(node: Node<'_>, faults: &mut Faults) -> Option<ClaimedRelocation> {
    let fields = node.fields(&RELOCATION, faults)?;
    fields.stated("action", faults, |node, faults| node.word(&[("pick_place", ())], faults));
    let object = fields.required("object", faults, |node, faults| node.text(faults));
    let from = fields.stated("from", faults, point);
    let to = fields.required("to", faults, point);
    let grasp_yaw = fields.required("grasp", faults, grasp);
    let release = fields.required("release", faults, grasp);
    let gap = fields.stated("gap", faults, |node, faults| node.number(faults));
    Some(ClaimedRelocation { object: object?, from, to: to?, grasp: grasp_yaw?, release: release?, gap })
}

fn point(node: Node<'_>, faults: &mut Faults) -> Option<Point2<f64>> {
    let fields = node.fields(&POINT, faults)?;
    let x = fields.required("x", faults, coordinate);
    let y = fields.required("y", faults, coordinate);
    Some(Point2::new(x?, y?))
}

fn coordinate(node: Node<'_>, faults: &mut Faults) -> Option<f64> {
    let value = node.number(faults)?;
    let (min, max) = COORDINATE_RANGE;
    if !(min..=max).contains(&value) {
        faults.add(ErrorCode::OutOfRange, node.path(), format_args!("{value} is not between {min} and {max}"));
    }
    Some(value)
}

fn grasp(node: Node<'_>, faults: &mut Faults) -> Option<ClaimedGrasp> {
    let fields = node.fields(&GRASP, faults)?;
    let yaw = fields.number("yaw", faults);
    let slack = fields.stated("slack", faults, |node, faults| node.number(faults));
    Some(ClaimedGrasp { yaw: yaw?, slack })
}

fn deadlock(node: Node<'_>, faults: &mut Faults) -> Option<ClaimedDeadlock> {
    let fields = node.fields(&DEADLOCK, faults)?;
    let blocked = fields.required("blocked", faults, ids);
    let core = fields.required("core", faults, ids);
    Some(ClaimedDeadlock { blocked: blocked?, core: core? })
}

fn ids(node: Node<'_>, faults: &mut Faults) -> Option<Vec<String>> {
    node.list(faults, |node, faults| node.text(faults))
}
