//! A survey as JSON.

use serde::Serialize;
use utoipa::ToSchema;

use singulate_planner::cost::Cost;
use singulate_planner::plan::{SurveyEntry, SurveyVerdict};
use singulate_planner::scene::Scene;

/// Each object that can be grasped at all, as the target. No places are searched for.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, ToSchema)]
pub struct SurveyBody {
    /// The objects that are neither fixed nor too wide nor without a grasp, in the order of the request.
    #[schema(example = json!([{"id": "plate-1", "verdict": "relocate", "lower_bound": 2, "optimal": true}]))]
    pub objects: Vec<SurveyedObject>,
}

/// One object as the target.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, ToSchema)]
pub struct SurveyedObject {
    /// The object's id.
    #[schema(example = "plate-1")]
    pub id: String,
    /// The verdict for this object as the target.
    pub verdict: SurveyWord,
    /// The proven lower bound: no plan has fewer relocations. Null for a deadlock.
    #[schema(value_type = Option<usize>, required = true, example = 2)]
    pub lower_bound: Option<u64>,
    /// True if that many relocations suffice, provided that there are places for them. Null for a deadlock.
    #[schema(required = true, example = true)]
    pub optimal: Option<bool>,
}

/// The verdict for one object as the target.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(example = "relocate")]
pub enum SurveyWord {
    /// It can be grasped as the table stands.
    Graspable,
    /// Some set of relocations frees it, if places for them are found.
    Relocate,
    /// Nothing frees it.
    Deadlock,
    /// Not decided in time.
    TimedOut,
}

impl SurveyBody {
    /// The survey of a scene.
    pub fn new(scene: &Scene, entries: &[SurveyEntry]) -> Self {
        Self { objects: entries.iter().map(|entry| SurveyedObject::new(scene, entry)).collect() }
    }

    /// The survey with nothing decided, for a time-out before it began.
    pub fn timed_out(scene: &Scene) -> Self {
        let movable = scene.objects().iter().filter(|object| object.can_be_grasped());
        let objects = movable.map(|object| SurveyedObject {
            id: object.id().to_owned(),
            verdict: SurveyWord::TimedOut,
            lower_bound: Some(0),
            optimal: Some(false),
        });
        Self { objects: objects.collect() }
    }
}

impl SurveyedObject {
    fn new(scene: &Scene, entry: &SurveyEntry) -> Self {
        let verdict = match entry.verdict {
            SurveyVerdict::Graspable => SurveyWord::Graspable,
            SurveyVerdict::Relocate => SurveyWord::Relocate,
            SurveyVerdict::Deadlock => SurveyWord::Deadlock,
            SurveyVerdict::TimedOut => SurveyWord::TimedOut,
        };
        let id = scene.object(entry.object).id().to_owned();
        Self { id, verdict, lower_bound: entry.lower_bound.map(Cost::get), optimal: entry.optimal }
    }
}
