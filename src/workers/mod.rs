//! Runs computations on threads of their own, so that waiting for them costs the rest of the service nothing.

mod draining;
mod forecast;
mod pending;
mod pool;
mod queue;
#[cfg(test)]
mod tests;

pub use draining::Draining;
pub use pending::{Outcome, Pending, Recall};
pub use pool::{Pool, Refused};
