//! Core-guided MaxSAT from its first step against enumeration, and on a base that needs it.

use core::time::Duration;

use proptest::prelude::*;

use super::{Facts, MaxSat};
use crate::budget::clocks::Looks;
use crate::budget::{Budget, Ticker};
use crate::cost::Cost;
use crate::knowledge::derivable;
use crate::scene::ObjectIndex;
use crate::search::forward_chaining::ForwardChaining;
use crate::search::preprocessing::preprocess;
use crate::search::problem::Node;
use crate::search::tests::base;
use crate::search::tests::exhaustive;
use crate::search::tests::follows;
use crate::search::tests::options;
use crate::search::{LeastSet, Restriction, SearchOutcome, least};

/// The bound and the size of the best set by MaxSAT alone, with so many conflicts a turn, until both meet or the budget
/// ends. `None` if the target can't be derived or time ran out before the first turn.
fn by_clauses(
    options: &[Vec<Vec<usize>>],
    required: &[usize],
    conflicts: u64,
    budget: &Budget<'_>,
) -> Option<(usize, usize)> {
    let mut ticker = Ticker::new(budget);
    let preprocessed = preprocess(&base(options), ObjectIndex::new(0), &Restriction::default(), &mut ticker).ok()??;
    let problem = &preprocessed.problem;
    let (mut forced, mut underived_required) = (preprocessed.fact_landmarks, Vec::new());
    for &object in required {
        let node = problem.node(ObjectIndex::new(object))?;
        if !forced.contains(&node) {
            forced.push(node);
            underived_required.push(node);
        }
    }
    let facts = Facts { problem, forced: &forced, underived_required: &underived_required, landmarks: &[] };
    let mut max_sat = MaxSat::new(&facts, usize::MAX, &mut ticker).ok()?;
    let mut best = problem.movable();
    while max_sat.bound() < best {
        let (smallest, mut adopted) = (best, best);
        let mut adopt = |set: &[Node]| {
            let mut chain = ForwardChaining::new(problem);
            set.iter().for_each(|&node| chain.allow(node));
            assert!(chain.reaches_target() && forced.iter().all(|node| set.contains(node)), "{set:?}");
            adopted = adopted.min(set.len());
            adopted
        };
        let raised = max_sat.raise(conflicts, smallest, &mut adopt);
        best = adopted;
        if raised.is_err() {
            break;
        }
    }
    Some((max_sat.bound(), best))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    #[test]
    fn clauses_alone_find_what_exhaustion_finds(options in (2_usize..11).prop_flat_map(options), conflicts in 1_u64..30) {
        if let Some((bound, best)) = by_clauses(&options, &[], conflicts, &Budget::unlimited()) {
            prop_assert_eq!(Some((bound, best)), exhaustive(&options, 0).map(|least| (least as usize, least as usize)));
        }
    }

    #[test]
    fn required_objects_need_not_be_graspable(
        options in (4_usize..11).prop_flat_map(options), one in 1_usize..4, other in 1_usize..4,
    ) {
        if let Some(found) = by_clauses(&options, &[one, other], 1000, &Budget::unlimited()) {
            let holds = |set: &u32| set >> one & 1 == 1 && set >> other & 1 == 1 && follows(&options, 0, *set);
            let expected = (0_u32..1 << options.len()).filter(holds).map(u32::count_ones).min().unwrap() as usize;
            prop_assert_eq!(found, (expected, expected));
        }
    }

    #[test]
    fn clauses_cut_off_claim_only_what_holds(options in (6_usize..11).prop_flat_map(options), looks in 0_usize..60) {
        let clock = Looks::ending_after(looks);
        let found = by_clauses(&options, &[], 1000, &Budget::new(&clock, Duration::MAX));
        if let (Some((bound, best)), Some(expected)) = (found, exhaustive(&options, 0)) {
            prop_assert!(bound <= expected as usize && expected as usize <= best);
        }
    }
}

#[test]
fn no_object_is_moved_to_make_a_required_one_graspable() {
    // t←{a} or {b}, b←{c,d}, a, c and d free; b is required, and a is all that the target needs besides.
    let options = [vec![vec![1], vec![2]], vec![vec![]], vec![vec![3, 4]], vec![vec![]], vec![vec![]]];
    assert_eq!(by_clauses(&options, &[2], 1000, &Budget::unlimited()), Some((2, 2)));
}

/// Six layers of 16 objects: each needs two of the layer below in one of three ways, now and then one further up
/// instead. The lowest layer is free.
fn stack() -> Vec<Vec<Vec<usize>>> {
    const LAYERS: usize = 6;
    const WIDTH: usize = 16;
    let mut state = 3_u64;
    let mut below = |count: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from((state >> 33) % count as u64).unwrap()
    };
    let mut all = vec![vec![(1..=5).collect()]];
    for layer in 0..LAYERS {
        for column in 0..WIDTH {
            let mut member = || loop {
                let other = if below(100) < 15 { below(layer + 1) } else { layer + 1 };
                let member = 1 + other * WIDTH + below(WIDTH);
                if member != 1 + layer * WIDTH + column {
                    return member;
                }
            };
            let lowest = layer + 1 == LAYERS;
            all.push(if lowest { vec![vec![]] } else { (0..3).map(|_| vec![member(), member()]).collect() });
        }
    }
    all
}

/// The optimum by clingo.
const STACK_OPTIMUM: Cost = Cost::new(30);

#[test]
fn a_stack_is_settled_by_clauses() {
    let options = stack();
    let solve = || least(&base(&options), ObjectIndex::new(0), &Restriction::default(), &Budget::unlimited());
    let SearchOutcome::Least(found) = solve() else { unreachable!("the budget never ends") };
    assert_eq!((found.bound, found.derivation.cost()), (STACK_OPTIMUM, STACK_OPTIMUM));
    assert!(found.proven < found.bound, "its landmarks prove as much as the clauses");
    assert!(is_derived(&options, &found));
    assert_eq!(solve(), SearchOutcome::Least(found), "a second answer to the same question");
}

fn is_derived(options: &[Vec<Vec<usize>>], found: &LeastSet) -> bool {
    let moved = |object: ObjectIndex| found.derivation.order.contains(&object);
    let derivable = derivable(&base(options), |object| !moved(object), &Budget::unlimited()).unwrap();
    derivable.derives(ObjectIndex::new(0))
}

#[test]
fn a_stack_cut_off_anywhere_claims_only_what_holds() {
    let options = stack();
    let (mut looks, mut among_clauses) = (0, 0);
    loop {
        let clock = Looks::ending_after(looks);
        let budget = clock.budget();
        match least(&base(&options), ObjectIndex::new(0), &Restriction::default(), &budget) {
            SearchOutcome::Interrupted(Some(found)) => {
                among_clauses += usize::from(found.bound > found.proven);
                assert!(found.bound <= STACK_OPTIMUM && STACK_OPTIMUM <= found.derivation.cost());
                assert!(is_derived(&options, &found));
            }
            SearchOutcome::Interrupted(None) => {}
            SearchOutcome::Least(found) => break assert_eq!(found.bound, STACK_OPTIMUM),
            SearchOutcome::Underivable => unreachable!("every layer can be moved"),
        }
        looks += 1 + looks / 4;
    }
    assert!(among_clauses > 1, "clauses were cut off only {among_clauses} times");
}
