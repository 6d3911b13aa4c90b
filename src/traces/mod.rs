//! Spans: which request led to which planning, and how long each part took.
//!
//! They go to whatever [`collect`] names, once a process; as long as it names nothing they cost a look. The context of
//! OpenTelemetry carries a request's span to the thread that plans.

mod spans;
mod traceparent;

pub use opentelemetry::Context;
pub use spans::{PlanSpan, RequestSpan, collect};
pub use traceparent::Traceparent;
