//! One line in the log for each request.

use std::sync::LazyLock;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Instant, SystemTime, UNIX_EPOCH};

use axum::body::Body;
use axum::extract::MatchedPath;
use axum::http::{HeaderName, HeaderValue, Request};
use axum::middleware::Next;
use axum::response::Response;
use tracing::{Instrument, Span, field};

const REQUEST_ID: HeaderName = HeaderName::from_static("x-request-id");

/// The longest request id that is taken over from a client, characters.
const MAX_REQUEST_ID: usize = 128;

/// Logs the request once it is answered, or once its client has hung up.
struct Line {
    span: Span,
    started: Instant,
    status: Option<u16>,
}

impl Drop for Line {
    fn drop(&mut self) {
        let ms = self.started.elapsed().as_secs_f64() * 1000.0;
        self.span.in_scope(|| match self.status {
            Some(status) => tracing::info!(status, ms, "answered"),
            None => tracing::info!(ms, "the client hung up"),
        });
    }
}

/// The middleware round every handler.
pub(super) async fn each_request(request: Request<Body>, next: Next) -> Response {
    let id = request_id(&request);
    let path = request.extensions().get::<MatchedPath>().map_or("unmatched", MatchedPath::as_str);
    let span = tracing::info_span!("request", method = %request.method(), path, id = ?id, scene_id = field::Empty);
    let mut line = Line { span: span.clone(), started: Instant::now(), status: None };
    let mut response = next.run(request).instrument(span).await;
    line.status = Some(response.status().as_u16());
    response.headers_mut().insert(REQUEST_ID, id);
    response
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
