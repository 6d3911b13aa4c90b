//! API keys: callers, scopes and rates.
//!
//! The keys file holds only digests, so reading it gives no access. [`Keys`] are those in force, [`FreshKey`] a new
//! one.

mod entry;
mod file;
mod in_force;
mod rights;

pub use entry::{ANONYMOUS, FreshKey, without_keys};
pub use file::{KeysError, append};
pub use in_force::{FoundKey, Keys};
pub use rights::{Rate, Scope, Scopes};
