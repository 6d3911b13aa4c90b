//! Callbacks: whoever handed a job in is told of its end.
//!
//! Only receivers that the operator lists are told ([`CallbackAllow`]), each message is signed ([`CallbackSecret`]), and
//! [`CallbackDelivery`] repeats it until the receiver has taken it or has had enough chances.

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

/// Callbacks on their way to receivers that do all that receivers do. Times are short only where a test waits for them.
#[cfg(test)]
mod tests {
    mod delivery;
    mod receiver;
    mod refusal;
    mod store;
}
