//! Least hitting sets against enumeration.

use proptest::prelude::*;

use super::{bound, greedy, least};
use crate::budget::Budget;
use crate::search::pace::Pace;
use crate::search::problem::Node;

fn enumerated(sets: &[Vec<Node>], nodes: u32) -> usize {
    (0_u32..1 << nodes)
        .filter(|chosen| sets.iter().all(|set| set.iter().any(|node| chosen >> node & 1 == 1)))
        .map(|chosen| chosen.count_ones() as usize)
        .min()
        .unwrap()
}

/// The least set is found under every limit above its size, and under none other.
fn check(sets: &[Vec<Node>], nodes: u32) -> Result<(), TestCaseError> {
    let exact = enumerated(sets, nodes);
    let meets = |members: &[Node]| sets.iter().all(|set| set.iter().any(|node| members.contains(node)));
    let budget = Budget::unlimited();
    for limit in 0..exact + 4 {
        let found = least(sets, limit, &mut usize::MAX.clone(), &mut Pace::new(&budget)).unwrap();
        prop_assert_eq!(found.as_ref().map(Vec::len), (exact < limit).then_some(exact));
        prop_assert!(found.is_none_or(|found| meets(&found)));
        prop_assert!(bound(sets, limit, &mut Pace::new(&budget)).unwrap() <= exact);
    }
    let small = greedy(sets, &mut Pace::new(&budget)).unwrap();
    prop_assert!(meets(&small) && small.len() >= exact);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn the_least_hitting_set_is_what_enumeration_finds(
        sets in proptest::collection::vec(proptest::collection::btree_set(0_u32..12, 1..6), 0..20),
    ) {
        let sets: Vec<Vec<Node>> = sets.into_iter().map(|set| set.into_iter().collect()).collect();
        check(&sets, 12)?;
    }

    /// Pairs, with a few larger sets: here elements fold, and fold again.
    #[test]
    fn folded_elements_unfold(
        pairs in proptest::collection::vec((0_u32..13, 1_u32..13), 8..22),
        larger in proptest::collection::vec(proptest::collection::btree_set(0_u32..13, 3..5), 0..4),
    ) {
        let mut sets: Vec<Vec<Node>> = pairs.into_iter().map(|(a, turn)| vec![a, (a + turn) % 13]).collect();
        sets.extend(larger.into_iter().map(|set| set.into_iter().collect::<Vec<_>>()));
        check(&sets, 13)?;
    }
}
