//! A least set that meets every landmark.
//!
//! Branch and bound over rows of bits. At each choice the instance is first cut down (`reduce`) and split into parts that
//! share no element; prices bound each part from below, and decide those elements that no small solution can do with, or
//! without (`prices`); then one element is taken or left out (`branch`, `fork`). No depth is too much (`search`).

mod branch;
mod fork;
mod greedy;
mod instance;
mod prices;
mod reduce;
mod search;
#[cfg(test)]
mod tests;

pub(super) use greedy::greedy;
pub(super) use search::{Allowance, bound, least};

use super::problem::Node;
use crate::budget::Interrupted;

/// A solution; `None` if every one has at least as many elements as the limit.
type Found = Option<Vec<Node>>;

/// Why a search was not carried to its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stop {
    /// The choices are spent.
    Spent,
    /// The budget ended.
    Interrupted,
}

impl From<Interrupted> for Stop {
    fn from(Interrupted: Interrupted) -> Self {
        Self::Interrupted
    }
}

/// A search that was not carried to its end.
#[derive(Debug)]
pub(super) struct Cut {
    /// No set of fewer members meets every landmark.
    pub(super) bound: usize,
    pub(super) stop: Stop,
}
