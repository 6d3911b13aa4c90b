//! The search against enumeration.

use super::preprocessing::preprocess;
use super::{Alternatives, Incumbent, LeastSet, Memory, Restriction, SearchOutcome, least, least_within};
use crate::budget::clocks::Looks;
use crate::budget::{Budget, Ticker};
use crate::cost::Cost;
use crate::knowledge::{KnowledgeBase, derivable};
use crate::scene::ObjectIndex;
use proptest::prelude::*;

pub(super) fn base(options: &[Vec<Vec<usize>>]) -> KnowledgeBase {
    let set = |members: &Vec<usize>| members.iter().copied().map(ObjectIndex::new).collect();
    options.iter().map(|list| list.iter().map(set).collect()).collect()
}

/// True if the target follows when only `movable` may be moved. Chains in rounds, straight from the definition.
pub(super) fn follows(options: &[Vec<Vec<usize>>], target: usize, movable: u32) -> bool {
    let mut moved = 0_u32;
    loop {
        let graspable = |object: usize| options[object].iter().any(|o| o.iter().all(|&m| moved >> m & 1 == 1));
        if graspable(target) {
            return true;
        }
        let next = (0..options.len())
            .filter(|&object| object != target && movable >> object & 1 == 1 && graspable(object))
            .fold(0, |set, object| set | 1 << object);
        if next == moved {
            return false;
        }
        moved = next;
    }
}

pub(super) fn exhaustive(options: &[Vec<Vec<usize>>], target: usize) -> Option<u32> {
    (0_u32..1 << options.len()).filter(|&set| follows(options, target, set)).map(u32::count_ones).min()
}

fn check(options: &[Vec<Vec<usize>>], target: usize) -> Option<LeastSet> {
    let outcome = least(&base(options), ObjectIndex::new(target), &Restriction::default(), &Budget::unlimited());
    let expected = exhaustive(options, target);
    let found = match outcome {
        SearchOutcome::Least(found) => found,
        SearchOutcome::Underivable => {
            assert_eq!(expected, None);
            return None;
        }
        SearchOutcome::Interrupted(_) => unreachable!("the budget never ends"),
    };
    let order: Vec<usize> = found.derivation.order.iter().map(|object| object.get()).collect();
    assert_eq!(Some(u32::try_from(order.len()).unwrap()), expected, "{order:?}");
    let cost = found.derivation.cost();
    assert_eq!((cost, found.bound, found.proven), (Cost::of_each(order.len()), cost, cost));
    for (at, &object) in order.iter().enumerate() {
        assert!(options[object].iter().any(|option| option.iter().all(|m| order[..at].contains(m))), "{order:?}");
    }
    assert!(options[target].iter().any(|option| option.iter().all(|m| order.contains(m))));
    let all = (1_u32 << options.len()) - 1;
    let masks: Vec<u32> =
        found.landmarks.iter().map(|l| l.iter().fold(0, |set, object| set | 1 << object.get())).collect();
    assert!(masks.iter().all(|landmark| !follows(options, target, all & !landmark)), "{:?}", found.landmarks);
    let hitting = (0..=all).filter(|set| masks.iter().all(|mask| mask & set != 0)).map(u32::count_ones).min();
    assert_eq!(hitting, expected, "the landmarks prove the bound: {:?}", found.landmarks);
    Some(found)
}

#[test]
fn an_object_needed_at_two_depths_is_no_cycle() {
    // t←{a,b}, a←{b}, b←{c}, c free.
    let found = check(&[vec![vec![1, 2]], vec![vec![2]], vec![vec![3]], vec![vec![]]], 0).expect("derivable");
    assert_eq!(found.derivation.order, [3, 2, 1].map(ObjectIndex::new));
}

#[test]
fn an_option_that_needs_the_target_gone_is_useless() {
    assert_eq!(check(&[vec![vec![1]], vec![vec![0]]], 0), None);
    let found = check(&[vec![vec![1]], vec![vec![0], vec![2]], vec![vec![]]], 0).expect("derivable");
    assert_eq!(found.bound, Cost::new(2));
}

#[test]
fn a_graspable_target_needs_nothing() {
    assert_eq!(check(&[vec![vec![]], vec![vec![0]]], 0), Some(LeastSet::default()));
}

#[test]
fn sets_come_in_order_under_restrictions() {
    let base = base(&[vec![vec![1], vec![2, 3]], vec![vec![]], vec![vec![]], vec![vec![]]]);
    let solve = |held: &[usize], required: &[usize]| {
        let set = |list: &[usize]| list.iter().copied().map(ObjectIndex::new).collect();
        let restriction = Restriction { held: set(held), required: set(required) };
        match least(&base, ObjectIndex::new(0), &restriction, &Budget::unlimited()) {
            SearchOutcome::Least(found) => {
                let mut set: Vec<usize> = found.derivation.order.iter().map(|object| object.get()).collect();
                set.sort_unstable();
                Some(set)
            }
            _ => None,
        }
    };
    assert_eq!(solve(&[], &[]), Some(vec![1]));
    assert_eq!(solve(&[1], &[]), Some(vec![2, 3]));
    assert_eq!(solve(&[1, 2], &[]), None);
    assert_eq!(solve(&[1], &[3]), Some(vec![2, 3]));
}

