//! How one of the paper's searches ends.

use crate::search::Derivation;

/// What a search of the paper's says. It comes without proof.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Conclusion {
    /// Relocate these, in this order.
    Sequence(Derivation),
    /// It knows no sequence and says that there is none.
    Deadlock,
    /// It reached its limit of memory first.
    TooLarge,
}
