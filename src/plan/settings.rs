//! What a caller may choose.

use crate::placement::Objective;

/// How to plan.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Settings {
    /// Where relocated objects go.
    pub objective: Objective,
}
