//! What a request over TLS needs, and what its answer says.

use std::sync::Arc;

use axum::extract::{Request, State};
use axum::http::{HeaderValue, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use super::app::App;
use super::transport::OverTls;
use crate::wire::{Problem, ProblemKind};

/// Paths that whoever looks after the service asks without a certificate.
const PROBES: [&str; 2] = ["/livez", "/readyz"];

/// A browser that was here does not come back without TLS for a year, whatever it is told to do.
const STRICT: HeaderValue = HeaderValue::from_static("max-age=31536000");

/// The middleware where TLS is spoken.
pub(super) async fn each_request(State(app): State<Arc<App>>, request: Request, next: Next) -> Response {
    let tls = &app.settings.tls;
    if tls.cert.is_none() {
        return next.run(request).await;
    }
    let Some(OverTls { client_certificate }) = request.extensions().get().copied() else {
        let mut response = Problem::new(ProblemKind::MalformedHttp, "this port speaks TLS: ask https").into_response();
        response.headers_mut().insert(header::CONNECTION, HeaderValue::from_static("close"));
        return response;
    };
    let stranger = tls.client_ca.is_some() && !client_certificate;
    let mut response = if stranger && !PROBES.contains(&request.uri().path()) {
        Problem::new(ProblemKind::Unauthorized, "no client certificate came").into_response()
    } else {
        next.run(request).await
    };
    response.headers_mut().insert(header::STRICT_TRANSPORT_SECURITY, STRICT);
    response
}
