//! What browsers are told: headers for security and caching, and CORS, which lets pages of listed origins call. None is,
//! unless the operator lists it.

use core::fmt;
use core::str::FromStr;
use core::time::Duration;

use axum::body::Body;
use axum::http::{HeaderName, HeaderValue, Method, Request, header};
use axum::middleware::Next;
use axum::response::Response;
use tower_http::cors::{AllowOrigin, CorsLayer};
use url::Url;

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

/// The middleware that adds the headers.
pub(super) async fn add_headers(request: Request<Body>, next: Next) -> Response {
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

/// How long a browser may cache a preflight: a change of the list takes effect within the hour.
const MAX_AGE: Duration = Duration::from_secs(3600);

/// The allowed origins, each as browsers write it: `https://cell.example.com`.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct CorsOrigins(Vec<String>);

impl CorsOrigins {
    /// The CORS layer, if any origin is allowed. It also answers preflight requests, which have no key.
    pub(super) fn layer(&self) -> Option<CorsLayer> {
        if self.0.is_empty() {
            return None;
        }
        let origins: Vec<HeaderValue> = self.0.iter().filter_map(|origin| origin.parse().ok()).collect();
        let layer = CorsLayer::new()
            .allow_origin(AllowOrigin::list(origins))
            .allow_methods([Method::GET, Method::POST, Method::DELETE])
            .allow_headers(
                ["authorization", "content-type", "idempotency-key", "last-event-id", "traceparent", "x-request-id"]
                    .map(HeaderName::from_static),
            )
            .expose_headers([header::LOCATION, header::RETRY_AFTER, HeaderName::from_static("x-request-id")])
            .max_age(MAX_AGE);
        Some(layer)
    }
}

impl FromStr for CorsOrigins {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "none" {
            return Ok(Self::default());
        }
        text.split(',').map(|entry| origin(entry.trim())).collect::<Result<_, _>>().map(Self)
    }
}

/// One origin, if it is written as browsers send it.
fn origin(text: &str) -> Result<String, String> {
    if text.contains('*') {
        return Err("'*' would admit unknown pages; list each origin".to_owned());
    }
    let url = Url::parse(text).ok().filter(|url| ["http", "https"].contains(&url.scheme()));
    // Origins are compared as text, so one that browsers write differently would never match.
    match url.map(|url| url.origin().ascii_serialization()) {
        Some(origin) if origin == text => Ok(origin),
        Some(origin) => Err(format!("'{text}' is no origin; browsers write {origin}")),
        None => Err(format!("'{text}' is no origin like https://cell.example.com")),
    }
}

impl fmt::Display for CorsOrigins {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.0.is_empty() { "none" } else { "" })?;
        f.write_str(&self.0.join(","))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn origins_are_listed_as_browsers_write_them() {
        let list = "https://cell.example.com,http://localhost:3000";
        assert_eq!(list.parse::<CorsOrigins>().unwrap().to_string(), list);
        assert_eq!("none".parse::<CorsOrigins>().unwrap(), CorsOrigins::default());
        assert!("none".parse::<CorsOrigins>().unwrap().layer().is_none());
        for (wrong, said) in [
            ("*", "list each origin"),
            ("https://a.example,*", "list each origin"),
            ("https://a.example/", "browsers write https://a.example"),
            ("https://A.example", "browsers write https://a.example"),
            ("https://a.example:443", "browsers write https://a.example"),
            ("https://*.example", "list each origin"),
            ("a.example", "is no origin"),
            ("null", "is no origin"),
            ("ftp://a.example", "is no origin"),
            ("", "is no origin"),
        ] {
            assert!(wrong.parse::<CorsOrigins>().unwrap_err().contains(said), "{wrong}");
        }
    }
}
