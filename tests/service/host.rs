//! Starts servers and speaks with them.

use core::net::SocketAddr;
use core::time::Duration;
use std::io::{Read, Write};
use std::net::TcpStream;

use serde_json::{Value, json};
use singulate::api::server::run_with;
use singulate::api::{Engine, ServerSettings};
use singulate::jobs::JobSettings;
use singulate::jobs::{client_builder, trusted_roots};
use singulate::wire::PlanRequest;
use singulate_planner::budget::Budget;
use singulate_planner::paper::Judged;
use singulate_planner::plan::{Answer, PlanError, Statistics};
use singulate_planner::search::Progress;
use singulate_planner::statement::Statement;
use tokio::net::TcpListener;
use tokio::sync::watch;
use tokio::task::JoinHandle;
use tokio::time::{sleep, timeout};

/// Long enough for any machine; a test that waits so long has failed.
pub(crate) const PATIENCE: Duration = Duration::from_secs(60);

pub(crate) struct Host {
    pub(crate) address: SocketAddr,
    pub(crate) client: reqwest::Client,
    scheme: &'static str,
    stop: watch::Sender<()>,
    task: JoinHandle<std::io::Result<()>>,
}

impl Host {
    pub(crate) async fn start() -> Self {
        Self::with(ServerSettings::default(), Engine::default()).await
    }

    /// Jobs are kept in memory, unless the settings say otherwise.
    pub(crate) async fn with(mut settings: ServerSettings, engine: Engine) -> Self {
        if settings.jobs.url == JobSettings::default().url {
            settings.jobs.url = "sqlite::memory:".to_owned();
        }
        let scheme = if settings.tls.cert.is_some() { "https" } else { "http" };
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let address = listener.local_addr().unwrap();
        let (stop, mut stopped) = watch::channel(());
        let task = tokio::spawn(run_with(listener, settings, engine, async move {
            // A host that is dropped stops too.
            let _ = stopped.changed().await;
        }));
        let client = client_builder(trusted_roots()).build().unwrap();
        Self { address, client, scheme, stop, task }
    }

    pub(crate) fn url(&self, path: &str) -> String {
        format!("{}://{}{path}", self.scheme, self.address)
    }

    pub(crate) async fn get(&self, path: &str) -> Reply {
        Reply::of(self.client.get(self.url(path)).send().await.unwrap()).await
    }

    pub(crate) async fn post(&self, path: &str, body: &Value) -> Reply {
        self.post_with(path, &[("content-type", "application/json")], body.to_string()).await
    }

    pub(crate) async fn post_with(
        &self,
        path: &str,
        headers: &[(&str, &str)],
        body: impl Into<reqwest::Body>,
    ) -> Reply {
        let mut request = self.client.post(self.url(path)).body(body);
        for (name, value) in headers {
            request = request.header(*name, *value);
        }
        Reply::of(request.send().await.unwrap()).await
    }

    /// A connection on which the text has been sent.
    pub(crate) fn raw(&self, text: &str) -> TcpStream {
        let mut stream = TcpStream::connect(self.address).unwrap();
        stream.write_all(text.as_bytes()).unwrap();
        stream
    }

    /// A request on a connection of its own, and all that comes back until the server closes it.
    pub(crate) async fn ask(&self, text: &str) -> String {
        read_to_end(self.raw(text)).await
    }

    /// Tell the server to stop.
    pub(crate) fn ask_to_stop(&self) {
        self.stop.send(()).unwrap();
    }

    /// Done once the server that was told to stop has.
    pub(crate) async fn stopped(self) {
        timeout(PATIENCE, self.task).await.expect("it ends").unwrap().unwrap();
    }
}

/// What came back.
#[derive(Debug)]
pub(crate) struct Reply {
    pub(crate) status: u16,
    headers: reqwest::header::HeaderMap,
    pub(crate) text: String,
}

impl Reply {
    pub(crate) async fn of(response: reqwest::Response) -> Self {
        let (status, headers) = (response.status().as_u16(), response.headers().clone());
        Self { status, headers, text: String::from_utf8_lossy(&response.bytes().await.unwrap()).into_owned() }
    }

    pub(crate) fn header(&self, name: &str) -> &str {
        self.headers.get(name).map_or("", |value| value.to_str().unwrap())
    }

    pub(crate) fn json(&self) -> Value {
        serde_json::from_str(&self.text).unwrap_or_else(|_| panic!("not JSON: {self:?}"))
    }

    /// Assert that this is a whole problem document of the kind.
    #[track_caller]
    pub(crate) fn is_problem(&self, status: u16, kind: &str) {
        assert_eq!((self.status, self.header("content-type")), (status, "application/problem+json"), "{self:?}");
        let body = self.json();
        assert_eq!(body["type"], format!("urn:singulate:problem:{kind}"));
        assert_eq!(body["status"], status);
        assert!(body["title"].is_string() && body["detail"].is_string() && body["errors"].is_array());
    }

    pub(crate) fn pointers(&self) -> Vec<String> {
        let errors = self.json()["errors"].as_array().unwrap().clone();
        errors.iter().map(|error| error["pointer"].as_str().unwrap().to_owned()).collect()
    }
}

/// All that the server sends until it closes the connection.
pub(crate) async fn read_to_end(mut stream: TcpStream) -> String {
    let reading = tokio::task::spawn_blocking(move || {
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        let mut bytes = Vec::new();
        // A reset after the answer is an end too, a timeout is none.
        if let Err(error) = stream.read_to_end(&mut bytes) {
            assert_eq!(error.kind(), std::io::ErrorKind::ConnectionReset);
        }
        String::from_utf8_lossy(&bytes).into_owned()
    });
    reading.await.unwrap()
}

/// A planner that goes on until its budget ends.
pub(crate) fn endless() -> Engine {
    fn plan(_: &PlanRequest, budget: &Budget<'_>, _: Progress<'_>) -> Result<Judged, PlanError> {
        while budget.check().is_ok() {
            std::thread::sleep(Duration::from_millis(1));
        }
        Ok(Answer { statement: Statement::timed_out(), statistics: Statistics::default() }.into())
    }
    Engine { plan, ..Engine::default() }
}

pub(crate) async fn wait_until(mut condition: impl FnMut() -> bool) {
    let waiting = async {
        while !condition() {
            sleep(Duration::from_millis(1)).await;
        }
    };
    timeout(PATIENCE, waiting).await.expect("it happens in time");
}

pub(crate) fn scene(time_limit_ms: u64) -> Value {
    json!({
        "scene_id": "cell-4/17",
        "table": {"x_min": 0, "y_min": 0, "x_max": 1.2, "y_max": 0.7},
        "gripper": {"fingers": 3, "finger_width": 0.02, "clearance": 0.05},
        "objects": [
            {"id": "plate-1", "x": 0.31, "y": 0.22, "radius": 0.075},
            {"id": "vase", "x": 0.9, "y": 0.5, "radius": 0.05, "fixed": true}
        ],
        "target": "plate-1",
        "settings": {"time_limit_ms": time_limit_ms}
    })
}

/// A planning request as it goes over the wire.
pub(crate) fn raw_plan(body: &Value) -> String {
    raw_post("/v1/plans", body)
}

/// A request as it goes over the wire.
pub(crate) fn raw_post(path: &str, body: &Value) -> String {
    let head = format!("POST {path} HTTP/1.1\r\nhost: x\r\ncontent-type: application/json");
    let body = body.to_string();
    format!("{head}\r\ncontent-length: {}\r\n\r\n{body}", body.len())
}
