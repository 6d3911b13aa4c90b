//! The least set of objects that must be relocated, with its proof.
//!
//! Optimal delete-relaxation planning, by landmarks and hitting sets (Haslum, Slaney & Thiébaux 2012): keep a set of
//! landmarks; a least hitting set H of them bounds every plan from below. If the target follows with only H movable, H is
//! optimal. Otherwise grow H to a maximal set from which the target still does not follow: its complement is a new
//! landmark. The landmarks are the proof of optimality; where they don't come to an end, clauses do (`clauses`).

mod alternatives;
mod bits;
mod chain;
mod clauses;
mod hitting;
mod incumbent;
mod landmark;
mod least;
mod memory;
mod necessary;
mod outcome;
mod pace;
mod problem;
mod proof;
mod reduction;
#[cfg(test)]
mod tests;

pub use alternatives::Alternatives;
pub use least::{least, least_within};
pub use memory::Memory;
pub use outcome::{Derivation, LeastSet, Outcome, Restriction};
