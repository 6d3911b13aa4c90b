//! Requirements on requests to a TLS service: TLS, and a client certificate.

use std::sync::Arc;

use axum::extract::{Request, State};
use axum::http::{HeaderValue, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use super::transport::OverTls;
use crate::metrics::{Metrics, Refusal};
use crate::tls::TlsSettings;
use crate::wire::{Problem, ProblemKind};

/// Probes, which need no client certificate.
const PROBES: [&str; 2] = ["/livez", "/readyz"];

/// The requirements.
#[derive(Clone)]
pub(super) struct Demands {
    tls: bool,
    client_certificate: bool,
    metrics: Arc<Metrics>,
}

impl Demands {
    pub(super) fn new(settings: &TlsSettings, metrics: Arc<Metrics>) -> Self {
        Self { tls: settings.cert.is_some(), client_certificate: settings.client_ca.is_some(), metrics }
    }
}

/// The middleware that refuses requests without TLS.
pub(super) async fn over_tls(State(demands): State<Demands>, request: Request, next: Next) -> Response {
    if !demands.tls || request.extensions().get::<OverTls>().is_some() {
        return next.run(request).await;
    }
    last(Problem::new(ProblemKind::MalformedHttp, "this port speaks TLS; use https"))
}

/// The middleware that requires a client certificate if one is needed.
pub(super) async fn each_request(State(demands): State<Demands>, request: Request, next: Next) -> Response {
    if !demands.client_certificate || PROBES.contains(&request.uri().path()) {
        return next.run(request).await;
    }
    let shown = request.extensions().get::<OverTls>().and_then(|mark| mark.client_certificate.clone());
    if shown.as_ref().is_some_and(|certificate| certificate.holds()) {
        return next.run(request).await;
    }
    demands.metrics.refused(Refusal::Unauthorized);
    let refused = |detail| Problem::new(ProblemKind::Unauthorized, detail);
    match shown {
        None => refused("there is no client certificate").into_response(),
        // On a new connection the client may show another one.
        Some(_) => last(refused("the client certificate is no longer valid")),
    }
}

/// The last answer on its connection.
fn last(problem: Problem) -> Response {
    let mut response = problem.into_response();
    response.headers_mut().insert(header::CONNECTION, HeaderValue::from_static("close"));
    response
}
