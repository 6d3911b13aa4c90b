//! Security and caching headers for browsers.

use axum::body::Body;
use axum::http::{HeaderName, HeaderValue, Request, header};
use axum::middleware::Next;
use axum::response::Response;

/// Answers are data: they load nothing, run nothing, and are in no frame. A drawing has attributes, no styles.
const DATA_POLICY: &str = "default-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// The page of the interface document has its own scripts and styles, adds styles while it runs, and calls this
/// service. Its stylesheet holds pictures.
const PAGE_POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; \
    img-src 'self' data:; connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// The headers of all data answers.
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
    // Answers that need a key must not be stored in shared caches.
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
