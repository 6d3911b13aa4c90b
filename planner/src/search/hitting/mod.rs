//! A least hitting set of all landmarks, by branch and bound over rows of bits.
//!
//! Each question is first reduced (`reduce`) and split into parts that share no element. The Lagrangian bound of each
//! part prunes it, and fixes elements by reduced cost (`multipliers`). Then one element is taken or left out (`branch`,
//! `fork`). Open questions are kept in a list, so that no depth is too much (`branch_and_bound`).

mod branch;
mod branch_and_bound;
mod fork;
mod greedy;
mod instance;
mod multipliers;
mod reduce;
#[cfg(test)]
mod tests;

pub(super) use branch_and_bound::{Allowance, bound, least};
pub(super) use greedy::greedy;

use super::problem::Node;
use crate::budget::Stop;

/// A least hitting set; `None` if it has no fewer elements than the limit.
type Solution = Option<Vec<Node>>;

/// A search that stopped early.
#[derive(Debug)]
pub(super) struct Cut {
    /// No smaller set hits every landmark.
    pub(super) bound: usize,
    pub(super) stop: Stop,
}
