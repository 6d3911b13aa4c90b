//! Every route on one screen, each with what it needs of a key.

use std::sync::Arc;

use axum::Router;
use axum::middleware::{from_fn, from_fn_with_state};
use axum::routing::get;
use tower_http::catch_panic::CatchPanicLayer;
use utoipa_axum::router::{OpenApiRouter, UtoipaMethodRouter};
use utoipa_axum::routes;

use super::access::{Need, guard};
use super::app::App;
use super::{
    certificate, docs, document, edge, headers, jobs, knowledge, metrics, plans, probes, problem, survey, verification,
};
use crate::keys::Scope;

const PLAN: Need = Need::OneOf(&[Scope::Plan]);
const JOBS: Need = Need::OneOf(&[Scope::Jobs]);
const READ_JOBS: Need = Need::OneOf(&[Scope::ReadOnly, Scope::Jobs]);
const METRICS: Need = Need::OneOf(&[Scope::Metrics]);

/// The operations that the interface document describes.
pub(super) fn operations() -> [(Need, UtoipaMethodRouter<Arc<App>>); 16] {
    [
        (PLAN, routes!(plans::plan)),
        (PLAN, routes!(verification::verify)),
        (PLAN, routes!(survey::survey)),
        (PLAN, routes!(knowledge::knowledge)),
        (JOBS, routes!(jobs::submit)),
        (READ_JOBS, routes!(jobs::list)),
        (JOBS, routes!(jobs::batch)),
        (READ_JOBS, routes!(jobs::show)),
        (JOBS, routes!(jobs::forget)),
        (READ_JOBS, routes!(jobs::events)),
        (JOBS, routes!(jobs::cancel)),
        (Need::Nothing, routes!(probes::livez)),
        (Need::Nothing, routes!(probes::readyz)),
        (Need::AnyKey, routes!(probes::version)),
        (METRICS, routes!(metrics::metrics)),
        (Need::Nothing, routes!(document::serve)),
    ]
}

/// The whole service.
pub fn router(app: Arc<App>) -> Router {
    let guarded = operations().into_iter().fold(OpenApiRouter::new(), |router, (need, (schemas, paths, route))| {
        let route = match need {
            Need::Nothing => route,
            _ => route.route_layer(from_fn_with_state((Arc::clone(&app), need), guard)),
        };
        router.routes((schemas, paths, route))
    });
    let (router, _) = guarded.split_for_parts();
    let router = router
        .route("/", get(docs::from_root))
        .route("/docs", get(docs::to_folder))
        .route("/docs/", get(docs::page))
        .route("/docs/{*file}", get(docs::file))
        .fallback(problem::not_found)
        .method_not_allowed_fallback(problem::method_not_allowed)
        .layer(CatchPanicLayer::custom(problem::panicked))
        .layer(from_fn_with_state(Arc::clone(&app), certificate::each_request));
    // What a browser asks ahead of a call comes without key and certificate.
    let router = match app.settings.cors_origins.layer() {
        Some(cors) => router.layer(cors),
        None => router,
    };
    let router = router.layer(from_fn_with_state(Arc::clone(&app), certificate::over_tls));
    router.layer(from_fn(headers::add)).layer(from_fn_with_state(Arc::clone(&app), edge::each_request)).with_state(app)
}
