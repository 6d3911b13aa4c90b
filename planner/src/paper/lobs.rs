//! Algorithm 1, local obstacles-based backward search (LOBS), read literally. The numbers are those of its lines.
//!
//! Known defects, kept:
//! * A false deadlock: `findDup` takes an object that is needed at two depths for a cycle unless it is graspable. Base
//!   {t ← {a, b}, a ← {b}, b ← {c}, c free}: c, b, a frees t, but the search finds nothing.
//! * Not optimal, for the same reason: where the least sequence needs an object at two depths, a longer one is returned.
//! * Exponential: the conjunction of the premises of one node multiplies their options.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::conclusion::Conclusion;
use super::dnf::{Clause, conjugate_dnfs};
use crate::budget::{Budget, Interrupted};
use crate::knowledge::KnowledgeBase;
use crate::scene::ObjectIndex;
use crate::search::Derivation;

/// A node of the search tree. OPEN returns the cheapest first, among equals the oldest.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct SearchNode {
    /// g, the length of the sequence. (The algorithm counts the target too, which changes no order.)
    g: usize,
    /// The number of the node, in order of creation.
    number: usize,
    /// O_c, the objects to be relocated for this node.
    o_c: Clause,
    /// O_s^R, the relocation sequence reversed; it starts with the target.
    o_s_r: Vec<ObjectIndex>,
}

/// Algorithm 1 for `target`. OPEN and the products of premises hold at most `max_members` objects each.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub fn lobs(
    base: &KnowledgeBase,
    target: ObjectIndex,
    max_members: usize,
    budget: &Budget<'_>,
) -> Result<Conclusion, Interrupted> {
    // 1-4
    let root = SearchNode { g: 0, number: 0, o_c: vec![target], o_s_r: vec![target] };
    let mut open = BinaryHeap::from([Reverse(root)]);
    // The root holds the target twice.
    let (mut number, mut members) = (0, 2);
    // 5-7
    while let Some(Reverse(node)) = open.pop() {
        budget.check()?;
        members -= node.o_c.len() + node.o_s_r.len();
        // 8-12
        let d: Vec<Vec<Clause>> = node.o_c.iter().filter(|o| !is_true(base, **o)).map(|o| premise(base, *o)).collect();
        // 13-14
        if d.is_empty() {
            let order = node.o_s_r.iter().rev().copied().filter(|object| *object != target).collect();
            return Ok(Conclusion::Sequence(Derivation { order }));
        }
        // 15
        let Some(dnf) = conjugate_dnfs(&d, max_members, budget)? else { return Ok(Conclusion::TooLarge) };
        // 16-22
        for clause in dnf {
            if number % 64 == 0 {
                budget.check()?;
            }
            let o_s_r = find_dup(base, &node.o_s_r, &clause);
            if !o_s_r.is_empty() {
                number += 1;
                members += clause.len() + o_s_r.len();
                open.push(Reverse(SearchNode { g: o_s_r.len(), number, o_c: clause, o_s_r }));
            }
            if members > max_members {
                return Ok(Conclusion::TooLarge);
            }
        }
    }
    // 23
    Ok(Conclusion::Deadlock)
}

/// p_j of Eq. 5 for an object that is not graspable at once: a clause for each option.
fn premise(base: &KnowledgeBase, object: ObjectIndex) -> Vec<Clause> {
    base.options(object).map(<[_]>::to_vec).collect()
}

/// True if the object is graspable at once: ∅ ∈ S_j.
fn is_true(base: &KnowledgeBase, object: ObjectIndex) -> bool {
    base.options(object).any(<[_]>::is_empty)
}

/// The child's sequence: the parent's with the clause added. An object that is there already moves to the end if it is
/// graspable; if not, there is no sequence, and the result is empty.
fn find_dup(base: &KnowledgeBase, o_s_r: &[ObjectIndex], clause: &[ObjectIndex]) -> Vec<ObjectIndex> {
    let duplicate = |object: &ObjectIndex| clause.binary_search(object).is_ok();
    if o_s_r.iter().any(|object| duplicate(object) && !is_true(base, *object)) {
        return Vec::new();
    }
    o_s_r.iter().filter(|object| !duplicate(object)).chain(clause).copied().collect()
}
