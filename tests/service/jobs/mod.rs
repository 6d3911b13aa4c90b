//! Jobs over HTTP.

mod callbacks;
mod ends;
pub(crate) mod events;
mod requests;
mod submitting;

use serde_json::{Value, json};

use crate::host::{Host, Reply};

/// Hand a scene in; the job as accepted.
pub(crate) async fn submit(host: &Host, body: &Value) -> Value {
    let reply = host.post("/v1/jobs", body).await;
    assert_eq!(reply.status, 202, "{reply:?}");
    reply.json()
}

pub(crate) fn path(job: &Value) -> String {
    format!("/v1/jobs/{}", job["id"].as_str().unwrap())
}

/// The job once it has ended.
pub(crate) async fn ended(host: &Host, job: &Value) -> Value {
    let reply = host.get(&format!("{}?wait_ms=60000", path(job))).await;
    assert_eq!(reply.status, 200, "{reply:?}");
    let job = reply.json();
    assert!(!job["finished_at"].is_null(), "it ended in time: {job}");
    job
}

pub(crate) async fn submit_with_key(host: &Host, key: &str, body: &Value) -> Reply {
    host.post_with("/v1/jobs", &[("content-type", "application/json"), ("idempotency-key", key)], body.to_string())
        .await
}

/// A cup among three plates: two of them have to go.
pub(crate) fn crowded() -> Value {
    json!({
        "scene_id": "crowded",
        "table": {"x_min": 0, "y_min": 0, "x_max": 0.8, "y_max": 0.5},
        "gripper": {"fingers": 3, "finger_width": 0.02, "clearance": 0.05},
        "objects": [
            {"id": "cup", "x": 0.4, "y": 0.25, "radius": 0.04},
            {"id": "plate-1", "x": 0.5, "y": 0.29, "radius": 0.06},
            {"id": "plate-2", "x": 0.4, "y": 0.36, "radius": 0.06},
            {"id": "plate-3", "x": 0.31, "y": 0.2, "radius": 0.06},
            {"id": "vase", "x": 0.44, "y": 0.16, "radius": 0.05, "fixed": true}
        ],
        "target": "cup"
    })
}
