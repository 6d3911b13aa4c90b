//! The least set by core-guided MaxSAT, for bases where landmarks alone don't prove the bound.
//!
//! A landmark says what the target needs, not what a moved object needs in turn. Here both are hard clauses
//! (`encoding`), and "this object is not moved" is a soft literal for each object. A CDCL solver (`solver`) assumes all
//! soft literals at once. Each unsatisfiable core raises the bound by one and is relaxed with a totalizer (`max_sat`,
//! `totalizer`; OLL, Andres et al. 2012). Sets that only support themselves are cut off by loop nogoods as they appear
//! (`unfounded_sets`).

mod encoding;
mod max_sat;
mod solver;
#[cfg(test)]
mod tests;
mod totalizer;
mod unfounded_sets;

pub(super) use encoding::Facts;
pub(super) use max_sat::MaxSat;
