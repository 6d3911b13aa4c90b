//! Before the search: away with all that can't be part of any plan, or need not be.

use super::chain::Chain;
use super::necessary::Necessary;
use super::outcome::Restriction;
use super::pace::Pace;
use super::problem::{MEMBERS_A_STEP, Node, Problem};
use crate::budget::Interrupted;
use crate::knowledge::KnowledgeBase;
use crate::scene::ObjectIndex;

/// A problem without rules and nodes that no least derivation needs.
pub(super) struct Reduced {
    pub(super) problem: Problem,
    /// What every derivation of the target holds; not all of it is known where there are very many nodes.
    pub(super) necessary: Vec<Node>,
}

/// The problem without rules that hold the target, a held or an underivable object, without rules in whose place another
/// one always serves, and without objects on which the target does not depend then. `Ok(None)` if the target can't be
/// derived.
///
/// A derivation stays one, in the same order: where a rule is left out, all that it asks for needs what another asks for
/// that stays. So landmarks of the reduced problem are landmarks.
pub(super) fn reduce(
    base: &KnowledgeBase,
    target: ObjectIndex,
    restriction: &Restriction,
    pace: &mut Pace<'_>,
) -> Result<Option<Reduced>, Interrupted> {
    pace.step(1 + (base.len() + restriction.held.len()) / 256)?;
    let mut held = vec![false; base.len()];
    restriction.held.iter().chain([&target]).for_each(|object| held[object.get()] = true);
    let all = reached(base, target, |option| !option.iter().any(|object| held[object.get()]), pace)?;
    let chain = everything(&all, pace)?;
    if !chain.reaches_target() {
        return Ok(None);
    }
    let derivable = |rule: u32, _: &mut Pace<'_>| Ok(all.body(rule).iter().all(|&node| chain.is_graspable(node)));
    let (all, _) = all.restricted(derivable, pace)?;
    let chain = everything(&all, pace)?;
    let order: Vec<Node> = chain.moved().chain([all.target()]).collect();
    let Some(known) = Necessary::of(&all, &order, pace)? else {
        return Ok(Some(Reduced { problem: all, necessary: Vec::new() }));
    };
    let needed = |rule: u32, pace: &mut Pace<'_>| {
        pace.step(all.rules_of(all.head(rule)).len() / 64)?;
        Ok(!known.is_idle(&all, rule))
    };
    let (problem, number) = all.restricted(needed, pace)?;
    let necessary =
        known.of_node(all.target()).filter_map(|node| number[node]).filter(|&node| node != problem.target());
    let necessary = necessary.collect();
    Ok(Some(Reduced { problem, necessary }))
}

/// Everything is moved that can be moved.
fn everything<'p>(problem: &'p Problem, pace: &mut Pace<'_>) -> Result<Chain<'p>, Interrupted> {
    let mut chain = Chain::new(problem);
    for node in 0..problem.target() {
        pace.step(1 + chain.steps())?;
        chain.allow(node);
    }
    Ok(chain)
}

/// What the target depends on through options that are `usable`: breadth first backwards from the target, numbered in
/// reverse, so that whatever is near the target comes late.
fn reached(
    base: &KnowledgeBase,
    target: ObjectIndex,
    usable: impl Fn(&[ObjectIndex]) -> bool,
    pace: &mut Pace<'_>,
) -> Result<Problem, Interrupted> {
    let mut seen = vec![false; base.len()];
    let mut objects = vec![target];
    let mut at = 0;
    while let Some(&object) = objects.get(at) {
        at += 1;
        let mut read = 0;
        for option in base.options(object) {
            read += 1 + option.len();
            if !usable(option) {
                continue;
            }
            for &member in option {
                if !core::mem::replace(&mut seen[member.get()], true) {
                    objects.push(member);
                }
            }
        }
        pace.step(1 + read / MEMBERS_A_STEP)?;
    }
    objects.reverse();
    Problem::over(base, objects, usable, pace)
}
