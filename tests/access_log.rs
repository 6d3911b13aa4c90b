//! What the log says of a request. Alone in its binary: whether a line is wanted at all is settled once a process.

#![expect(clippy::unwrap_used, reason = "what fails here fails the test")]

use std::io::{self, Write};
use std::sync::{Arc, Mutex};

use axum::body::Body;
use axum::http::{Request, header};
use singulate::api::{App, Engine, ServerSettings, router};
use singulate::jobs::JobSettings;
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

#[tokio::test]
async fn a_planning_call_leaves_one_line_that_names_its_scene_and_its_trace() {
    let pages = Pages::default();
    let writer = pages.clone();
    let subscriber = tracing_subscriber::fmt().with_ansi(false).with_writer(move || writer.clone()).finish();
    let _guard = tracing::subscriber::set_default(subscriber);
    let jobs = JobSettings { url: "sqlite::memory:".to_owned(), ..JobSettings::default() };
    let settings = ServerSettings { jobs, ..ServerSettings::default() };
    let app = Arc::new(App::start(settings, Engine::default()).await.unwrap());
    let body = r#"{"scene_id": "cell-4/17", "table": {"x_min": 0, "y_min": 0, "x_max": 1, "y_max": 1},
        "gripper": {"fingers": 3, "finger_width": 0.02, "clearance": 0.05},
        "objects": [{"id": "a", "x": 0.5, "y": 0.5, "radius": 0.1}], "target": "a"}"#;
    let request = Request::post("/v1/plans").header(header::CONTENT_TYPE, "application/json");
    let request =
        request.header("x-request-id", "mine").header("traceparent", format!("00-{TRACE}-b7ad6b7169203331-01"));
    let response = router(app).oneshot(request.body(Body::from(body)).unwrap()).await.unwrap();
    assert_eq!((response.status().as_u16(), &response.headers()["x-request-id"]), (200, &"mine".parse().unwrap()));
    let text = String::from_utf8(pages.0.lock().unwrap().clone()).unwrap();
    assert_eq!(text.lines().count(), 1, "{text}");
    for part in ["POST", "/v1/plans", "id=\"mine\"", TRACE, "cell-4/17", "status=200", "ms="] {
        assert!(text.contains(part), "{part} in {text}");
    }
}
