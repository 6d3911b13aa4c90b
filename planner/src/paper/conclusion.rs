//! The result of a search of the paper.

use crate::search::Derivation;

/// The result of a search of the paper, without proof.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Conclusion {
    /// Relocate these, in this order.
    Sequence(Derivation),
    /// The search found no sequence and concludes that there is none.
    Deadlock,
    /// The search reached its memory limit first.
    TooLarge,
}
