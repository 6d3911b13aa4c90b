//! An answer as JSON: a view of the statement that was checked.

use core::time::Duration;

use serde::Serialize;
use utoipa::ToSchema;

use super::finding;
use super::glance::Glance;
use super::plan_request::PlanRequest;
use super::problem::WarningItem;
use super::step::{GraspBody, StepBody};
use singulate_planner::cost::Cost;
use singulate_planner::paper::Judged;
use singulate_planner::plan::{Answer, Statistics};
use singulate_planner::scene::Goal;
use singulate_planner::statement::{Deadlock, Verdict};

/// The answer to a planning request. A client must refuse a verdict that it doesn't know.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct AnswerBody<'a> {
    /// The outcome of planning.
    #[schema(value_type = VerdictWord, required = true)]
    pub verdict: Option<&'static str>,
    /// The request's own `scene_id`.
    #[schema(required = true, example = "cell-4/17")]
    pub scene_id: Option<&'a str>,
    /// The id of the object that is grasped in the end. Null for `all_of` and `clear`; and for `any_of` where there is no plan,
    /// unless `needed` frees one of the candidates.
    #[schema(required = true, example = "plate-1")]
    pub target: Option<&'a str>,
    /// The plan, in order of execution. Empty if there is no plan or no relocation is needed.
    #[schema(example = json!([{
        "action": "pick_place", "object": "plate-2", "from": {"x": 0.4, "y": 0.2}, "to": {"x": 1.1, "y": 0.6},
        "grasp": {"x": 0.4, "y": 0.2, "yaw": 0.31, "slack": 0.12},
        "release": {"x": 1.1, "y": 0.6, "yaw": 1.02, "slack": 0.5}, "gap": 0.031
    }]))]
    pub relocations: Vec<StepBody<'a>>,
    /// The grasp of the target after all relocations. Null if there is no plan, and for `all_of` and `clear`.
    #[schema(required = true)]
    pub target_grasp: Option<GraspBody>,
    /// The number of steps. Null if there is no plan.
    #[schema(value_type = Option<usize>, required = true, example = 1)]
    pub cost: Option<u64>,
    /// The proven lower bound: no plan has fewer steps. Null for a deadlock and for a clearing. With a method of the paper it
    /// is also null if nothing is proven.
    #[schema(value_type = Option<usize>, required = true, example = 1)]
    pub lower_bound: Option<u64>,
    /// True if no plan has fewer steps than this one. Null if no plan passes its check or no bound is proven, and for a
    /// clearing.
    #[schema(required = true, example = true)]
    pub optimal: Option<bool>,
    /// The proof of the bound: every plan moves at least one object of each set. Null if `lower_bound` is null.
    #[schema(required = true, example = json!([["plate-2", "plate-5"]]))]
    pub landmarks: Option<&'a [Vec<String>]>,
    /// The proof that no sequence of steps reaches the goal. Null for any other verdict. With a method of the
    /// paper it is also null if the deadlock is not proven.
    #[schema(required = true)]
    pub deadlock: Option<DeadlockBody<'a>>,
    /// For `no_space` and `timed_out`: objects that would reach the goal, moved in this order, if there were places
    /// for them. Null for other verdicts, or if none are known.
    #[schema(required = true, example = json!(["plate-2"]))]
    pub needed: Option<&'a [String]>,
    /// Only there for a clearing: the lock of the objects that can never be taken away, or null.
    #[schema(value_type = Option<DeadlockBody>)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stuck: Option<Option<DeadlockBody<'a>>>,
    /// Only there for a clearing: the ids of the objects that stay, those apart that the request calls fixed.
    #[schema(value_type = Vec<String>, required = false, example = json!(["plate-3"]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left: Option<&'a [String]>,
    /// Only there for a clearing: true if no order takes more objects away. False if that is not known.
    #[schema(value_type = bool, required = false, example = true)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub proven: Option<bool>,
    /// Warnings about the scene. With a method of the paper also the faults that our own methods find in the answer.
    #[schema(example = json!([{
        "code": "overlap",
        "pointer": "/objects/2",
        "detail": "overlaps 'plate-1' by 0.000400 m (tolerance 0.001 m)"
    }]))]
    pub warnings: Vec<WarningItem>,
    /// How long each phase took. It differs from run to run.
    pub statistics: StatisticsBody,
}

