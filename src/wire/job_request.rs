//! Reads job requests from JSON.

use super::code::ErrorCode;
use super::limits::{MAX_BATCH, MAX_CALLBACK_URL_LENGTH, PRIORITY_RANGE, RequestLimits};
use super::path::Path;
use super::plan_request::PlanRequest;
use super::problem::Problem;
use super::reader::{FieldNames, JsonNode, RequestFaults, parse};
use super::request::request;
use super::typed;

/// A valid job request.
#[derive(Debug, Clone)]
pub struct JobRequest {
    /// The planning request.
    pub plan: PlanRequest,
    /// The callback URL, not yet checked against the allow list.
    pub callback_url: Option<String>,
    /// Jobs of greater priority go first.
    pub priority: i64,
    /// The same request as JSON.
    pub body: Vec<u8>,
}

/// A planning request's fields and two more.
const JOB: FieldNames = FieldNames::of(&[
    "scene_id",
    "table",
    "gripper",
    "objects",
    "target",
    "goal",
    "drop_offs",
    "settings",
    "callback_url",
    "priority",
]);
const BATCH: FieldNames = FieldNames::of(&["scenes"]);

/// Read a request for one job.
///
/// # Errors
/// A problem with every fault of the body.
pub fn read_job(body: &[u8], limits: &RequestLimits) -> Result<JobRequest, Problem> {
    sound(body, limits).map_or_else(|| walked(body, limits), Ok)
}

pub(super) fn sound(body: &[u8], limits: &RequestLimits) -> Option<JobRequest> {
    let (stated, callback_url, priority) = typed::job(body, limits)?;
    let plan = stated.sound(&Path::Root, limits)?;
    Some(JobRequest { plan, callback_url, priority, body: body.to_owned() })
}

pub(super) fn walked(body: &[u8], limits: &RequestLimits) -> Result<JobRequest, Problem> {
    let (value, mut faults) = parse(body)?;
    let read = job(JsonNode::root(&value), body, limits, &mut faults);
    faults.judge(read)
}

/// Read a batch of job requests.
///
/// # Errors
/// A problem with every fault of the body.
pub fn read_batch(body: &[u8], limits: &RequestLimits) -> Result<Vec<JobRequest>, Problem> {
    let (value, mut faults) = parse(body)?;
    let read = batch(JsonNode::root(&value), limits, &mut faults);
    faults.judge(read)
}

fn batch(node: JsonNode<'_>, limits: &RequestLimits, faults: &mut RequestFaults) -> Option<Vec<JobRequest>> {
    let fields = node.fields(&BATCH, faults)?;
    fields.required("scenes", faults, |node, faults| {
        let count = node.length();
        if count > MAX_BATCH {
            let detail = format_args!("a batch has at most {MAX_BATCH} scenes, this one has {count}");
            faults.add(ErrorCode::TooManyScenes, node.path(), detail);
            return None;
        }
        let jobs = node.list(faults, |node, faults| Some(job(node, node.source(), limits, faults)))?;
        if jobs.is_empty() {
            faults.add(ErrorCode::TooFewScenes, node.path(), format_args!("a batch has at least one scene"));
        }
        jobs.into_iter().collect()
    })
}

/// A job of a body, or of a part of it.
fn job(node: JsonNode<'_>, body: &[u8], limits: &RequestLimits, faults: &mut RequestFaults) -> Option<JobRequest> {
    let plan = request(node, &JOB, limits, faults);
    // Faults of the object itself have been noted already.
    let fields = node.fields(&JOB, &mut RequestFaults::default())?;
    let callback_url =
        fields.optional("callback_url", None, faults, |node, faults| callback_url(node, faults).map(Some));
    let priority = fields.optional("priority", 0, faults, |node, faults| node.integer(PRIORITY_RANGE, faults));
    Some(JobRequest { plan: plan?, callback_url: callback_url?, priority: priority?, body: body.to_owned() })
}

fn callback_url(node: JsonNode<'_>, faults: &mut RequestFaults) -> Option<String> {
    let text = node.text(faults)?;
    let length = text.chars().count();
    if length > MAX_CALLBACK_URL_LENGTH {
        let detail = format_args!("a URL has at most {MAX_CALLBACK_URL_LENGTH} characters, this one has {length}");
        faults.add(ErrorCode::UrlLength, node.path(), detail);
        return None;
    }
    Some(text)
}
