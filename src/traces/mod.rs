//! Spans: which request caused which planning, and how long each part took.
//!
//! They go to the tracer given to [`collect`], once per process; without one they cost a check. The OpenTelemetry
//! context carries a request's span to the planning thread.

mod spans;
mod traceparent;

pub use opentelemetry::Context;
pub use spans::{PlanSpan, RequestSpan, collect};
pub use traceparent::Traceparent;