/// The outcome of planning.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(example = "relocate")]
pub enum VerdictWord {
    /// The target can be grasped as the table stands.
    Graspable,
    /// The plan reaches the goal.
    Relocate,
    /// No sequence of steps can ever reach the goal. Where one of the paper's methods was asked for, only proven
    /// if `deadlock` is not null.
    Deadlock,
    /// No checked plan was found before the effort limit; not a proof.
    NoSpace,
    /// The time limit came first, with no plan in hand.
    TimedOut,
    /// The steps take away all that the request does not call fixed.
    Cleared,
    /// The steps take away what can go, or what was found in time; `left` names the rest.
    PartlyCleared,
}

/// Objects that lock each other: at every yaw of each movable one, another of them blocks a finger.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, ToSchema)]
pub struct DeadlockBody<'a> {
    /// The ids of the greatest lock. It holds the target, all candidates, or one of the objects that are wanted away; and fixed
    /// objects that block a member.
    #[schema(example = json!(["plate-1", "plate-2", "vase"]))]
    pub blocked: &'a [String],
    /// The ids of a minimal lock within `blocked`: without any one of them the rest is no lock.
    #[schema(example = json!(["plate-1", "vase"]))]
    pub core: &'a [String],
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
    /// The independent check, ms. With a method of the paper also our own search, which judges its answer.
    #[schema(example = 0.02)]
    pub check_ms: f64,
}

impl<'a> AnswerBody<'a> {
    /// The answer to a request: a view of the statement that the checker confirmed.
    pub fn new(request: &'a PlanRequest, judged: &'a Judged) -> Self {
        let Judged { answer: Answer { statement, statistics }, .. } = judged;
        let scene = &request.scene;
        let clears = *scene.goal() == Goal::Clear;
        Self {
            verdict: statement.verdict.map(Verdict::as_str),
            scene_id: request.scene_id.as_deref(),
            target: scene.target().map(|target| scene.object(target).id()).or(statement.target.as_deref()),
            relocations: statement.steps().iter().map(StepBody::new).collect(),
            target_grasp: statement.target_grasp.map(GraspBody::from),
            cost: statement.cost.map(Cost::get),
            lower_bound: statement.lower_bound.map(Cost::get),
            optimal: statement.optimal,
            landmarks: statement.landmarks.as_deref(),
            deadlock: statement.deadlock.as_ref().map(DeadlockBody::new),
            needed: statement.needed.as_deref(),
            stuck: clears.then(|| statement.stuck.as_ref().map(DeadlockBody::new)),
            left: statement.left.as_deref(),
            proven: statement.proven,
            warnings: warnings(request, judged),
            statistics: StatisticsBody::new(statistics),
        }
    }

    /// The answer to a request that was too large to be read in its time: `timed_out`. `None` if even the kind of goal is
    /// unknown, and for a clearing: what is left can't be named.
    pub fn unread(glance: &'a Glance) -> Option<Self> {
        Some(Self {
            verdict: Some(Verdict::TimedOut.as_str()),
            scene_id: glance.scene_id.as_deref(),
            target: glance.target.as_ref()?.id(),
            relocations: Vec::new(),
            target_grasp: None,
            cost: None,
            lower_bound: Some(0),
            optimal: None,
            landmarks: Some(&[]),
            deadlock: None,
            needed: None,
            stuck: None,
            left: None,
            proven: None,
            warnings: Vec::new(),
            statistics: StatisticsBody::new(&Statistics::default()),
        })
    }
}

/// Warnings about the scene, then about the answer. Pointers refer to the request.
pub fn warnings(request: &PlanRequest, judged: &Judged) -> Vec<WarningItem> {
    let of_answer = judged.warnings.iter().map(|warning| finding::warning(&request.scene, warning));
    request.warnings.iter().cloned().chain(of_answer).collect()
}

impl<'a> DeadlockBody<'a> {
    fn new(Deadlock { blocked, core }: &'a Deadlock) -> Self {
        Self { blocked, core }
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
