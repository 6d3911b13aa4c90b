//! An answer as JSON.

use core::fmt;
use core::time::Duration;

use nalgebra::Point2;
use serde::Serialize;
use utoipa::ToSchema;

use super::finding;
use super::glance::Glance;
use super::plan_request::PlanRequest;
use super::problem::WarningItem;
use singulate_planner::plan::{Answer, Deadlock, Grasp, LowerBound, Plan, Relocation, Statistics, Unplanned, Verdict};
use singulate_planner::scene::{ObjectIndex, Scene};

/// The answer to a planning request. A client must refuse a verdict that it doesn't know.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct AnswerBody {
    /// What was found.
    pub verdict: VerdictWord,
    /// The request's own `scene_id`.
    #[schema(required = true, example = "cell-4/17")]
    pub scene_id: Option<String>,
    /// The id of the object that is wanted.
    #[schema(example = "plate-1")]
    pub target: String,
    /// The plan, in order of execution; empty where there is none or none is needed.
    #[schema(example = json!([{
        "action": "pick_place", "object": "plate-2", "from": {"x": 0.4, "y": 0.2}, "to": {"x": 1.1, "y": 0.6},
        "grasp": {"yaw": 0.31, "slack": 0.12}, "release": {"yaw": 1.02, "slack": 0.5}, "gap": 0.031
    }]))]
    pub relocations: Vec<RelocationBody>,
    /// How the target is grasped in the end; null where there is no plan.
    #[schema(required = true)]
    pub target_grasp: Option<GraspBody>,
    /// The count of relocations; null where there is no plan.
    #[schema(required = true, example = 1)]
    pub cost: Option<usize>,
    /// No plan has fewer relocations, proven; null for a deadlock, and where one of the paper's methods was asked for and
    /// nothing is proven.
    #[schema(required = true, example = 1)]
    pub lower_bound: Option<usize>,
    /// True if no plan has fewer relocations than this one; null where there is no plan that passes its check, or nothing
    /// is proven.
    #[schema(required = true, example = true)]
    pub optimal: Option<bool>,
    /// The proof of the bound: of each set of ids every plan moves at least one. Null where `lower_bound` is.
    #[schema(required = true, example = json!([["plate-2", "plate-5"]]))]
    pub landmarks: Option<Vec<Vec<String>>>,
    /// Why nothing frees the target; null for any other verdict, and for an unproven deadlock of the paper's methods.
    #[schema(required = true)]
    pub deadlock: Option<DeadlockBody>,
    /// For `no_space` and `timed_out` the ids of the best known derivation, in order; null otherwise or where none is
    /// known.
    #[schema(required = true, example = json!(["plate-2"]))]
    pub needed: Option<Vec<String>>,
    /// What is worth knowing about the scene; for the paper's methods also what our own have against the answer.
    #[schema(example = json!([{
        "code": "overlap",
        "pointer": "/objects/2",
        "detail": "overlaps 'plate-1' by 0.000400 m (tolerance 0.001 m)"
    }]))]
    pub warnings: Vec<WarningItem>,
    /// How long each phase took; differs from run to run.
    pub statistics: StatisticsBody,
}

/// What was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(example = "relocate")]
pub enum VerdictWord {
    /// The target can be grasped as the table stands.
    Graspable,
    /// The plan frees the target.
    Relocate,
    /// No sequence of pick-and-place can ever free the target. Where one of the paper's methods was asked for, only proven
    /// if `deadlock` is not null.
    Deadlock,
    /// No checked plan was found before the effort limit; not a proof.
    NoSpace,
    /// The time limit came first, with no plan in hand.
    TimedOut,
}

impl fmt::Display for VerdictWord {
    /// Its name in JSON.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

/// One step of a plan. A client must refuse an action that it doesn't know.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct RelocationBody {
    /// The kind of step.
    pub action: ActionWord,
    /// The id of the object that is moved.
    #[schema(example = "plate-2")]
    pub object: String,
    /// Its centre before.
    pub from: PointBody,
    /// Its centre after.
    pub to: PointBody,
    /// How it is picked.
    pub grasp: GraspBody,
    /// How it is let go.
    pub release: GraspBody,
    /// Least distance to another object at the new place, edge to edge, m.
    #[schema(example = 0.031)]
    pub gap: f64,
}

/// The kind of step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(example = "pick_place")]
pub enum ActionWord {
    /// Pick an object up and place it elsewhere.
    PickPlace,
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

/// A yaw of the gripper that is free, with the room round it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, ToSchema)]
pub struct GraspBody {
    /// Direction of finger 0, rad, counter-clockwise from +x, in [0, 2π/k).
    #[schema(example = 0.31)]
    pub yaw: f64,
    /// The free angle on each side of the yaw, rad; π/k where nothing blocks.
    #[schema(example = 0.12)]
    pub slack: f64,
}

/// Objects that hold each other: at every yaw of every movable one some other of them blocks.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, ToSchema)]
pub struct DeadlockBody {
    /// The ids of the greatest lock, the target among them; fixed objects where they block a member.
    #[schema(example = json!(["plate-1", "plate-2", "vase"]))]
    pub blocked: Vec<String>,
    /// The ids of a least lock within it: take any one away, and the rest is no lock.
    #[schema(example = json!(["plate-1", "vase"]))]
    pub core: Vec<String>,
}

/// How long each phase took.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, ToSchema)]
pub struct StatisticsBody {
    /// Shadows, options and locks, ms.
    #[schema(example = 0.04)]
    pub knowledge_ms: f64,
    /// The least set of relocations and its proof, ms.
    #[schema(example = 0.01)]
    pub search_ms: f64,
    /// New places, ms.
    #[schema(example = 0.2)]
    pub placement_ms: f64,
    /// The independent check, ms; for the paper's methods our own search too, which judges them.
    #[schema(example = 0.02)]
    pub check_ms: f64,
}

impl AnswerBody {
    /// The answer to a request.
    pub fn new(request: &PlanRequest, answer: &Answer) -> Self {
        let scene = &request.scene;
        let blank = Self {
            warnings: warnings(request, answer),
            statistics: StatisticsBody::new(&answer.statistics),
            ..Self::blank(request.scene_id.clone(), id(scene, scene.target()))
        };
        match &answer.verdict {
            Verdict::Graspable(grasp) => blank.graspable(*grasp, answer.optimal()),
            Verdict::Relocate(plan) => blank.relocate(scene, plan, answer.optimal()),
            Verdict::Deadlock(deadlock) => blank.deadlock(scene, deadlock.as_ref()),
            Verdict::NoSpace(unplanned) => blank.unplanned(VerdictWord::NoSpace, scene, unplanned),
            Verdict::TimedOut(unplanned) => blank.unplanned(VerdictWord::TimedOut, scene, unplanned),
        }
    }

