//! Least hitting sets against enumeration.

use core::time::Duration;

use proptest::prelude::*;

use super::instance::{Decided, Instance};
use super::reduce::reduce;
use super::{Allowance, bound, greedy, least};
use crate::budget::clocks::Looks;
use crate::budget::{Budget, Stop, Ticker, Unlimited};
use crate::search::problem::Node;

fn enumerated(sets: &[Vec<Node>], nodes: u32) -> usize {
    (0_u32..1 << nodes)
        .filter(|chosen| sets.iter().all(|set| set.iter().any(|node| chosen >> node & 1 == 1)))
        .map(|chosen| chosen.count_ones() as usize)
        .min()
        .unwrap()
}

/// No limits.
const ALL: Allowance = Allowance { choices: usize::MAX, words: usize::MAX };

/// The least set is found under every limit above its size, and under none other; the same with no memory to speak of.
fn check(sets: &[Vec<Node>], nodes: u32) -> Result<(), TestCaseError> {
    let exact = enumerated(sets, nodes);
    let hits = |members: &[Node]| sets.iter().all(|set| set.iter().any(|node| members.contains(node)));
    let budget = Budget::unlimited();
    for limit in 0..exact + 4 {
        let mut allowances = [ALL, Allowance { words: 5, ..ALL }];
        let [found, again] =
            allowances.each_mut().map(|allowed| least(sets, limit, allowed, &mut Ticker::new(&budget)).unwrap());
        prop_assert_eq!(&found, &again);
        prop_assert_eq!(allowances[0].choices, allowances[1].choices);
        prop_assert_eq!(found.as_ref().map(Vec::len), (exact < limit).then_some(exact));
        prop_assert!(found.is_none_or(|found| hits(&found)));
        prop_assert!(bound(sets, limit, &mut Ticker::new(&budget)).unwrap() <= exact);
    }
    let small = greedy(sets, &mut Ticker::new(&budget)).unwrap();
    prop_assert!(hits(&small) && small.len() >= exact);
    Ok(())
}

/// Pseudo-random sets, each of 2 to 4 of `nodes` nodes.
fn tangle(sets: usize, nodes: Node) -> Vec<Vec<Node>> {
    let mut state = 7_u64;
    let mut below = |count: u64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        Node::try_from((state >> 33) % count).unwrap()
    };
    (0..sets).map(|_| (0..2 + below(3)).map(|_| below(nodes.into())).collect()).collect()
}

#[test]
fn a_deep_search_finds_the_same_with_little_memory() {
    let (sets, budget) = (tangle(300, 150), Budget::unlimited());
    let answer = |words: usize| {
        let mut allowance = Allowance { words, ..ALL };
        let found = least(&sets, 120, &mut allowance, &mut Ticker::new(&budget)).unwrap();
        (found.expect("every limit is above it"), usize::MAX - allowance.choices)
    };
    let (found, choices) = answer(usize::MAX);
    assert!(choices > 50, "{choices}");
    for words in [0, 5, 1000, 5000] {
        assert_eq!(answer(words), (found.clone(), choices), "{words} words");
    }
}

#[test]
fn a_spent_allowance_is_told_apart_from_ended_time() {
    let (sets, budget) = (tangle(150, 120), Budget::unlimited());
    let cut = least(&sets, 120, &mut Allowance { choices: 5, ..ALL }, &mut Ticker::new(&budget)).unwrap_err();
    assert_eq!(cut.stop, Stop::Spent);
    let ended = Budget::new(&Unlimited, Duration::ZERO);
    let cut = least(&sets, 120, &mut ALL.clone(), &mut Ticker::new(&ended)).unwrap_err();
    assert_eq!(cut.stop, Stop::Interrupted);
}

#[test]
fn a_reduction_costs_as_much_as_the_rows_that_are_read() {
    // A thousand sets, each of about half of so many nodes: nothing can be decided.
    let reduced = |nodes: Node| {
        let mut state = 7_u64;
        let mut set = |_| -> Vec<Node> {
            let half = (0..nodes).filter(|_| {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                state >> 63 == 1
            });
            half.collect()
        };
        let sets: Vec<Vec<Node>> = (0..1000).map(&mut set).collect();
        Looks::of(|budget| {
            let ticker = &mut Ticker::new(budget);
            let mut instance = Instance::read(&sets, ticker).unwrap();
            let before = instance.members().words();
            assert_eq!(reduce(&mut instance, &mut Decided::default(), ticker), Ok(true));
            assert_eq!((before, instance.parts()[0].members().words()), (before, before), "nothing is decided");
        })
    };
    let (narrow, wide) = (reduced(100), reduced(1000));
    assert!(wide > 10 * narrow, "{narrow} {wide}");
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
