//! How much memory the search takes.

/// Limits of memory. Past them it takes longer, and comes to the same optimum.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Memory {
    /// Of the open choices of a hitting set search, in words of 8 bytes; what is forgotten is computed again.
    pub words: usize,
    /// What all clauses may hold together. Past that they have no more to say, and hitting sets go on alone.
    pub literals: usize,
}

/// Some 32 MB and 100 MB. No base of a scene that we made has needed a tenth of either.
impl Default for Memory {
    fn default() -> Self {
        Self { words: 4_000_000, literals: 16_000_000 }
    }
}