    /// The answer to a request that was too large to be read in its time: `timed_out`. `None` if even the target is
    /// unknown.
    pub fn unread(glance: &Glance) -> Option<Self> {
        let blank = Self::blank(glance.scene_id.clone(), glance.target.clone()?);
        let blank = Self { verdict: VerdictWord::TimedOut, ..blank };
        Some(Self { lower_bound: Some(0), landmarks: Some(Vec::new()), ..blank })
    }

    fn blank(scene_id: Option<String>, target: String) -> Self {
        Self {
            verdict: VerdictWord::Graspable,
            scene_id,
            target,
            relocations: Vec::new(),
            target_grasp: None,
            cost: None,
            lower_bound: None,
            optimal: None,
            landmarks: None,
            deadlock: None,
            needed: None,
            warnings: Vec::new(),
            statistics: StatisticsBody::new(&Statistics::default()),
        }
    }

    fn graspable(self, grasp: Grasp, optimal: Option<bool>) -> Self {
        let target_grasp = Some(GraspBody::new(grasp));
        Self { cost: Some(0), lower_bound: Some(0), landmarks: Some(Vec::new()), optimal, target_grasp, ..self }
    }

    fn relocate(self, scene: &Scene, plan: &Plan, optimal: Option<bool>) -> Self {
        Self {
            verdict: VerdictWord::Relocate,
            relocations: plan.relocations.iter().map(|step| RelocationBody::new(scene, step)).collect(),
            target_grasp: Some(GraspBody::new(plan.target_grasp)),
            cost: Some(plan.cost()),
            optimal,
            ..self
        }
        .bounded(scene, plan.bound.as_ref())
    }

    fn deadlock(self, scene: &Scene, proof: Option<&Deadlock>) -> Self {
        let deadlock =
            proof.map(|proof| DeadlockBody { blocked: ids(scene, &proof.blocked), core: ids(scene, &proof.core) });
        Self { verdict: VerdictWord::Deadlock, deadlock, ..self }
    }

    fn unplanned(self, verdict: VerdictWord, scene: &Scene, unplanned: &Unplanned) -> Self {
        let needed = unplanned.needed.as_ref().map(|needed| ids(scene, needed));
        Self { verdict, needed, ..self }.bounded(scene, unplanned.bound.as_ref())
    }

    fn bounded(self, scene: &Scene, bound: Option<&LowerBound>) -> Self {
        let landmarks = bound.map(|bound| bound.landmarks.iter().map(|set| ids(scene, set)).collect());
        Self { lower_bound: bound.map(|bound| bound.cost), landmarks, ..self }
    }
}

/// Warnings about the scene, then about the answer. Pointers refer to the request.
pub fn warnings(request: &PlanRequest, answer: &Answer) -> Vec<WarningItem> {
    let of_answer = answer.warnings.iter().map(|warning| finding::warning(&request.scene, warning));
    request.warnings.iter().cloned().chain(of_answer).collect()
}

impl RelocationBody {
    fn new(scene: &Scene, step: &Relocation) -> Self {
        Self {
            action: ActionWord::PickPlace,
            object: id(scene, step.object),
            from: PointBody::new(step.from),
            to: PointBody::new(step.to),
            grasp: GraspBody::new(step.grasp),
            release: GraspBody::new(step.release),
            gap: step.gap,
        }
    }
}

impl PointBody {
    fn new(point: Point2<f64>) -> Self {
        Self { x: point.x, y: point.y }
    }
}

impl GraspBody {
    fn new(grasp: Grasp) -> Self {
        Self { yaw: grasp.yaw, slack: grasp.slack }
    }
}

impl StatisticsBody {
    fn new(statistics: &Statistics) -> Self {
        // Whole nanoseconds, so that 15.72 µs is not written as 0.015719999999999998.
        let ms = |duration: Duration| (duration.as_secs_f64() * 1e9).round() / 1e6;
        Self {
            knowledge_ms: ms(statistics.knowledge),
            search_ms: ms(statistics.search),
            placement_ms: ms(statistics.placement),
            check_ms: ms(statistics.check),
        }
    }
}

fn id(scene: &Scene, object: ObjectIndex) -> String {
    scene.object(object).id().to_owned()
}

fn ids(scene: &Scene, objects: &[ObjectIndex]) -> Vec<String> {
    objects.iter().map(|object| id(scene, *object)).collect()
}
