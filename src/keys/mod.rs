//! API keys: who may call, what for, and how often.
//!
//! The keys file knows only digests: whoever reads it can't call. [`Keys`] are those in force, [`FreshKey`] a new one.

mod entry;
mod fresh;
mod in_force;
mod rate;
mod read;
mod scope;

pub use entry::without_keys;
pub use fresh::{FreshKey, append};
pub use in_force::{Found, Keys, KeysError};
pub use rate::Rate;
pub use scope::{Scope, Scopes};
