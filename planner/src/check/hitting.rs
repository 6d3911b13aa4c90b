//! The size of a least hitting set of all landmarks, by branch and bound.

use crate::budget::{Interrupted, Ticker};

use super::branch::branch;
use super::family::{Family, Set};
use super::multipliers::{LagrangianBound, improve, initialise};

/// The size of a least hitting set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Hits {
    /// A lower bound.
    pub(super) at_least: usize,
    /// True if the lower bound is the size.
    pub(super) exact: bool,
}

/// Subgradient rounds for a component that inherits no multipliers.
const FIRST_ROUNDS: usize = 100;
/// The most members of all open questions of a search, some 40 MB. Past that the search takes longer and finds the
/// same.
pub(super) const MOST_KEPT: usize = 4_000_000;

/// The least number of elements, below `width`, that hit every one of the non-empty `sets` (each in increasing order).
/// Where the budget ends first, components already searched count in full and the others by a packing or the Lagrangian
/// bound. A search keeps no more than about `most_kept` members.
pub(super) fn least_hits(sets: Vec<Vec<usize>>, width: usize, most_kept: usize, ticker: &mut Ticker<'_>) -> Hits {
    let mut family = Family { sets: sets.into_iter().map(Set::new).collect(), width };
    initialise(&mut family);
    let bound = family.packing().max(reached(improve(&mut family, usize::MAX, 0, ticker)).at_least());
    let Ok(reduced) = family.reduce(ticker) else { return Hits { at_least: bound, exact: false } };
    let mut hits = Hits { at_least: reduced.forced, exact: true };
    let mut components = reduced.rest.components();
    // Small components first: where time runs out, as many as possible count in full.
    components.sort_by_key(Family::size);
    for mut component in components {
        initialise(&mut component);
        let mut floor = component.packing();
        match search(component, &mut floor, most_kept, ticker) {
            Ok(least) => hits.at_least += least,
            Err(Interrupted) => {
                hits.at_least += floor;
                hits.exact = false;
            }
        }
    }
    // Both are bounds. The sum over components is usually larger, but not where all were cut short.
    Hits { at_least: hits.at_least.max(bound), ..hits }
}

/// The size of a least hitting set of one component. `floor` is a lower bound, and rises while the search runs.
fn search(
    mut component: Family,
    floor: &mut usize,
    most_kept: usize,
    ticker: &mut Ticker<'_>,
) -> Result<usize, Interrupted> {
    let known = greedy(component.clone(), ticker)?;
    *floor = (*floor).max(reached(improve(&mut component, known, FIRST_ROUNDS, ticker)).at_least());
    if *floor >= known {
        return Ok(known);
    }
    branch(&component, known, most_kept, ticker)
}

/// The bound, even if the budget ended: any multipliers give one.
fn reached(lagrangian: Result<LagrangianBound, LagrangianBound>) -> LagrangianBound {
    lagrangian.unwrap_or_else(|cut| cut)
}

/// Greedy upper bound: reduce, take the most frequent element, repeat.
fn greedy(mut family: Family, ticker: &mut Ticker<'_>) -> Result<usize, Interrupted> {
    let mut count = 0;
    loop {
        let reduced = family.reduce(ticker)?;
        count += reduced.forced;
        ticker.step(reduced.rest.units())?;
        let Some(best) = reduced.rest.most_frequent() else { return Ok(count) };
        let Some(left) = reduced.rest.after(&[best], &[]) else { return Ok(count) };
        count += 1;
        family = left;
    }
}

#[cfg(test)]
mod tests {
    use core::time::Duration;

    use proptest::prelude::*;

    use super::*;
    use crate::budget::{Budget, Unlimited};

    /// The same with full memory and with almost none.
    fn solve(sets: &[Vec<usize>], width: usize) -> Hits {
        let solve = |most_kept| least_hits(sets.to_vec(), width, most_kept, &mut Ticker::new(&Budget::unlimited()));
        let hits = solve(MOST_KEPT);
        assert_eq!(solve(5), hits, "forgotten families are computed again");
        hits
    }

