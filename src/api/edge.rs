//! What each request leaves behind: one line in the log, one measurement, and a span where traces are collected.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, LazyLock};
use std::time::{Instant, SystemTime, UNIX_EPOCH};

use axum::body::Body;
use axum::extract::{MatchedPath, State};
use axum::http::{HeaderName, HeaderValue, Method, Request};
use axum::middleware::Next;
use axum::response::Response;
use opentelemetry::context::FutureExt;
use tracing::{Instrument, Span, field};

use super::app::App;
use crate::metrics::Metrics;
use crate::traces::{RequestSpan, Traceparent};

const REQUEST_ID: HeaderName = HeaderName::from_static("x-request-id");
const TRACEPARENT: HeaderName = HeaderName::from_static("traceparent");

/// The longest request id that is taken over from a client, characters.
const MAX_REQUEST_ID: usize = 128;

/// Tells of the request once it is answered, or once its client has hung up.
struct Trail {
    line: Span,
    span: Option<RequestSpan>,
    metrics: Arc<Metrics>,
    method: Method,
    path: Option<MatchedPath>,
    started: Instant,
    status: Option<u16>,
}

impl Drop for Trail {
    fn drop(&mut self) {
        let took = self.started.elapsed();
        let ms = took.as_secs_f64() * 1000.0;
        self.line.in_scope(|| match self.status {
            Some(status) => tracing::info!(status, ms, "answered"),
            None => tracing::info!(ms, "the client hung up"),
        });
        self.metrics.request(template(self.path.as_ref()), self.method.as_str(), self.status, took);
        if let Some(span) = &self.span {
            span.answered(self.status);
        }
    }
}

/// The middleware round every handler.
pub(super) async fn each_request(State(app): State<Arc<App>>, request: Request<Body>, next: Next) -> Response {
    let started = Instant::now();
    let (id, method) = (request_id(&request), request.method().clone());
    let matched = request.extensions().get::<MatchedPath>().cloned();
    let path = template(matched.as_ref());
    let parent = request.headers().get(TRACEPARENT).and_then(|value| Traceparent::parse(value.to_str().ok()?));
    let trace_id = parent.as_ref().map(field::display);
    let line =
        tracing::info_span!("request", %method, path, id = ?id, trace_id, key = field::Empty, scene_id = field::Empty);
    let span = RequestSpan::begin(method.as_str(), path, id.to_str().unwrap_or_default(), parent.as_ref());
    let context = span.as_ref().map(RequestSpan::context);
    let metrics = Arc::clone(&app.metrics);
    let mut trail = Trail { line: line.clone(), span, metrics, method, path: matched, started, status: None };
    let answered = next.run(request).instrument(line);
    let mut response = match context {
        Some(context) => answered.with_context(context).await,
        None => answered.await,
    };
    trail.status = Some(response.status().as_u16());
    response.headers_mut().insert(REQUEST_ID, id);
    response
}

/// The route, without anything of the request's own.
fn template(path: Option<&MatchedPath>) -> &str {
    path.map_or("unmatched", MatchedPath::as_str)
}

/// Name the caller's key in the request's log lines.
pub(super) fn note_key(name: &str) {
    Span::current().record("key", name);
}

/// Name the scene in the request's log lines.
pub(super) fn note_scene(scene_id: Option<&str>) {
    if let Some(scene_id) = scene_id {
        Span::current().record("scene_id", field::debug(scene_id));
    }
}

/// The client's own id if it is a decent one, a new one otherwise.
fn request_id(request: &Request<Body>) -> HeaderValue {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    // Ids of two runs of the service must differ; its start time tells them apart.
    static START: LazyLock<u64> = LazyLock::new(|| {
        let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
        since.as_secs() * 1000 + u64::from(since.subsec_millis())
    });
    let given = request.headers().get(REQUEST_ID);
    let decent = |value: &&HeaderValue| !value.is_empty() && value.len() <= MAX_REQUEST_ID && value.to_str().is_ok();
    given.filter(decent).cloned().unwrap_or_else(|| {
        let id = format!("{:x}-{:x}", *START, NEXT.fetch_add(1, Ordering::Relaxed));
        HeaderValue::from_str(&id).unwrap_or(HeaderValue::from_static("unnamed"))
    })
}
