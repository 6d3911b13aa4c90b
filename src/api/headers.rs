//! Header fields for browsers: what an answer may do there, and who may keep it.

use axum::body::Body;
use axum::http::{HeaderName, HeaderValue, Request, header};
use axum::middleware::Next;
use axum::response::Response;

/// An answer is data: it loads nothing, runs nothing and stands in nobody's frame. A drawing has attributes, no styles.
const DATA_POLICY: &str = "default-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// The page of the interface document has scripts and styles of its own, writes further styles while it runs, and calls
/// this service. Its stylesheet holds pictures.
const PAGE_POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; \
    img-src 'self' data:; connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// What every answer has that is data.
pub(super) const OF_DATA: [(HeaderName, &str); 4] = [
    (header::CONTENT_SECURITY_POLICY, DATA_POLICY),
    (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
    (header::X_FRAME_OPTIONS, "DENY"),
    (header::REFERRER_POLICY, "no-referrer"),
];

/// The middleware that adds them.
pub(super) async fn add(request: Request<Body>, next: Next) -> Response {
    let path = request.uri().path();
    let page = path.starts_with("/docs/");
    // What a key opens is not for whoever shares a cache with its holder.
    let private = path.starts_with("/v1/") || ["/metrics", "/version"].contains(&path);
    let mut response = next.run(request).await;
    let headers = response.headers_mut();
    for (name, value) in OF_DATA {
        headers.insert(name, HeaderValue::from_static(value));
    }
    if page {
        headers.insert(header::CONTENT_SECURITY_POLICY, HeaderValue::from_static(PAGE_POLICY));
    }
    if private {
        headers.insert(header::CACHE_CONTROL, HeaderValue::from_static("no-store"));
    }
    response
}
