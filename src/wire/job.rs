//! A job as JSON: schema and serialisation.

use core::ops::Deref;
use core::str::FromStr;
use std::sync::Arc;

use serde::{Serialize, Serializer};
use serde_json::value::{RawValue, to_raw_value};
use serde_json::{Value, json};
use utoipa::ToSchema;

use super::answer::AnswerBody;
use super::drop_off::DropOffBody;
use super::goal::GoalBody;
use super::object::ObjectBody;
use super::problem::Problem;
use super::scene::{GripperBody, TableBody};
use super::settings::SettingsBody;
use singulate_planner::search::Incumbent;

/// A scene to plan for later: the body of a planning request with two more fields.
#[derive(Debug, Clone, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct JobSceneBody {
    /// The caller's name for the scene. It comes back in the job and the answer, and is logged.
    #[schema(max_length = 256, example = "cell-4/17")]
    pub scene_id: Option<String>,
    /// The table.
    pub table: TableBody,
    /// The gripper.
    pub gripper: GripperBody,
    /// The objects on the table, target included. A table that is cleared may be empty.
    #[schema(max_items = 10000, example = json!([
        {"id": "plate-1", "x": 0.31, "y": 0.22, "radius": 0.075},
        {"id": "vase", "x": 0.9, "y": 0.5, "radius": 0.05, "height": 0.3, "fixed": true},
        {"id": "tray", "x": 0.7, "y": 0.2, "yaw": 0.3, "height": 0.03,
            "shape": {"kind": "rectangle", "length": 0.4, "width": 0.3, "corner_radius": 0.02},
            "grasps": [{"x": 0.18, "y": 0, "yaw": 0, "tolerance": 0.1}]},
        {"id": "knife", "x": 0.43, "y": 0.22, "yaw": 1.57, "shape": {"kind": "capsule", "length": 0.2, "radius": 0.01}}
    ]))]
    pub objects: Vec<ObjectBody>,
    /// The id of the object to grasp. It must not be fixed. Either this or `goal` is required.
    #[schema(min_length = 1, max_length = 128, example = "plate-1")]
    pub target: Option<String>,
    /// What is wanted, where it is not one object. Either this or `target` is required.
    pub goal: Option<GoalBody>,
    /// Places off the table, to which objects can be taken away. Default: none.
    #[schema(max_items = 1000, example = json!([{"id": "tray", "capacity": 4, "accepts": ["plate-1"]}]))]
    pub drop_offs: Option<Vec<DropOffBody>>,
    /// How to plan. The time limit counts from when a worker begins.
    pub settings: Option<SettingsBody>,
    /// The URL to which the job is sent by POST when it has ended. The operator must have listed its host.
    #[schema(max_length = 2000, example = "https://erp.example.com/jobs")]
    pub callback_url: Option<String>,
    /// Jobs with a greater priority go first. Default: 0.
    #[schema(minimum = -100, maximum = 100, example = 0)]
    pub priority: Option<i32>,
}

/// Several scenes to plan for later.
#[derive(Debug, Clone, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct BatchBody {
    /// The scenes. All are accepted or none.
    #[schema(min_items = 1, max_items = 100, example = json!([{
        "table": {"x_min": 0, "y_min": 0, "x_max": 0.8, "y_max": 0.5},
        "gripper": {"fingers": 3, "finger_width": 0.02, "clearance": 0.05},
        "objects": [{"id": "cup", "x": 0.4, "y": 0.25, "radius": 0.04}],
        "target": "cup"
    }]))]
    pub scenes: Vec<JobSceneBody>,
}

/// The state of a job. The verdict is in `result`, not here.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(example = "succeeded")]
pub enum JobStateWord {
    /// It waits for a worker.
    Queued,
    /// A worker has it.
    Running,
    /// There is an answer, whatever its verdict.
    Succeeded,
    /// There is none; `problem` says why.
    Failed,
    /// Somebody cancelled it; the best so far is in `result` if a worker had begun.
    Cancelled,
    /// No worker had it before `expires_at`.
    Expired,
}

/// The best set of relocations that the search of a running job has found. It has no places and is not checked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
pub struct IncumbentBody {
    /// The number of relocations of the best set so far.
    #[schema(value_type = usize, example = 3)]
    pub cost: u64,
    /// No plan has fewer.
    #[schema(value_type = usize, example = 2)]
    pub lower_bound: u64,
}

impl From<Incumbent> for IncumbentBody {
    fn from(Incumbent { cost, lower_bound }: Incumbent) -> Self {
        Self { cost: cost.get(), lower_bound: lower_bound.get() }
    }
}

