//! A least set that meets every landmark.
//!
//! Branch and bound over rows of bits. At each choice the instance is first cut down (`reduce`) and split into parts that
//! share no element; prices bound each part from below, and decide those elements that no small solution can do with, or
//! without (`prices`); then one element is taken or left out (`branch`).

mod branch;
mod greedy;
mod instance;
mod prices;
mod reduce;
#[cfg(test)]
mod tests;

pub(super) use branch::{bound, least};
pub(super) use greedy::greedy;
