//! Every route on one screen.

use std::sync::Arc;

use axum::Router;
use axum::middleware::from_fn_with_state;
use axum::routing::get;
use tower_http::catch_panic::CatchPanicLayer;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

use super::app::App;
use super::{
    certificate, docs, document, edge, jobs, knowledge, metrics, plans, probes, problem, survey, verification,
};

/// The routes that the interface document describes.
pub(super) fn routes() -> OpenApiRouter<Arc<App>> {
    OpenApiRouter::with_openapi(document::blank())
        .routes(routes!(plans::plan))
        .routes(routes!(verification::verify))
        .routes(routes!(survey::survey))
        .routes(routes!(knowledge::knowledge))
        .routes(routes!(jobs::submit, jobs::list))
        .routes(routes!(jobs::batch))
        .routes(routes!(jobs::show, jobs::forget))
        .routes(routes!(jobs::events))
        .routes(routes!(jobs::cancel))
        .routes(routes!(probes::livez))
        .routes(routes!(probes::readyz))
        .routes(routes!(probes::version))
        .routes(routes!(metrics::metrics))
        .routes(routes!(document::serve))
}

/// The whole service.
pub fn router(app: Arc<App>) -> Router {
    let (router, _) = routes().split_for_parts();
    router
        .route("/docs", get(docs::to_folder))
        .route("/docs/", get(docs::page))
        .route("/docs/{*file}", get(docs::file))
        .fallback(problem::not_found)
        .method_not_allowed_fallback(problem::method_not_allowed)
        .layer(CatchPanicLayer::custom(problem::panicked))
        .layer(from_fn_with_state(Arc::clone(&app), certificate::each_request))
        .layer(from_fn_with_state(Arc::clone(&app), edge::each_request))
        .with_state(app)
}
