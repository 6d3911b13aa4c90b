//! A small hitting set, not always a least one.

use super::branch::most_wanted;
use super::instance::{Decided, Instance};
use super::reduce::reduce;
use crate::budget::Interrupted;
use crate::search::pace::Pace;
use crate::search::problem::Node;

/// Decide what needs no choice, take the element that meets most, and again. Of a landmark without members nothing is said.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub(in crate::search) fn greedy(landmarks: &[Vec<Node>], pace: &mut Pace<'_>) -> Result<Vec<Node>, Interrupted> {
    let (mut instance, mut decided) = (Instance::read(landmarks, pace)?, Decided::default());
    while reduce(&mut instance, &mut decided, pace)? {
        pace.step(instance.steps())?;
        let Some(element) = most_wanted(&instance) else { break };
        instance.take(element, &mut decided);
    }
    let mut found = decided.complete(Vec::new());
    found.sort_unstable();
    Ok(found)
}
