//! Runs computations on threads of their own, so that waiting for them costs the rest of the service nothing.

mod pool;

pub use pool::{Outcome, Pending, Pool, Refused};
