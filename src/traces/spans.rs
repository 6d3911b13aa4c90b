//! The spans of requests and plans.

use std::sync::OnceLock;
use std::time::SystemTime;

use opentelemetry::trace::{SpanBuilder, SpanKind, Status, TraceContextExt, Tracer};
use opentelemetry::{Context, KeyValue};
use opentelemetry_sdk::trace::SdkTracer;

use super::traceparent::Traceparent;
use singulate_planner::plan::Answer;

static TRACER: OnceLock<SdkTracer> = OnceLock::new();

/// From now on spans go to this tracer. A second call is ignored: a process has one tracer, as it has one log.
pub fn collect(tracer: SdkTracer) {
    let _ = TRACER.set(tracer);
}

/// A request, from its head to the end of its answer. Ends when dropped.
#[derive(Debug)]
pub struct RequestSpan(Context);

impl RequestSpan {
    /// Begin; `None` without a tracer. The route is its template.
    pub fn begin(method: &str, route: &str, id: &str, parent: Option<&Traceparent>) -> Option<Self> {
        let tracer = TRACER.get()?;
        let attributes = [
            KeyValue::new("http.request.method", method.to_owned()),
            KeyValue::new("http.route", route.to_owned()),
            KeyValue::new("singulate.request_id", id.to_owned()),
        ];
        let builder = SpanBuilder::from_name(format!("{method} {route}"));
        let builder = builder.with_kind(SpanKind::Server).with_attributes(attributes);
        let parent = parent.map(|parent| Context::new().with_remote_span_context(parent.span_context().clone()));
        let span = tracer.build_with_context(builder, &parent.unwrap_or_default());
        Some(Self(Context::new().with_span(span)))
    }

    /// Work in this context belongs to the request.
    pub fn context(&self) -> Context {
        self.0.clone()
    }

    /// The request's status; without one its client had hung up.
    pub fn answered(&self, status: Option<u16>) {
        let span = self.0.span();
        match status {
            Some(status) => {
                span.set_attribute(KeyValue::new("http.response.status_code", i64::from(status)));
                if status >= 500 {
                    span.set_status(Status::error(""));
                }
            }
            None => span.set_status(Status::error("the client hung up")),
        }
    }
}

impl Drop for RequestSpan {
    fn drop(&mut self) {
        self.0.span().end();
    }
}

/// One planning, in the current context.
#[derive(Debug)]
pub struct PlanSpan {
    tracer: &'static SdkTracer,
    context: Context,
    began: SystemTime,
}

impl PlanSpan {
    /// Begin; `None` without a tracer.
    pub fn begin() -> Option<Self> {
        let tracer = TRACER.get()?;
        let began = SystemTime::now();
        let span = SpanBuilder::from_name("plan").with_start_time(began).start(tracer);
        Some(Self { tracer, context: Context::new().with_span(span), began })
    }

    /// Records the answer. The planner gives only the duration of each phase, so their spans are laid end to end.
    pub fn answered(&self, answer: &Answer) {
        let span = self.context.span();
        if !span.is_recording() {
            return;
        }
        span.set_attribute(KeyValue::new("singulate.verdict", answer.statement.verdict_name()));
        let mut start = self.began;
        for (phase, took) in answer.statistics.phases() {
            let builder = SpanBuilder::from_name(phase).with_start_time(start);
            start += took;
            let child = builder.start_with_context(self.tracer, &self.context);
            Context::new().with_span(child).span().end_with_timestamp(start);
        }
    }
}

impl Drop for PlanSpan {
    fn drop(&mut self) {
        self.context.span().end();
    }
}
