//! `GET /metrics`.

use std::sync::Arc;

use axum::extract::State;
use axum::http::header;
use axum::response::IntoResponse;

use super::app::App;
use crate::metrics::{MEDIA_TYPE, Queue};

/// What is measured
///
/// Counters, gauges and histograms of this server since its start, for Prometheus; OpenMetrics text.
#[utoipa::path(get, path = "/metrics", operation_id = "metrics", tag = "operation", responses(
    (status = 200, description = "Every family with its series.", body = String,
     content_type = "application/openmetrics-text; version=1.0.0; charset=utf-8"),
))]
pub(super) async fn metrics(State(app): State<Arc<App>>) -> impl IntoResponse {
    app.metrics.set_busy(Queue::Plan, app.pool.busy());
    ([(header::CONTENT_TYPE, MEDIA_TYPE)], app.metrics.text())
}
