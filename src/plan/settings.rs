//! What a caller may choose.

/// Which of the free places a relocated object goes to.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Objective {
    /// As far from the target as possible (the paper's).
    #[default]
    FarFromTarget,
    /// As near to its old place as possible.
    ShortMoves,
}

/// How to plan.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Settings {
    /// Where relocated objects go.
    pub objective: Objective,
}
