//! Preprocessing: drop rules and objects that no least derivation needs.

use super::fact_landmarks::FactLandmarks;
use super::forward_chaining::ForwardChaining;
use super::outcome::Restriction;
use super::problem::{HornRules, MEMBERS_A_STEP, Node};
use crate::budget::{Interrupted, Ticker};
use crate::knowledge::KnowledgeBase;
use crate::scene::ObjectIndex;

/// The preprocessed problem.
pub(super) struct Preprocessed {
    pub(super) problem: HornRules,
    /// The fact landmarks of the target: nodes that every derivation holds. Empty where the problem is too large.
    pub(super) fact_landmarks: Vec<Node>,
}

/// Drops rules with the target, a held or an underivable object in their bodies, then dominated rules, then objects on
/// which the target no longer depends. `Ok(None)` if the target can't be derived.
///
/// Every derivation stays one, in the same order: the body of a dropped rule needs the body of a kept rule of the same
/// head. So landmarks of the preprocessed problem are landmarks.
pub(super) fn preprocess(
    base: &KnowledgeBase,
    target: ObjectIndex,
    restriction: &Restriction,
    ticker: &mut Ticker<'_>,
) -> Result<Option<Preprocessed>, Interrupted> {
    ticker.step(1 + (base.len() + restriction.held.len()) / 256)?;
    let mut held = vec![false; base.len()];
    restriction.held.iter().chain([&target]).for_each(|object| held[object.get()] = true);
    let all = reached(base, target, |option| !option.iter().any(|object| held[object.get()]), ticker)?;
    let chain = everything(&all, ticker)?;
    if !chain.reaches_target() {
        return Ok(None);
    }
    let derivable = |rule: u32, _: &mut Ticker<'_>| Ok(all.body(rule).iter().all(|&node| chain.is_graspable(node)));
    let (all, _) = all.restricted(derivable, ticker)?;
    let chain = everything(&all, ticker)?;
    let order: Vec<Node> = chain.moved().chain([all.target()]).collect();
    let Some(known) = FactLandmarks::of(&all, &order, ticker)? else {
        return Ok(Some(Preprocessed { problem: all, fact_landmarks: Vec::new() }));
    };
    let needed = |rule: u32, ticker: &mut Ticker<'_>| {
        ticker.step(all.rules_of(all.head(rule)).len() / 64)?;
        Ok(!known.is_dominated(&all, rule))
    };
    let (problem, number) = all.restricted(needed, ticker)?;
    let fact_landmarks =
        known.of_node(all.target()).filter_map(|node| number[node]).filter(|&node| node != problem.target());
    let fact_landmarks = fact_landmarks.collect();
    Ok(Some(Preprocessed { problem, fact_landmarks }))
}

/// The chaining with every node allowed.
fn everything<'p>(problem: &'p HornRules, ticker: &mut Ticker<'_>) -> Result<ForwardChaining<'p>, Interrupted> {
    let mut chain = ForwardChaining::new(problem);
    for node in 0..problem.target() {
        ticker.step(1 + chain.steps())?;
        chain.allow(node);
    }
    Ok(chain)
}

/// The objects on which the target depends through `usable` options. Breadth-first backwards from the target, numbered
/// in reverse, so that objects near the target have high numbers.
fn reached(
    base: &KnowledgeBase,
    target: ObjectIndex,
    usable: impl Fn(&[ObjectIndex]) -> bool,
    ticker: &mut Ticker<'_>,
) -> Result<HornRules, Interrupted> {
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
        ticker.step(1 + read / MEMBERS_A_STEP)?;
    }
    objects.reverse();
    HornRules::over(base, objects, usable, ticker)
}
