//! A job as JSON: schema and serialisation.

use core::ops::Deref;
use core::str::FromStr;
use std::sync::Arc;

use serde::{Serialize, Serializer};
use serde_json::value::{RawValue, to_raw_value};
use serde_json::{Value, json};
use utoipa::ToSchema;

use super::answer::AnswerBody;
use super::object::ObjectBody;
use super::problem::Problem;
use super::scene::{GripperBody, SettingsBody, TableBody};
use singulate_planner::search::Incumbent;

/// A scene to be planned for later: the body of a planning request and two fields more.
#[derive(Debug, Clone, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct JobSceneBody {
    /// The caller's name for the scene; echoed in job and answer and in logs.
    #[schema(max_length = 256, example = "cell-4/17")]
    pub scene_id: Option<String>,
    /// The table.
    pub table: TableBody,
    /// The gripper.
    pub gripper: GripperBody,
    /// The objects on the table, target included.
    #[schema(min_items = 1, max_items = 10000, example = json!([
        {"id": "plate-1", "x": 0.31, "y": 0.22, "radius": 0.075},
        {"id": "vase", "x": 0.9, "y": 0.5, "radius": 0.05, "fixed": true}
    ]))]
    pub objects: Vec<ObjectBody>,
    /// The id of the object that is wanted; not a fixed one.
    #[schema(min_length = 1, max_length = 128, example = "plate-1")]
    pub target: String,
    /// How to plan. The time limit counts from when a worker begins.
    pub settings: Option<SettingsBody>,
    /// Who is told of the job's end, by a POST of the job; one of the hosts that the operator allows.
    #[schema(max_length = 2000, example = "https://erp.example.com/jobs")]
    pub callback_url: Option<String>,
    /// Jobs of a greater priority go first. 0 where absent.
    #[schema(minimum = -100, maximum = 100, example = 0)]
    pub priority: Option<i32>,
}

/// Several scenes to be planned for later.
#[derive(Debug, Clone, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct BatchBody {
    /// The scenes; all are accepted or none.
    #[schema(min_items = 1, max_items = 100, example = json!([{
        "table": {"x_min": 0, "y_min": 0, "x_max": 0.8, "y_max": 0.5},
        "gripper": {"fingers": 3, "finger_width": 0.02, "clearance": 0.05},
        "objects": [{"id": "cup", "x": 0.4, "y": 0.25, "radius": 0.04}],
        "target": "cup"
    }]))]
    pub scenes: Vec<JobSceneBody>,
}

/// Where a job stands. The verdict is in the result, never here.
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

/// The best so far of a running job, as the search says: places apart and before the independent check.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
pub struct IncumbentBody {
    /// The relocations of the best set known.
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
    /// Its name.
    #[schema(example = "019a8b2c-7d1e-7f00-8000-3c5f2a1b4d6e")]
    pub id: String,
    /// Where it stands.
    pub state: JobStateWord,
    /// The request's own `scene_id`.
    #[schema(required = true, example = "cell-4/17")]
    pub scene_id: Option<String>,
    /// When it was accepted.
    #[schema(example = "2026-01-05T09:30:00.000Z")]
    pub created_at: String,
    /// When its last attempt began.
    #[schema(required = true, example = "2026-01-05T09:30:00.004Z")]
    pub started_at: Option<String>,
    /// When it ended.
    #[schema(required = true, example = "2026-01-05T09:30:00.012Z")]
    pub finished_at: Option<String>,
    /// When it expires unless a worker has begun; once it has ended, when it is forgotten.
    #[schema(example = "2026-01-05T10:30:00.012Z")]
    pub expires_at: String,
    /// How often a worker began.
    #[schema(example = 1)]
    pub attempts: u32,
    /// How many jobs will be taken until it is, itself included; null unless it is queued.
    #[schema(required = true, value_type = Option<usize>, example = 1)]
    pub queue_position: Option<u64>,
    /// The digest of the scene without its name and settings, however it was written; hexadecimal.
    #[schema(example = "f111313c9ecf7ea9b764844cd8466b78c8bfb0303277cfdc48e5ec969a5b84e0")]
    pub scene_sha256: String,
    /// The version of the service that ended it; of the one that answers as long as none has.
    #[schema(example = "0.1.0")]
    pub version: String,
    /// The best so far; null where nothing is known.
    #[schema(required = true)]
    pub incumbent: Option<IncumbentBody>,
    /// The answer. Null as long as there is none, and in lists: ask for the job itself.
    #[schema(required = true, value_type = Option<AnswerBody>)]
    pub result: Option<RawJson>,
    /// Why there is no answer; null unless the job failed.
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

/// Jobs that were accepted.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct JobsBody {
    /// In the order of the scenes.
    #[schema(example = one_queued)]
    pub jobs: Vec<JobBody>,
}

/// Some of the caller's jobs.
#[derive(Debug, Clone, Serialize, ToSchema)]
pub struct JobListBody {
    /// The latest first, without their results.
    #[schema(example = one_queued)]
    pub jobs: Vec<JobBody>,
    /// What to ask for the rest with, as `cursor`; null where there is no more.
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
    fn what_was_written_once_is_served_as_it_is() {
        let text = r#"{"b": [1.50, "ü\n"],  "a": null}"#;
        let kept = text.parse::<RawJson>().unwrap();
        let served = serde_json::to_string(&[Some(&kept), None, Some(&kept.clone())]).unwrap();
        assert_eq!(served, format!("[{text},null,{text}]"));
        assert_eq!(&*RawJson::write(&json!({"z": [1, 2.5], "a": "ü"})).unwrap(), r#"{"z":[1,2.5],"a":"ü"}"#);
        assert!("{".parse::<RawJson>().is_err());
    }

    #[test]
    fn clones_share_what_was_written() {
        let kept: RawJson = "{}".parse().unwrap();
        assert!(Arc::ptr_eq(&kept.0, &kept.clone().0));
    }
}
