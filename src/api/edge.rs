//! One log line, one metric, and with tracing one span per request.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, LazyLock};
use std::time::{Instant, SystemTime, UNIX_EPOCH};

use axum::body::Body;
use axum::extract::{MatchedPath, State};
use axum::http::{HeaderName, HeaderValue, Method, Request, StatusCode, Uri};
use axum::middleware::Next;
use axum::response::Response;
use opentelemetry::context::FutureExt;
use tracing::{Instrument, Span, field};

use crate::keys::without_keys;
use crate::metrics::{Metrics, milliseconds};
use crate::traces::{RequestSpan, Traceparent};
use crate::wire::LoggedProblem;

const REQUEST_ID: HeaderName = HeaderName::from_static("x-request-id");
const TRACEPARENT: HeaderName = HeaderName::from_static("traceparent");

/// The longest request id accepted from a client, characters.
const MAX_REQUEST_ID: usize = 128;

/// The longest path or method that is logged, characters: enough for every path of ours, with a job's id.
const MAX_SHOWN: usize = 128;

/// Records the request once it is answered, or its client has hung up.
struct Trail {
    line: Span,
    span: Option<RequestSpan>,
    metrics: Arc<Metrics>,
    method: Method,
    route: Option<MatchedPath>,
    uri: Uri,
    started: Instant,
    status: Option<StatusCode>,
    /// The kind of the problem in the answer.
    cause: Option<LoggedProblem>,
}

impl Drop for Trail {
    fn drop(&mut self) {
        let took = self.started.elapsed();
        let ms = milliseconds(took);
        let status = self.status.map(|status| status.as_u16());
        let problem = self.cause.map(|cause| field::display(cause.problem));
        let code = self.cause.and_then(|cause| cause.code).map(field::display);
        let path = (self.status == Some(StatusCode::NOT_FOUND)).then(|| shown(self.uri.path()));
        self.line.in_scope(|| match status {
            Some(status) => tracing::info!(status, ms, problem, code, path, "answered"),
            None => tracing::info!(ms, "the client hung up"),
        });
        self.metrics.request(template(self.route.as_ref()), self.method.as_str(), status, took);
        if let Some(span) = &self.span {
            span.answered(status);
        }
    }
}

/// The middleware around every handler.
pub(super) async fn each_request(State(metrics): State<Arc<Metrics>>, request: Request<Body>, next: Next) -> Response {
    let started = Instant::now();
    let (id, method) = (request_id(&request), request.method().clone());
    let (matched, uri) = (request.extensions().get::<MatchedPath>().cloned(), request.uri().clone());
    let route = template(matched.as_ref());
    let name = id.to_str().unwrap_or_default();
    let parent = request.headers().get(TRACEPARENT).and_then(|value| Traceparent::parse(value.to_str().ok()?));
    let trace_id = parent.as_ref().map(field::display);
    let line = tracing::info_span!(
        "request",
        method = %shown(method.as_str()),
        route,
        id = name,
        trace_id,
        key = field::Empty,
        scene_id = field::Empty
    );
    let span = RequestSpan::begin(method.as_str(), route, name, parent.as_ref());
    let context = span.as_ref().map(RequestSpan::context);
    let around = line.clone();
    let mut trail = Trail { line, span, metrics, method, route: matched, uri, started, status: None, cause: None };
    let answered = next.run(request).instrument(around);
    let mut response = match context {
        Some(context) => answered.with_context(context).await,
        None => answered.await,
    };
    trail.status = Some(response.status());
    trail.cause = response.extensions().get::<LoggedProblem>().copied();
    response.headers_mut().insert(REQUEST_ID, id);
    response
}

/// The route's template, without the request's own parts.
fn template(path: Option<&MatchedPath>) -> &str {
    path.map_or("unmatched", MatchedPath::as_str)
}

/// A client's text for the log: bounded in length, and without possible keys.
fn shown(text: &str) -> String {
    let text = without_keys(text);
    match text.char_indices().nth(MAX_SHOWN) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text,
    }
}

/// The client's request id if it is valid, otherwise a new one.
fn request_id(request: &Request<Body>) -> HeaderValue {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    // Ids must differ between runs of the service, so they hold its start time.
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