/// A job. Times are RFC 3339 in UTC.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct JobBody {
    /// The job's id.
    #[schema(example = "019a8b2c-7d1e-7f00-8000-3c5f2a1b4d6e")]
    pub id: String,
    /// The job's state.
    pub state: JobStateWord,
    /// The request's own `scene_id`.
    #[schema(required = true, example = "cell-4/17")]
    pub scene_id: Option<String>,
    /// When the job was accepted.
    #[schema(example = "2026-01-05T09:30:00.000Z")]
    pub created_at: String,
    /// When the last attempt began.
    #[schema(required = true, example = "2026-01-05T09:30:00.004Z")]
    pub started_at: Option<String>,
    /// When the job ended.
    #[schema(required = true, example = "2026-01-05T09:30:00.012Z")]
    pub finished_at: Option<String>,
    /// When the job expires unless a worker begins it. After its end: when it is deleted.
    #[schema(example = "2026-01-05T10:30:00.012Z")]
    pub expires_at: String,
    /// How often a worker has begun the job.
    #[schema(example = 1)]
    pub attempts: u32,
    /// The job's position in the queue, counted from 1. Null unless it is queued.
    #[schema(required = true, value_type = Option<usize>, example = 1)]
    pub queue_position: Option<u64>,
    /// The SHA-256 of the scene without `scene_id` and settings, hexadecimal. A `destination` that is not the default counts.
    /// It does not depend on how the JSON is written.
    #[schema(example = "f111313c9ecf7ea9b764844cd8466b78c8bfb0303277cfdc48e5ec969a5b84e0")]
    pub scene_sha256: String,
    /// The version of the service that ended the job. Before its end: the version that answers.
    #[schema(example = "0.1.0")]
    pub version: String,
    /// The best set of relocations so far. Null if none is known, and for a clearing.
    #[schema(required = true)]
    pub incumbent: Option<IncumbentBody>,
    /// The answer. Null until there is one. Always null in lists: fetch the job itself.
    #[schema(required = true, value_type = Option<AnswerBody>)]
    pub result: Option<RawJson>,
    /// Why there is no answer. Null unless the job failed.
    #[schema(required = true, value_type = Option<Problem>)]
    pub problem: Option<RawJson>,
}

/// JSON serialised once, by us. Clones share it, and it is served as it is, without parsing or serialising again.
#[derive(Debug, Clone)]
pub struct RawJson(Arc<RawValue>);

impl RawJson {
    /// Serialise this.
    ///
    /// # Errors
    /// If it can't be serialised.
    pub fn write(body: &impl Serialize) -> serde_json::Result<Self> {
        to_raw_value(body).map(|text| Self(text.into()))
    }
}

/// JSON from the store. An error if it is invalid.
impl FromStr for RawJson {
    type Err = serde_json::Error;

    fn from_str(text: &str) -> serde_json::Result<Self> {
        RawValue::from_string(text.to_owned()).map(|text| Self(text.into()))
    }
}

impl Deref for RawJson {
    type Target = str;

    fn deref(&self) -> &str {
        self.0.get()
    }
}

impl Eq for RawJson {}

impl PartialEq for RawJson {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl Serialize for RawJson {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

/// The accepted jobs.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct JobsBody {
    /// The jobs, in the order of the scenes.
    #[schema(example = one_queued)]
    pub jobs: Vec<JobBody>,
}

/// One page of the caller's jobs.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct JobListBody {
    /// The jobs, the latest first, without their results.
    #[schema(example = one_queued)]
    pub jobs: Vec<JobBody>,
    /// The `cursor` of the next page. Null on the last page.
    #[schema(required = true, example = "019a8b2c-7d1e-7f00-8000-3c5f2a1b4d6e")]
    pub next_cursor: Option<String>,
}

/// The job of the example scene, for the interface document.
pub fn queued_job() -> Value {
    json!({
        "id": "019a8b2c-7d1e-7f00-8000-3c5f2a1b4d6e", "state": "queued", "scene_id": "cell-4/17",
        "created_at": "2026-01-05T09:30:00.000Z", "started_at": null, "finished_at": null,
        "expires_at": "2026-01-05T10:30:00.000Z", "attempts": 0, "queue_position": 1,
        "scene_sha256": "f111313c9ecf7ea9b764844cd8466b78c8bfb0303277cfdc48e5ec969a5b84e0",
        "version": env!("CARGO_PKG_VERSION"), "incumbent": null, "result": null, "problem": null
    })
}

fn one_queued() -> Value {
    json!([queued_job()])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kept_answer_is_served_byte_for_byte() {
        let text = r#"{"b": [1.50, "ü\n"],  "a": null}"#;
        let kept = text.parse::<RawJson>().unwrap();
        let served = serde_json::to_string(&[Some(&kept), None, Some(&kept.clone())]).unwrap();
        assert_eq!(served, format!("[{text},null,{text}]"));
        assert_eq!(&*RawJson::write(&json!({"z": [1, 2.5], "a": "ü"})).unwrap(), r#"{"z":[1,2.5],"a":"ü"}"#);
        assert!("{".parse::<RawJson>().is_err());
    }

    #[test]
    fn clones_of_a_kept_answer_share_its_bytes() {
        let kept: RawJson = "{}".parse().unwrap();
        assert!(Arc::ptr_eq(&kept.0, &kept.clone().0));
    }
}
