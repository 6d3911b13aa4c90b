//! `GET /metrics`.

use std::sync::Arc;

use axum::extract::State;
use axum::http::header;
use axum::response::IntoResponse;
use tokio::time::timeout;

use super::app::App;
use super::probes::STORE_PATIENCE;
use crate::jobs::Counts;
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
    app.metrics.set_busy(Queue::Job, app.runner.busy());
    // Where the store does not answer, what it said last still stands.
    if let Ok(Ok(Counts { queued, running })) = timeout(STORE_PATIENCE, app.store.counts()).await {
        app.metrics.set_jobs(queued, running);
    }
    ([(header::CONTENT_TYPE, MEDIA_TYPE)], app.metrics.text())
}
