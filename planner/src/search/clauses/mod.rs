//! The least set by clauses, for what landmarks alone can't settle.
//!
//! A landmark says what the target needs, not what a moved object needs in turn. Here both are clauses, and a solver that
//! learns from its conflicts is asked to grant all wishes "this object is not moved" at once (`solver`, `model`). Wishes
//! that clash raise the bound by one and are weakened: of these, at most one is moved (`wishes`, `counter`; OLL, Andres
//! et al. 2012). Sets that hold themselves up in a circle are refused as they appear (`founded`).

mod counter;
mod founded;
mod model;
mod solver;
#[cfg(test)]
mod tests;
mod wishes;

pub(super) use model::Known;
pub(super) use wishes::Wishes;
