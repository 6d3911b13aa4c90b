//! Runs computations on dedicated threads, so that they don't block the rest of the service.

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
