//! Memory limits of the search.

/// Memory limits. Past them the search takes longer and finds the same optimum.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Memory {
    /// The most words of 8 bytes for the open questions of a hitting set search. Past that, instances are forgotten and
    /// computed again.
    pub words: usize,
    /// The most literals of all clauses together. Past that MaxSAT stops, and hitting sets go on alone.
    pub literals: usize,
}

/// Some 32 MB and 100 MB. No generated scene has needed a tenth of either.
impl Default for Memory {
    fn default() -> Self {
        Self { words: 4_000_000, literals: 16_000_000 }
    }
}
