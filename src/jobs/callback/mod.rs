//! Callbacks: a POST to the submitter's receiver when a job has ended.
//!
//! Only receivers on the operator's list are called ([`CallbackAllow`]). Each message is signed ([`CallbackSecret`]).
//! [`CallbackDelivery`] repeats it until the receiver has taken it or the tries are used up.

mod address;
mod allow;
mod client;
mod deliver;
mod destination;
mod sign;
mod silent;

pub use allow::CallbackAllow;
pub use client::{client_builder, trusted_roots};
pub(crate) use client::{client_builder_with, innermost};
pub use deliver::CallbackDelivery;
pub use destination::{CallbackFault, CallbackUrl};
pub use sign::CallbackSecret;

/// Callbacks against receivers with every kind of behaviour. Times are short only where a test waits for them.
#[cfg(test)]
mod tests {
    mod delivery;
    mod receiver;
    mod refusal;
    mod store;
}
