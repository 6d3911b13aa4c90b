//! What the log says of a request. Alone in its binary: whether a line is wanted at all is settled once a process.

#![expect(clippy::unwrap_used, reason = "what fails here fails the test")]

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use axum::body::Body;
use axum::http::{Request, header};
use singulate::api::{App, Engine, ServerSettings, router};
use singulate::jobs::JobSettings;
use singulate::keys::FreshKey;
use tower::ServiceExt;

const TRACE: &str = "0af7651916cd43dd8448eb211c80319c";

#[derive(Clone, Default)]
struct Pages(Arc<Mutex<Vec<u8>>>);

impl Write for Pages {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.lock().unwrap().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// A keys file with one key, and the key.
fn keys() -> (PathBuf, String) {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("access-log-keys.toml");
    let key = FreshKey::new("cell-4", "plan".parse().unwrap(), "1000".parse().unwrap()).unwrap();
    std::fs::write(&path, key.entry()).unwrap();
    (path, key.text().to_owned())
}

#[tokio::test]
async fn a_call_leaves_one_line_that_names_its_key_its_scene_and_its_trace() {
    let pages = Pages::default();
    let writer = pages.clone();
    let subscriber = tracing_subscriber::fmt().with_ansi(false).with_writer(move || writer.clone()).finish();
    let _guard = tracing::subscriber::set_default(subscriber);
    let jobs = JobSettings { url: "sqlite::memory:".to_owned(), ..JobSettings::default() };
    let (file, key) = keys();
    let settings = ServerSettings { jobs, api_keys_file: Some(file), ..ServerSettings::default() };
    let app = Arc::new(App::start(settings, Engine::default()).await.unwrap());
    let body = r#"{"scene_id": "cell-4/17", "table": {"x_min": 0, "y_min": 0, "x_max": 1, "y_max": 1},
        "gripper": {"fingers": 3, "finger_width": 0.02, "clearance": 0.05},
        "objects": [{"id": "a", "x": 0.5, "y": 0.5, "radius": 0.1}], "target": "a"}"#;
    let line = async |path: &str, key: &str| {
        let request = Request::post(path).header(header::CONTENT_TYPE, "application/json");
        let request = request.header(header::AUTHORIZATION, format!("Bearer {key}")).header("x-request-id", "mine");
        let request = request.header("traceparent", format!("00-{TRACE}-b7ad6b7169203331-01"));
        let response = router(Arc::clone(&app)).oneshot(request.body(Body::from(body)).unwrap()).await.unwrap();
        assert_eq!(response.headers()["x-request-id"], "mine");
        let text = String::from_utf8(core::mem::take(&mut *pages.0.lock().unwrap())).unwrap();
        assert!(text.lines().count() == 1 && !text.contains("sgl_"), "{text}");
        text
    };
    let common = ["POST", "id=\"mine\"", TRACE, "ms="];
    let planned = (line("/v1/plans", &key).await, &["/v1/plans", "key=\"cell-4\"", "cell-4/17", "status=200"][..]);
    // Whose key it was is known of a refusal too, unless it was nobody's.
    let forbidden = (line("/v1/jobs", &key).await, &["/v1/jobs", "key=\"cell-4\"", "status=403"][..]);
    let unknown = (line("/v1/jobs", "sgl_unknown").await, &["/v1/jobs", "status=401"][..]);
    assert!(!unknown.0.contains("key="), "{}", unknown.0);
    for (text, parts) in [planned, forbidden, unknown] {
        for part in common.iter().chain(parts) {
            assert!(text.contains(part), "{part} in {text}");
        }
    }
}
