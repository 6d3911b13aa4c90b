//! From a request body to new jobs for the store.

use axum::http::{HeaderMap, HeaderName};
use serde::Serialize;
use sha2::{Digest, Sha256};

use crate::jobs::{CallbackAllow, JobId, NewJob, Owner};
use crate::wire::{ErrorCode, ErrorItem, JobRequest, Problem, SceneBody};

const IDEMPOTENCY_KEY: HeaderName = HeaderName::from_static("idempotency-key");
/// The longest idempotency key, characters: room for any id, none for a document.
const MAX_KEY_LENGTH: usize = 255;

/// The request's idempotency key.
///
/// # Errors
/// A problem if it is empty, too long, repeated, or not printable ASCII.
pub(super) fn key(headers: &HeaderMap) -> Result<Option<String>, Problem> {
    let mut values = headers.get_all(IDEMPOTENCY_KEY).iter();
    let Some(value) = values.next() else { return Ok(None) };
    let text = value.to_str().ok().filter(|text| (1..=MAX_KEY_LENGTH).contains(&text.len()));
    match (text, values.next()) {
        (Some(text), None) => Ok(Some(text.to_owned())),
        _ => {
            let detail = format!("an Idempotency-Key is one value of 1 to {MAX_KEY_LENGTH} printable ASCII characters");
            Err(Problem::invalid(vec![ErrorItem::new(ErrorCode::IdempotencyKey, "", detail)]))
        }
    }
}

/// The place of callback URLs in a body.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Shape {
    /// The body is one job.
    One,
    /// The body is a list of jobs.
    Batch,
}

/// Checks callback URLs against the allow list, and writes them in their canonical form.
///
/// # Errors
/// A problem that names each refused one.
pub(super) fn check_callbacks(requests: &mut [JobRequest], shape: Shape, allow: &CallbackAllow) -> Result<(), Problem> {
    let mut faults = Vec::new();
    for (position, request) in requests.iter_mut().enumerate() {
        let Some(url) = &mut request.callback_url else { continue };
        match allow.check(url) {
            Ok(checked) => *url = checked.as_str().to_owned(),
            Err(fault) => {
                let pointer = match shape {
                    Shape::One => "/callback_url".to_owned(),
                    Shape::Batch => format!("/scenes/{position}/callback_url"),
                };
                faults.push(ErrorItem::new(fault.code(), pointer, fault.to_string()));
            }
        }
    }
    if faults.is_empty() { Ok(()) } else { Err(Problem::invalid(faults)) }
}

/// New jobs for the requests of one body.
pub(super) fn new_jobs(requests: Vec<JobRequest>, body: &[u8], owner: &Owner, key: Option<&str>) -> Vec<NewJob> {
    let request_sha256 = sha256(body);
    let numbered = requests.into_iter().zip(0_u32..);
    numbered
        .map(|(JobRequest { plan, callback_url, priority, body }, position)| NewJob {
            id: JobId::new(),
            owner: owner.clone(),
            key: key.map(|key| (key.to_owned(), position)),
            request_sha256: request_sha256.clone(),
            scene_sha256: digest(&SceneBody::new(&plan.scene, None)),
            scene_id: plan.scene_id,
            body,
            priority,
            callback_url,
        })
        .collect()
}

/// The digest of the canonical JSON.
fn digest(body: &impl Serialize) -> String {
    // A value that was just parsed can be written.
    sha256(&serde_json::to_vec(body).unwrap_or_default())
}

fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wire::{RequestLimits, read_job};

    #[test]
    fn a_digest_is_that_of_the_bytes() {
        assert_eq!(sha256(b"abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    }

    #[test]
    fn a_scene_has_one_digest_however_it_is_written_and_asked_for() {
        let digests = |body: &str| {
            let request = read_job(body.as_bytes(), &RequestLimits::default()).unwrap();
            let job = new_jobs(vec![request], body.as_bytes(), &Owner::anonymous(), None).remove(0);
            (job.scene_sha256, job.request_sha256)
        };
        let short = r#"{"table": {"x_min": 0, "y_min": 0, "x_max": 1, "y_max": 1}, "target": "a",
            "gripper": {"fingers": 3, "finger_width": 0.02, "clearance": 0.05},
            "objects": [{"id": "a", "x": 0.5, "y": 0.5, "radius": 0.1}]}"#;
        let long = r#"{"scene_id": "s", "priority": 3, "settings": {"time_limit_ms": 5}, "target": "a",
            "table": {"x_min": 0.0, "y_min": 0, "x_max": 1e0, "y_max": 1, "keep_out": []},
            "gripper": {"fingers": 3, "finger_width": 0.02, "clearance": 0.05, "margin": 0},
            "objects": [{"id": "a", "x": 0.5, "y": 0.50, "radius": 0.1, "fixed": false}]}"#;
        let moved = short.replace("\"x\": 0.5", "\"x\": 0.4");
        assert_eq!(digests(short).0, digests(long).0);
        assert_ne!(digests(short).1, digests(long).1);
        assert_ne!(digests(short).0, digests(&moved).0);
    }

    #[test]
    fn a_key_that_is_no_key_is_refused() {
        let headers = |values: &[&str]| {
            values.iter().map(|value| (IDEMPOTENCY_KEY, value.parse().unwrap())).collect::<HeaderMap>()
        };
        assert_eq!(key(&headers(&[])).unwrap(), None);
        assert_eq!(key(&headers(&["a b"])).unwrap().as_deref(), Some("a b"));
        assert!(key(&headers(&["k".repeat(255).as_str()])).is_ok());
        for wrong in [&[""][..], &["a", "a"], &["schlüssel"], &["k".repeat(256).as_str()]] {
            assert!(key(&headers(wrong)).is_err(), "{wrong:?}");
        }
    }
}
