//! API keys: callers, scopes and rates.
//!
//! The keys file holds only digests, so reading it gives no access. [`Keys`] are those in force, [`FreshKey`] a new
//! one.

mod entry;
mod fresh;
mod in_force;
mod rate;
mod read;
mod scope;

pub use entry::{ANONYMOUS, without_keys};
pub use fresh::{FreshKey, append};
pub use in_force::{Found, Keys, KeysError};
pub use rate::Rate;
pub use scope::{Scope, Scopes};
