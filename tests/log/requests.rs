//! What the log says of a request.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use axum::body::Body;
use axum::http::{Request, header};
use singulate::api::{App, Engine, ServerSettings, router};
use singulate::jobs::JobSettings;
use singulate::keys::FreshKey;
use tower::ServiceExt;

use crate::{Pages, field};

const TRACE: &str = "0af7651916cd43dd8448eb211c80319c";

/// A keys file with one key for these scopes, and the key.
fn keys(scopes: &str) -> (PathBuf, String) {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("access-log-{scopes}.toml"));
    let key = FreshKey::new("cell-4", scopes.parse().unwrap(), "1000".parse().unwrap()).unwrap();
    std::fs::write(&path, key.entry()).unwrap();
    (path, key.text().to_owned())
}

const SCENE: &str = r#"{"scene_id": "cell-4/17", "table": {"x_min": 0, "y_min": 0, "x_max": 1, "y_max": 1},
    "gripper": {"fingers": 3, "finger_width": 0.02, "clearance": 0.05},
    "objects": [{"id": "a", "x": 0.5, "y": 0.5, "radius": 0.1}], "target": "a"}"#;

/// A service whose log is kept.
struct Logged {
    app: Arc<App>,
    pages: Pages,
    key: String,
}

impl Logged {
    /// With one key for these scopes.
    async fn start(scopes: &str) -> Self {
        let pages = Pages::open();
        let jobs = JobSettings { url: "sqlite::memory:".to_owned(), ..JobSettings::default() };
        let (file, key) = keys(scopes);
        let settings = ServerSettings { jobs, api_keys_file: Some(file), ..ServerSettings::default() };
        let app = Arc::new(App::start(settings, Engine::default()).await.unwrap());
        Self { app, pages, key }
    }

    /// The one line that this request leaves, which holds no key.
    async fn line(&self, method: &str, path: &str, key: &str, body: &str) -> String {
        let request = Request::builder().method(method).uri(path).header(header::CONTENT_TYPE, "application/json");
        let request = request.header(header::AUTHORIZATION, format!("Bearer {key}")).header("x-request-id", "mine");
        let request = request.header("traceparent", format!("00-{TRACE}-b7ad6b7169203331-01"));
        let request = request.body(Body::from(body.to_owned())).unwrap();
        let response = router(&self.app).oneshot(request).await.unwrap();
        assert_eq!(response.headers()["x-request-id"], "mine");
        let text = self.pages.take();
        assert!(text.lines().count() == 1 && !text.contains(key), "{text}");
        text
    }
}

#[tokio::test]
async fn a_call_leaves_one_line_that_names_its_key_its_scene_and_its_trace() {
    let service = Logged::start("plan").await;
    let line = async |path: &str, key: &str| service.line("POST", path, key, SCENE).await;
    let common = ["POST", "id=\"mine\"", TRACE, "ms="];
    let planned =
        (line("/v1/plans", &service.key).await, &["/v1/plans", "key=\"cell-4\"", "cell-4/17", "status=200"][..]);
    // Whose key it was is known of a refusal too, unless it was nobody's.
    let forbidden = (line("/v1/jobs", &service.key).await, &["/v1/jobs", "key=\"cell-4\"", "status=403"][..]);
    let unknown = (line("/v1/jobs", "sgl_unknown").await, &["/v1/jobs", "status=401"][..]);
    assert!(!unknown.0.contains("key="), "{}", unknown.0);
    for (text, parts) in [planned, forbidden, unknown] {
        for part in common.iter().chain(parts) {
            assert!(text.contains(part), "{part} in {text}");
        }
        // Milliseconds, with two decimals at the most.
        let ms = field(&text, "ms").unwrap();
        assert!(
            ms.parse::<f64>().is_ok() && ms.split_once('.').is_none_or(|(_, decimals)| decimals.len() <= 2),
            "{ms}"
        );
    }
}

#[tokio::test]
async fn the_line_of_a_refused_request_says_why() {
    let service = Logged::start("plan,jobs").await;
    let faulty = SCENE.replace("\"radius\": 0.1", "\"radius\": -1, \"color\": 3");
    let lost = "/v1/jobs/018f0000-0000-7000-8000-000000000000";
    for (method, path, body, status, problem, code) in [
        ("POST", "/v1/plans", SCENE, "200", None, None),
        ("POST", "/v1/plans", &faulty, "422", Some("invalid_request"), Some("unknown_field")),
        ("POST", "/v1/plans", "{", "400", Some("malformed_json"), Some("malformed_json")),
        ("GET", "/v1/plans", "", "405", Some("method_not_allowed"), None),
        ("GET", "/v1/jobs?colour=red", "", "422", Some("invalid_request"), Some("unknown_parameter")),
        ("GET", lost, "", "404", Some("not_found"), None),
        ("POST", "/v1/plan", SCENE, "404", Some("not_found"), None),
    ] {
        let line = service.line(method, path, &service.key, body).await;
        let problem = problem.map(|word| format!("urn:singulate:problem:{word}"));
        assert_eq!(field(&line, "status"), Some(status), "{line}");
        assert_eq!(field(&line, "problem"), problem.as_deref(), "{line}");
        assert_eq!(field(&line, "code"), code, "{line}");
        assert_eq!(field(&line, "path"), (status == "404").then_some(path), "{line}");
    }
}

#[tokio::test]
async fn the_path_of_a_404_is_short_and_shows_neither_a_key_nor_what_was_asked_of_it() {
    let service = Logged::start("plan").await;
    let line = async |path: &str| service.line("GET", path, &service.key, "").await;
    let with_key = line(&format!("/v1/plans/{}/x?token=quiet", service.key)).await;
    assert_eq!(field(&with_key, "path"), Some("/v1/plans/sgl_…/x"), "{with_key}");
    assert!(!with_key.contains("quiet"));
    let long = line(&format!("/{}", "x".repeat(60_000))).await;
    assert_eq!(field(&long, "path").unwrap().chars().count(), 129, "{long}");
    let odd = line("/v1/plans\u{9b}31m").await;
    assert!(odd.chars().all(|c| c == '\n' || !c.is_control()), "{odd:?}");
}
