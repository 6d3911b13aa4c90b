//! Spans: the planning that a request caused, and the time of each part.
//!
//! They go to the tracer given to [`collect`], once per process; without one they cost a check. The OpenTelemetry
//! context carries a request's span to the planning thread.

mod spans;
mod traceparent;

pub use opentelemetry::Context;
pub use spans::{PlanSpan, RequestSpan, collect};
pub use traceparent::Traceparent;
