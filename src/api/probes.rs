//! `GET /livez`, `/readyz`, `/version`, `/metrics`: probes and monitoring.

use core::time::Duration;
use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::http::header;
use axum::response::IntoResponse;
use serde::Serialize;
use tokio::time::timeout;
use utoipa::ToSchema;

use super::running::Running;
use crate::jobs::Counts;
use crate::metrics::{MEDIA_TYPE, Queue};
use crate::wire::{Problem, ProblemKind};

/// The state of the service.
#[derive(Debug, Serialize, ToSchema)]
pub(super) struct ProbeBody {
    /// `ok`.
    #[schema(example = "ok")]
    status: &'static str,
}

/// The running service.
#[derive(Debug, Serialize, ToSchema)]
pub(super) struct VersionBody {
    /// The name of the service.
    #[schema(example = "singulate")]
    name: &'static str,
    /// The version of the service.
    #[schema(example = "0.1.0")]
    version: &'static str,
}

/// How long a probe waits for the store of jobs; probers wait for about a second.
const STORE_PATIENCE: Duration = Duration::from_millis(500);

const OK: Json<ProbeBody> = Json(ProbeBody { status: "ok" });

/// Is the process alive?
///
/// Answers as long as the process can answer requests.
#[utoipa::path(get, path = "/livez", operation_id = "livez", tag = "operation", responses(
    (status = 200, description = "The process is alive.", body = ProbeBody, content_type = "application/json"),
))]
pub(super) async fn livez() -> Json<ProbeBody> {
    OK
}

/// Is the service ready?
///
/// It is not ready while it shuts down, after a planning thread has died, and while the store of jobs can't be reached.
#[utoipa::path(get, path = "/readyz", operation_id = "readyz", tag = "operation", responses(
    (status = 200, description = "The service is ready.", body = ProbeBody, content_type = "application/json"),
    (status = 503, description = "The service is not ready.", body = Problem, content_type = "application/problem+json",
     headers(("Retry-After" = u32, description = "Seconds to wait before asking again."))),
))]
pub(super) async fn readyz(State(running): State<Arc<Running>>) -> Result<Json<ProbeBody>, Problem> {
    if !running.ready() {
        return Err(Problem::new(ProblemKind::NotReady, "shutting down, or a planning thread died"));
    }
    match timeout(STORE_PATIENCE, running.store.ping()).await {
        Ok(Ok(())) => Ok(OK),
        _ => Err(Problem::new(ProblemKind::StoreUnavailable, "the store of jobs does not answer")),
    }
}

/// Which build answers?
///
/// The name and the version of the service.
#[utoipa::path(get, path = "/version", operation_id = "version", tag = "operation", responses(
    (status = 200, description = "Name and version.", body = VersionBody, content_type = "application/json"),
))]
pub(super) async fn version() -> Json<VersionBody> {
    Json(VersionBody { name: env!("CARGO_PKG_NAME"), version: env!("CARGO_PKG_VERSION") })
}

/// Metrics
///
/// Counters, gauges and histograms of this server since its start, as OpenMetrics text for Prometheus.
#[utoipa::path(get, path = "/metrics", operation_id = "metrics", tag = "operation", responses(
    (status = 200, description = "Every metric family with its series.", body = String,
     content_type = "application/openmetrics-text; version=1.0.0; charset=utf-8"),
))]
pub(super) async fn metrics(State(running): State<Arc<Running>>) -> impl IntoResponse {
    let Running { planning, store, runner, metrics, .. } = &*running;
    metrics.set_busy(Queue::Plan, planning.busy());
    metrics.set_busy(Queue::Job, runner.busy());
    // If the store does not answer, its last counts remain.
    if let Ok(Ok(Counts { queued, running })) = timeout(STORE_PATIENCE, store.counts()).await {
        metrics.set_jobs(queued, running);
    }
    ([(header::CONTENT_TYPE, MEDIA_TYPE)], metrics.text())
}

#[cfg(test)]
mod tests {
    use axum::body::Body;
    use axum::http::{Request, StatusCode};
    use tower::ServiceExt;

    use super::*;
    use crate::api::{App, Engine, ServerSettings, router};
    use crate::jobs::JobSettings;

    async fn started() -> Arc<App> {
        let jobs = JobSettings { url: "sqlite::memory:".to_owned(), ..JobSettings::default() };
        Arc::new(App::start(ServerSettings { jobs, ..ServerSettings::default() }, Engine::default()).await.unwrap())
    }

    async fn ask(app: &Arc<App>) -> StatusCode {
        let request = Request::get("/readyz").body(Body::empty()).unwrap();
        router(app).oneshot(request).await.unwrap().status()
    }

    #[tokio::test]
    async fn a_service_that_drains_or_lost_its_pool_is_not_ready() {
        let app = started().await;
        assert_eq!(ask(&app).await, StatusCode::OK);
        app.drain();
        assert_eq!(ask(&app).await, StatusCode::SERVICE_UNAVAILABLE);
        let app = started().await;
        app.running.planning.join();
        assert_eq!(ask(&app).await, StatusCode::SERVICE_UNAVAILABLE);
    }
}
