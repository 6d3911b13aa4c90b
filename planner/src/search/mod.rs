//! The least set of objects that must be relocated, with its proof: implicit hitting sets.
//!
//! This is optimal delete-relaxation planning by landmarks and hitting sets (Haslum, Slaney & Thiébaux 2012). A least
//! hitting set H of the known landmarks bounds every plan from below. If the target follows with only H movable, H is
//! optimal. Otherwise H grows to a maximal set from which the target still does not follow, and its complement is a new
//! landmark. The landmarks are the proof of optimality. Where there are too many, core-guided MaxSAT takes turns with
//! them (`clauses`).

mod alternatives;
mod bits;
mod clauses;
mod fact_landmarks;
mod forward_chaining;
mod hitting;
mod incumbent;
mod landmark;
mod least;
#[cfg(test)]
mod looks;
mod outcome;
mod preprocessing;
mod problem;
mod proof;
#[cfg(test)]
mod tests;

pub use alternatives::Alternatives;
pub use least::{least, least_within};
pub use outcome::{Derivation, Incumbent, LeastSet, Memory, Progress, Restriction, SILENT, SearchOutcome};
