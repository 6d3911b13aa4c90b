//! The caller's settings.

use crate::placement::Objective;

/// The settings of a plan.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Settings {
    /// The preferred places.
    pub objective: Objective,
}
