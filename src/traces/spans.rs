//! The spans that there are.

use std::sync::OnceLock;
use std::time::SystemTime;

use opentelemetry::trace::{SpanBuilder, SpanKind, Status, TraceContextExt, Tracer};
use opentelemetry::{Context, KeyValue};
use opentelemetry_sdk::trace::SdkTracer;

use super::traceparent::Traceparent;
use singulate_planner::plan::Answer;

static TRACER: OnceLock<SdkTracer> = OnceLock::new();

/// From now on spans go to this tracer. A second one is not heard: log lines too have one place a process.
pub fn collect(tracer: SdkTracer) {
    let _ = TRACER.set(tracer);
}

/// From a request's head to its answer's. Ends when it is dropped.
#[derive(Debug)]
pub struct RequestSpan(Context);

impl RequestSpan {
    /// Begin; `None` where nobody collects. The route is its template.
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

    /// What is done in this context is done for the request.
    pub fn context(&self) -> Context {
        self.0.clone()
    }

    /// How it ended; without a status its client had gone.
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

/// One planning, within whatever context it runs.
#[derive(Debug)]
pub struct PlanSpan {
    tracer: &'static SdkTracer,
    context: Context,
    began: SystemTime,
}

impl PlanSpan {
    /// Begin; `None` where nobody collects.
    pub fn begin() -> Option<Self> {
        let tracer = TRACER.get()?;
        let began = SystemTime::now();
        let span = SpanBuilder::from_name("plan").with_start_time(began).start(tracer);
        Some(Self { tracer, context: Context::new().with_span(span), began })
    }

    /// The planner's answer. The core keeps no spans, only how long each phase took: they are laid end to end.
    pub fn answered(&self, answer: &Answer) {
        let span = self.context.span();
        if !span.is_recording() {
            return;
        }
        span.set_attribute(KeyValue::new("singulate.verdict", answer.verdict.as_str()));
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
