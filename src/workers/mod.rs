//! Runs computations on threads of their own, so that waiting for them costs the rest of the service nothing.

mod engine;
mod pending;
mod pool;

pub use engine::Engine;
pub use pending::{Ender, Outcome, Pending};
pub use pool::{Pool, Refused};
