//! How the time is divided.

/// The share of the time for knowledge and search.
pub(crate) const SEARCH_SHARE: f64 = 0.6;
/// The share of the rest for placement, or for the locks of a deadlock; the last part is the checker's.
pub(crate) const PLACEMENT_SHARE: f64 = 0.75;
