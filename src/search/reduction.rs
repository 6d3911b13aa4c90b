//! Before the search: away with all that can't be part of any plan.

use super::chain::Chain;
use super::outcome::Restriction;
use super::problem::Problem;
use crate::budget::{Budget, Interrupted};
use crate::knowledge::KnowledgeBase;
use crate::scene::ObjectIndex;

/// The problem without rules that hold the target, a held or an underivable object, and without objects on which the
/// target does not depend. `Ok(None)` if the target can't be derived.
pub(super) fn reduce(
    base: &KnowledgeBase,
    target: ObjectIndex,
    restriction: &Restriction,
    budget: &Budget<'_>,
) -> Result<Option<Problem>, Interrupted> {
    let held = |object: &ObjectIndex| *object == target || restriction.held.contains(object);
    let all = reached(base, target, |option| !option.iter().any(held), budget)?;
    let mut chain = Chain::new(&all);
    for node in 0..all.target() {
        if node % 64 == 0 {
            budget.check()?;
        }
        chain.allow(node);
    }
    if !chain.reaches_target() {
        return Ok(None);
    }
    let mut derivable = vec![false; base.len()];
    chain.moved().for_each(|node| derivable[all.object(node).get()] = true);
    reached(base, target, |option| option.iter().all(|member| derivable[member.get()]), budget).map(Some)
}

/// What the target depends on through options that are `usable`: breadth first backwards from the target, numbered in
/// reverse, so that whatever is near the target comes late.
fn reached(
    base: &KnowledgeBase,
    target: ObjectIndex,
    usable: impl Fn(&[ObjectIndex]) -> bool,
    budget: &Budget<'_>,
) -> Result<Problem, Interrupted> {
    let mut seen = vec![false; base.len()];
    let mut objects = vec![target];
    let mut at = 0;
    while let Some(&object) = objects.get(at) {
        at += 1;
        budget.check()?;
        for &member in base.options(object).filter(|option| usable(option)).flatten() {
            if !core::mem::replace(&mut seen[member.get()], true) {
                objects.push(member);
            }
        }
    }
    objects.reverse();
    Problem::over(base, objects, usable, budget)
}