    fn enumerate(sets: &[Vec<usize>], width: usize) -> usize {
        (0_u32..1 << width)
            .filter(|chosen| sets.iter().all(|set| set.iter().any(|member| chosen >> member & 1 == 1)))
            .map(|chosen| chosen.count_ones() as usize)
            .min()
            .unwrap()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(400))]
        #[test]
        fn the_search_finds_what_enumeration_finds(
            sets in proptest::collection::vec(proptest::collection::btree_set(0_usize..12, 1..5), 0..16),
        ) {
            let sets: Vec<Vec<usize>> = sets.into_iter().map(|set| set.into_iter().collect()).collect();
            let exact = enumerate(&sets, 12);
            prop_assert_eq!(solve(&sets, 12), Hits { at_least: exact, exact: true });
            let mut family = Family { sets: sets.into_iter().map(Set::new).collect(), width: 12 };
            initialise(&mut family);
            prop_assert!(family.packing() <= exact && reached(improve(&mut family, exact + 1, 40, &mut Ticker::new(&Budget::unlimited()))).at_least() <= exact);
        }

        /// Two tangles and a few links: a choice among the links leaves components that are searched separately.
        #[test]
        fn linked_parts_are_searched_right(
            left in proptest::collection::vec((0_usize..7, 1_usize..7), 4..14),
            right in proptest::collection::vec((0_usize..7, 1_usize..7), 4..14),
            links in proptest::collection::vec((0_usize..7, 7_usize..14), 1..4),
        ) {
            let edge = |from: usize, (a, turn): (usize, usize)| {
                let b = (a + turn) % 7;
                vec![from + a.min(b), from + a.max(b)]
            };
            let mut sets: Vec<Vec<usize>> = left.into_iter().map(|pair| edge(0, pair)).collect();
            sets.extend(right.into_iter().map(|pair| edge(7, pair)));
            sets.extend(links.into_iter().map(|(a, b)| vec![a, b]));
            prop_assert_eq!(solve(&sets, 14), Hits { at_least: enumerate(&sets, 14), exact: true });
        }
    }

    /// Copies of Petersen's graph with 15 edges each: nothing here is decided by reduction alone.
    fn petersen(copies: usize) -> (Vec<Vec<usize>>, usize) {
        let edges = (0..5).flat_map(|n| [(n, (n + 1) % 5), (n, n + 5), (n + 5, (n + 2) % 5 + 5)]);
        let edges: Vec<(usize, usize)> = edges.collect();
        let sets = (0..copies)
            .flat_map(|copy| edges.iter().map(move |&(a, b)| vec![10 * copy + a.min(b), 10 * copy + a.max(b)]));
        (sets.collect(), 10 * copies)
    }

    #[test]
    fn multipliers_see_what_disjoint_sets_do_not() {
        // All pairs of five: no two disjoint pairs more than 2, but each element hits only 4 of 10.
        let pairs = (0..5).flat_map(|a| (a + 1..5).map(move |b| Set::new(vec![a, b])));
        let mut family = Family { sets: pairs.collect(), width: 5 };
        initialise(&mut family);
        assert_eq!(
            (family.packing(), reached(improve(&mut family, 4, 0, &mut Ticker::new(&Budget::unlimited()))).at_least()),
            (2, 3)
        );
    }

    #[test]
    fn independent_parts_are_solved_apart() {
        // A least vertex cover of Petersen's graph has 6 vertices.
        let (sets, width) = petersen(9);
        assert_eq!(sets.len(), 135);
        assert_eq!(solve(&sets, width), Hits { at_least: 54, exact: true });
    }

    #[test]
    fn a_component_of_more_than_twenty_thousand_members_is_searched_too() {
        // All triples of 36 sets, each an element that hits these three: 12 elements hit all. Besides Petersen's graph,
        // of which multipliers see 5 of 6 vertices; one more set keeps the two together.
        let (mut sets, ten) = petersen(1);
        let mut width = ten;
        let mut tripled = vec![Vec::new(); 36];
        for (a, b, c) in (0..36).flat_map(|a| (0..a).flat_map(move |b| (0..b).map(move |c| (a, b, c)))) {
            [a, b, c].iter().for_each(|set| tripled[*set].push(width));
            width += 1;
        }
        sets.extend(tripled);
        sets.push(vec![0, ten]);
        assert!(sets.iter().map(Vec::len).sum::<usize>() > 20_000);
        let hits = least_hits(sets, width, MOST_KEPT, &mut Ticker::new(&Budget::unlimited()));
        assert_eq!(hits, Hits { at_least: 18, exact: true });
    }

    #[test]
    fn an_ended_budget_leaves_what_disjoint_sets_prove() {
        let (sets, width) = petersen(40);
        let ended = Budget::new(&Unlimited, Duration::ZERO);
        let hits = least_hits(sets, width, MOST_KEPT, &mut Ticker::new(&ended));
        assert_eq!(hits, Hits { at_least: 200, exact: false });
    }

    #[test]
    fn a_hundred_tangled_sets_are_solved() {
        // A pseudo-random family: 100 sets of 2 to 4 out of 120 elements.
        let mut state = 7_u64;
        let mut next = |below: u64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            usize::try_from((state >> 33) % below).unwrap()
        };
        let sets: Vec<Vec<usize>> = (0..100)
            .map(|_| {
                let mut set: Vec<usize> = (0..2 + next(3)).map(|_| next(120)).collect();
                set.sort_unstable();
                set.dedup();
                set
            })
            .collect();
        assert!(solve(&sets, 120).exact);
    }
}
