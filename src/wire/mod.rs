//! Scene, answer and problem as JSON. Only this room knows the format.
//!
//! A sound scene is read straight into a draft. Any other, and all else, is read as a JSON value and walked, so that faults of
//! shape are told together with those of meaning, each with its JSON pointer.

mod answer;
mod code;
mod drop_off;
mod finding;
mod glance;
mod goal;
mod job;
mod job_request;
mod json;
mod knowledge;
mod limits;
mod listed_grasp;
mod malformed;
mod object;
mod path;
mod plan_request;
mod problem;
mod reader;
mod request;
mod scene;
mod settings;
mod shape;
mod shape_reader;
mod stated_step;
mod statement;
mod step;
mod strict;
mod survey;
mod table1;
mod table2;
mod typed;
mod verification;
mod walk;

pub use answer::{AnswerBody, DeadlockBody, StatisticsBody, VerdictWord, warnings};
pub use code::ErrorCode;
pub use drop_off::DropOffBody;
pub use glance::Glance;
pub use goal::GoalBody;
pub use job::{
    BatchBody, IncumbentBody, JobBody, JobListBody, JobSceneBody, JobStateWord, JobsBody, RawJson, queued_job,
};
pub use job_request::{JobRequest, read_batch, read_job};
pub use knowledge::{HistogramBody, KnowledgeBody, KnownGraspBody, KnownObject, ShadowBody};
pub use limits::{MAX_BATCH, MAX_CALLBACK_URL_LENGTH, MAX_SCENE_ID_LENGTH, PRIORITY_RANGE, RequestLimits};
pub use listed_grasp::ListedGraspBody;
pub use object::ObjectBody;
pub use plan_request::PlanRequest;
pub use problem::{ErrorItem, LoggedProblem, Problem, ProblemKind, WarningItem};
pub use request::read_scene;
pub use scene::{GripperBody, OpeningWord, RectangleBody, SceneBody, TableBody};
pub use settings::{DestinationWord, GraspModelWord, ObjectiveWord, PlacementWord, SearchWord, SettingsBody};
pub use shape::{
    CapsuleShape, CapsuleWord, DiscShape, DiscWord, PolygonShape, PolygonWord, RectangleShape, RectangleWord,
    ShapeBody, ShapePoint,
};
pub use stated_step::{StatedGraspBody, StatedPickDrop, StatedPickPlace, StatedPoseBody, StatedStep};
pub use statement::{AnyObject, PlanBody, StatedDeadlock, VerifyBody, VerifyRequest, read_plan, read_verify};
pub use step::{GraspBody, PickDropBody, PickDropWord, PickPlaceBody, PickPlaceWord, PoseBody, StepBody};
pub use survey::{SurveyBody, SurveyWord, SurveyedObject};
pub use table1::{MethodBody, ModelBody, PaperBody, PaperMethodBody, PlansBody, Table1Body, Table1ColumnBody};
pub use table2::{PaperRepositionBody, PlacementBody, Table2Body, Table2ColumnBody};
pub use verification::{FaultBody, VerificationBody};

#[cfg(test)]
mod tests;
