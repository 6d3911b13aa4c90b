//! Spans as a collector gets them. Alone in its binary: a process has one place where traces go.

#![expect(clippy::unwrap_used, reason = "what fails here fails the test")]

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpListener;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::thread::spawn;
use std::time::Duration;

use axum::body::Body;
use axum::http::{Request, header};
use opentelemetry_proto::tonic::collector::trace::v1::ExportTraceServiceRequest;
use opentelemetry_proto::tonic::trace::v1::Span;
use prost::Message;
use singulate::api::{App, Engine, ServerSettings, router};
use singulate::jobs::JobSettings;
use singulate::telemetry::{LogFormat, init};
use tower::ServiceExt;

/// Long enough for any machine; a test that waits so long has failed.
const PATIENCE: Duration = Duration::from_secs(60);

/// A collector: every body that is posted to `/v1/traces` comes out of the channel.
fn collector() -> (String, Receiver<Vec<u8>>) {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let url = format!("http://{}", listener.local_addr().unwrap());
    let (sender, bodies) = channel();
    spawn(move || {
        for stream in listener.incoming() {
            let mut stream = BufReader::new(stream.unwrap());
            let mut length = 0;
            loop {
                let mut line = String::new();
                if stream.read_line(&mut line).unwrap() == 0 {
                    break;
                }
                let line = line.to_ascii_lowercase();
                if let Some(value) = line.strip_prefix("content-length: ") {
                    length = value.trim().parse().unwrap();
                }
                assert!(!line.starts_with("post ") || line.starts_with("post /v1/traces "), "{line}");
                if line == "\r\n" {
                    let mut body = vec![0; length];
                    stream.read_exact(&mut body).unwrap();
                    stream.get_mut().write_all(b"HTTP/1.1 200 OK\r\ncontent-length: 0\r\n\r\n").unwrap();
                    if sender.send(body).is_err() {
                        return;
                    }
                }
            }
        }
    });
    (url, bodies)
}

fn spans(body: &[u8]) -> Vec<Span> {
    let request = ExportTraceServiceRequest::decode(body).unwrap();
    let scopes = request.resource_spans.into_iter().flat_map(|resource| {
        let attributes = format!("{:?}", resource.resource);
        assert!(attributes.contains("service.name") && attributes.contains("singulate"), "{attributes}");
        resource.scope_spans
    });
    scopes.flat_map(|scope| scope.spans).collect()
}

async fn call(app: &Arc<App>, traceparent: &str) {
    let body = r#"{"table": {"x_min": 0, "y_min": 0, "x_max": 1, "y_max": 1},
        "gripper": {"fingers": 3, "finger_width": 0.02, "clearance": 0.05},
        "objects": [{"id": "a", "x": 0.5, "y": 0.5, "radius": 0.1}], "target": "a"}"#;
    let request = Request::post("/v1/plans").header(header::CONTENT_TYPE, "application/json");
    let request = request.header("traceparent", traceparent).body(Body::from(body)).unwrap();
    assert_eq!(router(app).oneshot(request).await.unwrap().status(), 200);
}

#[test]
fn a_planning_call_arrives_as_spans_of_its_clients_trace() {
    let (url, bodies) = collector();
    let export = init("off", LogFormat::Text, Some(&url.parse().unwrap())).unwrap().unwrap();
    let runtime = tokio::runtime::Runtime::new().unwrap();
    runtime.block_on(async {
        let jobs = JobSettings { url: "sqlite::memory:".to_owned(), ..JobSettings::default() };
        let settings = ServerSettings { jobs, ..ServerSettings::default() };
        let app = Arc::new(App::start(settings, Engine::default()).await.unwrap());
        call(&app, "00-0af7651916cd43dd8448eb211c80319c-b7ad6b7169203331-01").await;
        // Its client wants no record of this one.
        call(&app, "00-11111111111111111111111111111111-b7ad6b7169203331-00").await;
        // This one begins a trace of its own.
        call(&app, "not valid").await;
    });
    drop(runtime);
    export.finish();
    let mut all = Vec::new();
    // The flush may come as one batch or as several.
    while all.len() < 12 {
        all.extend(spans(&bodies.recv_timeout(PATIENCE).expect("spans arrive")));
    }
    assert_eq!(all.len(), 12, "{all:?}");
    let trace = 0x0af7_6519_16cd_43dd_8448_eb21_1c80_319c_u128.to_be_bytes();
    let (ours, own): (Vec<&Span>, Vec<&Span>) = all.iter().partition(|span| span.trace_id == trace);
    assert_eq!((ours.len(), own.len()), (6, 6));
    let find = |name: &str| *ours.iter().find(|span| span.name == name).unwrap_or_else(|| panic!("{name} in {ours:?}"));
    let request = find("POST /v1/plans");
    assert_eq!(request.parent_span_id, 0xb7ad_6b71_6920_3331_u64.to_be_bytes());
    let attributes = format!("{:?}", request.attributes);
    assert!(attributes.contains("http.response.status_code") && attributes.contains("IntValue(200)"), "{attributes}");
    let plan = find("plan");
    assert_eq!(plan.parent_span_id, request.span_id);
    assert!(format!("{:?}", plan.attributes).contains("graspable"));
    for phase in ["knowledge", "search", "placement", "check"] {
        let phase = find(phase);
        assert_eq!(phase.parent_span_id, plan.span_id);
        assert!(plan.start_time_unix_nano <= phase.start_time_unix_nano, "{phase:?} in {plan:?}");
        assert!(phase.start_time_unix_nano <= phase.end_time_unix_nano, "{phase:?}");
    }
    assert!(own.iter().any(|span| span.name == "POST /v1/plans" && span.parent_span_id.is_empty()), "{own:?}");
}
