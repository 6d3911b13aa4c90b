//! Premises in disjunctive normal form, and their conjunction.

use std::collections::BTreeSet;

use crate::budget::{Budget, Interrupted};
use crate::scene::ObjectIndex;

/// A conjunctive clause: objects that must all be relocated, in index order.
pub(super) type Clause = Vec<ObjectIndex>;

/// conjugateDNFs of Algorithm 1: the conjunction of several DNFs as one, by the distributive law. Logically equivalent
/// clauses, here equal sets, appear once; a clause that holds another one stays. The product is exponential in the
/// number of DNFs: `None` where it would hold more than `max_members` objects.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub(super) fn conjugate_dnfs(
    dnfs: &[Vec<Clause>],
    max_members: usize,
    budget: &Budget<'_>,
) -> Result<Option<BTreeSet<Clause>>, Interrupted> {
    let mut product = BTreeSet::from([Clause::new()]);
    for dnf in dnfs {
        let (mut next, mut members) = (BTreeSet::new(), 0);
        for clause in &product {
            budget.check()?;
            for other in dnf {
                let joined = union(clause, other);
                let length = joined.len();
                if next.insert(joined) {
                    members += length;
                }
            }
            if members > max_members {
                return Ok(None);
            }
        }
        product = next;
    }
    Ok(Some(product))
}

/// The union of two clauses.
fn union(a: &[ObjectIndex], b: &[ObjectIndex]) -> Clause {
    let mut union: Clause = a.iter().chain(b).copied().collect();
    union.sort_unstable();
    union.dedup();
    union
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clause(members: &[usize]) -> Clause {
        members.iter().copied().map(ObjectIndex::new).collect()
    }

    #[test]
    fn the_product_holds_each_union_once() {
        let dnfs = [vec![clause(&[1]), clause(&[2])], vec![clause(&[1]), clause(&[2, 3])]];
        let product = conjugate_dnfs(&dnfs, 100, &Budget::unlimited());
        let clauses = [clause(&[1]), clause(&[1, 2]), clause(&[1, 2, 3]), clause(&[2, 3])];
        assert_eq!(product, Ok(Some(BTreeSet::from(clauses))));
        assert_eq!(conjugate_dnfs(&dnfs, 5, &Budget::unlimited()), Ok(None));
    }
}
