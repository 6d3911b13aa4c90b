//! The routes of the service, and their middleware.

use std::sync::Arc;

use axum::Router;
use axum::middleware::{from_fn, from_fn_with_state};
use axum::routing::get;
use tower_http::catch_panic::CatchPanicLayer;
use utoipa_axum::router::OpenApiRouter;

use super::access::{Need, guard};
use super::app::App;
use super::certificate::{self, Demands};
use super::operations::{Parts, operations};
use super::{browsers, docs, edge, problem};

/// The whole service.
pub fn router(app: &App) -> Router {
    let demands = Demands::new(&app.settings.tls, Arc::clone(&app.running.metrics));
    let router = guarded(app)
        .route("/", get(docs::from_root))
        .route("/docs", get(docs::to_folder))
        .route("/docs/", get(docs::page))
        .route("/docs/{*file}", get(docs::file))
        .fallback(problem::not_found)
        .method_not_allowed_fallback(problem::method_not_allowed)
        .layer(CatchPanicLayer::custom(problem::panicked))
        .layer(from_fn_with_state(demands.clone(), certificate::each_request));
    // Preflight requests of browsers have no key and no certificate.
    let router = match app.settings.cors_origins.layer() {
        Some(cors) => router.layer(cors),
        None => router,
    };
    let router = router.layer(from_fn_with_state(demands, certificate::over_tls)).layer(from_fn(browsers::add_headers));
    let told = from_fn_with_state(Arc::clone(&app.running.metrics), edge::each_request);
    router.layer(told).with_state(app.parts.clone())
}

/// The operations, each behind its access check.
fn guarded(app: &App) -> Router<Parts> {
    let guarded = operations().into_iter().fold(OpenApiRouter::new(), |router, (need, (schemas, paths, route))| {
        let route = match need {
            Need::Nothing => route,
            _ => route.route_layer(from_fn_with_state((Arc::clone(&app.gate), need), guard)),
        };
        router.routes((schemas, paths, route))
    });
    guarded.split_for_parts().0
}