/// The number of objects left besides the target, and the fact landmarks.
fn preprocessed(options: &[Vec<Vec<usize>>]) -> (usize, Vec<usize>) {
    let budget = Budget::unlimited();
    let (base, target) = (base(options), ObjectIndex::new(0));
    let preprocessed =
        preprocess(&base, target, &Restriction::default(), &mut Ticker::new(&budget)).unwrap().expect("derivable");
    let mut fact_landmarks: Vec<usize> =
        preprocessed.fact_landmarks.iter().map(|&node| preprocessed.problem.object(node).get()).collect();
    fact_landmarks.sort_unstable();
    (preprocessed.problem.movable(), fact_landmarks)
}

#[test]
fn an_object_of_every_derivation_is_a_fact_landmark() {
    // t←{a} or {b}, a←{c}, b←{c}, c free.
    assert_eq!(preprocessed(&[vec![vec![1], vec![2]], vec![vec![3]], vec![vec![3]], vec![vec![]]]), (3, vec![3]));
}

#[test]
fn an_option_that_implies_another_is_left_out() {
    // t←{a} or {b,c}, b←{a}, a and c free: moving b takes moving a.
    assert_eq!(preprocessed(&[vec![vec![1], vec![2, 3]], vec![vec![]], vec![vec![1]], vec![vec![]]]), (1, vec![1]));
    // t←{a} or {b}, a←{b} or {c}, b←{a} or {c}, c free: a can follow from b and b from a, but neither must, so both
    // stay.
    let both = [vec![vec![1], vec![2]], vec![vec![2], vec![3]], vec![vec![1], vec![3]], vec![vec![]]];
    assert_eq!(preprocessed(&both), (3, vec![3]));
}

pub(super) fn options(objects: usize) -> impl Strategy<Value = Vec<Vec<Vec<usize>>>> {
    let option = proptest::collection::vec(0..objects, 1..4);
    let list = prop_oneof![
        1 => Just(vec![vec![]]),
        1 => Just(vec![]),
        6 => proptest::collection::vec(option, 1..5),
    ];
    proptest::collection::vec(list, objects)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn the_least_set_is_what_exhaustion_finds(options in (2_usize..11).prop_flat_map(options)) {
        check(&options, 0);
    }

    #[test]
    fn an_interrupted_search_claims_only_what_holds(options in (6_usize..11).prop_flat_map(options), looks in 0_usize..40) {
        let clock = Looks::ending_after(looks);
        let budget = clock.budget();
        let outcome = least(&base(&options), ObjectIndex::new(0), &Restriction::default(), &budget);
        let expected = exhaustive(&options, 0);
        match outcome {
            SearchOutcome::Underivable => prop_assert_eq!(expected, None),
            SearchOutcome::Interrupted(None) => {}
            SearchOutcome::Least(found) | SearchOutcome::Interrupted(Some(found)) => {
                let expected = Cost::new(expected.expect("derivable").into());
                prop_assert!(found.bound <= expected && expected <= found.derivation.cost());
                let mask = |set: &[ObjectIndex]| set.iter().fold(0_u32, |mask, object| mask | 1 << object.get());
                prop_assert!(follows(&options, 0, mask(&found.derivation.order)));
                prop_assert!(found.landmarks.iter().all(|landmark| !follows(&options, 0, !mask(landmark))));
            }
        }
    }

    #[test]
    fn each_incumbent_is_told_and_none_is_worse_than_the_one_before(options in (6_usize..11).prop_flat_map(options)) {
        let told = core::cell::RefCell::new(Vec::new());
        let progress = |Incumbent { cost, lower_bound }| told.borrow_mut().push((cost, lower_bound));
        let (base, unlimited) = (base(&options), Budget::unlimited());
        let outcome =
            least_within(&Memory::default(), &base, ObjectIndex::new(0), &Restriction::default(), &unlimited, &progress);
        let told = told.into_inner();
        prop_assert!(told.is_sorted_by(|(cost, bound), (next, next_bound)| next <= cost && bound <= next_bound));
        if let SearchOutcome::Least(found) = outcome {
            let least = found.derivation.cost();
            prop_assert!(told.iter().all(|(cost, bound)| *bound <= least && least <= *cost), "{told:?}");
        }
    }

    #[test]
    fn sets_whose_time_ends_go_on_where_they_were(options in (6_usize..11).prop_flat_map(options), looks in 0_usize..60) {
        let (base, target, unlimited) = (base(&options), ObjectIndex::new(0), Budget::unlimited());
        if let SearchOutcome::Least(first) = least(&base, target, &Restriction::default(), &unlimited) {
            let mut whole = Alternatives::new(&base, target, first.derivation.clone());
            let expected: Vec<_> = core::iter::from_fn(|| whole.next(&unlimited).unwrap()).take(30).collect();
            let clock = Looks::ending_after(looks);
            let hurried = Budget::new(&clock, core::time::Duration::MAX);
            let mut cut = Alternatives::new(&base, target, first.derivation);
            let next = || cut.next(&hurried).unwrap_or_else(|_| cut.next(&unlimited).unwrap());
            prop_assert_eq!(core::iter::from_fn(next).take(30).collect::<Vec<_>>(), expected);
        }
    }

    #[test]
    fn chaining_agrees_with_its_definition(options in (2_usize..11).prop_flat_map(options)) {
        let derivable = derivable(&base(&options), |object| object.get() == 0, &Budget::unlimited()).expect("unlimited");
        prop_assert_eq!(derivable.derives(ObjectIndex::new(0)), follows(&options, 0, u32::MAX));
    }
}
