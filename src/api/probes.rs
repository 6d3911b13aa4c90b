//! `GET /livez`, `/readyz`, `/version`.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use serde::Serialize;
use utoipa::ToSchema;

use crate::wire::{Problem, ProblemKind};

use super::app::App;

/// The state of the service.
#[derive(Debug, Serialize, ToSchema)]
pub(super) struct ProbeBody {
    /// `ok`.
    #[schema(example = "ok")]
    status: &'static str,
}

/// The build that answers.
#[derive(Debug, Serialize, ToSchema)]
pub(super) struct VersionBody {
    /// The name of the service.
    #[schema(example = "singulate")]
    name: &'static str,
    /// Its version.
    #[schema(example = "0.1.0")]
    version: &'static str,
}

const OK: Json<ProbeBody> = Json(ProbeBody { status: "ok" });

/// Is the process alive?
///
/// Answers as long as the service can answer at all.
#[utoipa::path(get, path = "/livez", operation_id = "livez", tag = "operation", responses(
    (status = 200, description = "It is.", body = ProbeBody, content_type = "application/json"),
))]
pub(super) async fn livez() -> Json<ProbeBody> {
    OK
}

/// Does the service take requests?
///
/// It does not while it shuts down, or when a planning thread has died.
#[utoipa::path(get, path = "/readyz", operation_id = "readyz", tag = "operation", responses(
    (status = 200, description = "It does.", body = ProbeBody, content_type = "application/json"),
    (status = 503, description = "It does not.", body = Problem, content_type = "application/problem+json",
     headers(("Retry-After" = u32, description = "When to ask again, s."))),
))]
pub(super) async fn readyz(State(app): State<Arc<App>>) -> Result<Json<ProbeBody>, Problem> {
    if app.ready() {
        Ok(OK)
    } else {
        Err(Problem::new(ProblemKind::NotReady, "shutting down, or a planning thread died"))
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

#[cfg(test)]
mod tests {
    use axum::body::Body;
    use axum::http::{Request, StatusCode};
    use tower::ServiceExt;

    use super::*;
    use crate::api::{Engine, ServerSettings, router};

    async fn ask(app: &Arc<App>) -> StatusCode {
        let request = Request::get("/readyz").body(Body::empty()).unwrap();
        router(Arc::clone(app)).oneshot(request).await.unwrap().status()
    }

    #[tokio::test]
    async fn a_service_that_drains_or_lost_its_pool_is_not_ready() {
        let app = Arc::new(App::new(ServerSettings::default(), Engine::default()).unwrap());
        assert_eq!(ask(&app).await, StatusCode::OK);
        app.drain();
        assert_eq!(ask(&app).await, StatusCode::SERVICE_UNAVAILABLE);
        let app = Arc::new(App::new(ServerSettings::default(), Engine::default()).unwrap());
        app.pool.close();
        assert_eq!(ask(&app).await, StatusCode::SERVICE_UNAVAILABLE);
    }
}
