//! Callbacks on their way to receivers that do all that receivers do. Times are short only where a test waits for them.

mod delivery;
mod receiver;
mod refusal;
mod store;
