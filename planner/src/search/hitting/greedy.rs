//! A small hitting set, not always a least one.

use super::branch::most_frequent;
use super::instance::{Decided, Instance};
use super::reduce::reduce;
use crate::budget::{Interrupted, Ticker};
use crate::search::problem::Node;

/// Greedy hitting set: reduce, take the most frequent element, repeat. Landmarks without members are ignored.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub(in crate::search) fn greedy(landmarks: &[Vec<Node>], ticker: &mut Ticker<'_>) -> Result<Vec<Node>, Interrupted> {
    let (mut instance, mut decided) = (Instance::read(landmarks, ticker)?, Decided::default());
    while reduce(&mut instance, &mut decided, ticker)? {
        ticker.step(instance.steps())?;
        let Some(element) = most_frequent(&instance) else { break };
        instance.take(element, &mut decided);
    }
    let mut found = decided.complete(Vec::new());
    found.sort_unstable();
    Ok(found)
}
