//! The least number of objects that hit every landmark: branch and bound.

use crate::budget::Interrupted;

use super::family::{Family, Set};
use super::meter::Meter;
use super::shares::{divide, improve};

/// How many elements hit every set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Hits {
    /// No fewer elements do.
    pub(super) at_least: usize,
    /// That many do.
    pub(super) exact: bool,
}

/// Choices that may be open at once. Each is a frame on the stack; a search so deep would not end in any time.
const MAX_DEPTH: usize = 400;
/// Members in all sets of one component that are searched. A search over more would not end either, and each open choice
/// holds a copy.
const MAX_MEMBERS: usize = 20_000;
/// Rounds in which shares are improved: first, and after each choice, where they come from before it.
const FIRST_ROUNDS: usize = 100;
const ROUNDS: usize = 12;

/// The least number of elements, below `width`, that hit every one of the non-empty `sets` (each in increasing order).
/// Where the budget ends first, components already searched count in full and the others by their disjoint sets or
/// shares.
pub(super) fn least_hits(sets: Vec<Vec<usize>>, width: usize, meter: &mut Meter<'_>) -> Hits {
    let mut family = Family { sets: sets.into_iter().map(Set::new).collect(), width };
    divide(&mut family);
    let bound = family.packing().max(improve(&mut family, usize::MAX, 0, meter).at_least());
    let Ok(reduced) = family.reduce(meter) else { return Hits { at_least: bound, exact: false } };
    let mut hits = Hits { at_least: reduced.forced, exact: true };
    for mut component in reduced.rest.components() {
        divide(&mut component);
        let mut floor = component.packing();
        match search(component, &mut floor, meter) {
            Ok(least) => hits.at_least += least,
            Err(Interrupted) => {
                hits.at_least += floor;
                hits.exact = false;
            }
        }
    }
    // Either is a bound; the parts add up to more as a rule, but not where all were cut short.
    Hits { at_least: hits.at_least.max(bound), ..hits }
}

/// The least number of elements for one component; `floor` rises to what is proven if that can't be found.
fn search(mut component: Family, floor: &mut usize, meter: &mut Meter<'_>) -> Result<usize, Interrupted> {
    let size = component.sets.iter().map(|set| set.members().len()).sum::<usize>();
    let known = greedy(component.clone(), meter)?;
    *floor = (*floor).max(improve(&mut component, known, FIRST_ROUNDS, meter).at_least());
    if *floor >= known {
        return Ok(known);
    }
    if size > MAX_MEMBERS {
        return Err(Interrupted);
    }
    branch(component, known, MAX_DEPTH, meter)
}

/// Some number of elements that suffices: what can be decided is, then the one that hits most is taken, and again.
fn greedy(mut family: Family, meter: &mut Meter<'_>) -> Result<usize, Interrupted> {
    let mut count = 0;
    loop {
        let reduced = family.reduce(meter)?;
        count += reduced.forced;
        let Some(best) = most_frequent(&reduced.rest) else { return Ok(count) };
        let Some(left) = reduced.rest.after(&[best], &[]) else { return Ok(count) };
        count += 1;
        family = left;
    }
}

/// The element that hits most, pairs first of all; `None` if there is nothing to hit.
fn most_frequent(family: &Family) -> Option<usize> {
    let mut weight = vec![0_usize; family.width];
    for set in &family.sets {
        let each = 8 >> (set.members().len().clamp(2, 5) - 2);
        set.members().iter().for_each(|member| weight[*member] += each);
    }
    let best = (0..family.width).rev().max_by_key(|element| weight[*element])?;
    (weight[best] > 0).then_some(best)
}

/// The least number of elements that hit the family, or `limit` if it is no less.
fn least(family: Family, limit: usize, depth: usize, meter: &mut Meter<'_>) -> Result<usize, Interrupted> {
    let reduced = family.reduce(meter)?;
    let mut total = reduced.forced;
    meter.spend(reduced.rest.units())?;
    let components = reduced.rest.components();
    let bounds: Vec<usize> = components.iter().map(Family::packing).collect();
    let mut rest: usize = bounds.iter().sum();
    for (component, bound) in components.into_iter().zip(bounds) {
        if total + rest >= limit {
            return Ok(limit);
        }
        rest -= bound;
        total += branch(component, limit - total - rest, depth, meter)?;
    }
    Ok(total.min(limit))
}

/// Like [`least`], for a reduced component. What the shares decide is decided; else some element is taken, or refused.
fn branch(mut component: Family, limit: usize, depth: usize, meter: &mut Meter<'_>) -> Result<usize, Interrupted> {
    meter.spend(component.units())?;
    let Some(depth) = depth.checked_sub(1) else { return Err(Interrupted) };
    let worth = improve(&mut component, limit, ROUNDS, meter);
    if worth.at_least() >= limit {
        return Ok(limit);
    }
    let (refused, others): (Vec<usize>, Vec<usize>) =
        (0..component.width).partition(|element| worth.with(*element) >= limit);
    let taken: Vec<usize> = others.into_iter().filter(|element| worth.without(*element) >= limit).collect();
    if !refused.is_empty() || !taken.is_empty() {
        let (left, count) = (component.after(&taken, &refused), taken.len());
        let (Some(left), true) = (left, count < limit) else { return Ok(limit) };
        return Ok(count + least(left, limit - count, depth, meter)?);
    }
    let Some(element) = most_frequent(&component) else { return Ok(0) };
    let mut best = limit;
    if let Some(left) = component.after(&[element], &[]) {
        best = best.min(1 + least(left, best - 1, depth, meter)?);
    }
    if let Some(left) = component.after(&[], &[element]).filter(|_| worth.at_least() < best) {
        best = best.min(least(left, best, depth, meter)?);
    }
    Ok(best)
}

#[cfg(test)]
mod tests {
    use core::time::Duration;

    use proptest::prelude::*;

    use super::*;
    use crate::budget::{Budget, Unlimited};

    fn solve(sets: &[Vec<usize>], width: usize) -> Hits {
        least_hits(sets.to_vec(), width, &mut Meter::new(&Budget::unlimited()))
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
            divide(&mut family);
            prop_assert!(family.packing() <= exact && improve(&mut family, exact + 1, 40, &mut Meter::new(&Budget::unlimited())).at_least() <= exact);
        }

        /// Two tangles and a few links: a choice among the links leaves parts that are searched apart.
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

    /// The 15 edges of Petersen's graph, so many times over: nothing here is decided by reduction alone.
    fn petersen(copies: usize) -> (Vec<Vec<usize>>, usize) {
        let edges = (0..5).flat_map(|n| [(n, (n + 1) % 5), (n, n + 5), (n + 5, (n + 2) % 5 + 5)]);
        let edges: Vec<(usize, usize)> = edges.collect();
        let sets = (0..copies)
            .flat_map(|copy| edges.iter().map(move |&(a, b)| vec![10 * copy + a.min(b), 10 * copy + a.max(b)]));
        (sets.collect(), 10 * copies)
    }

    #[test]
    fn shares_see_what_disjoint_sets_do_not() {
        // All pairs of five: no two disjoint pairs more than 2, but each element hits only 4 of 10.
        let pairs = (0..5).flat_map(|a| (a + 1..5).map(move |b| Set::new(vec![a, b])));
        let mut family = Family { sets: pairs.collect(), width: 5 };
        divide(&mut family);
        assert_eq!(
            (family.packing(), improve(&mut family, 4, 0, &mut Meter::new(&Budget::unlimited())).at_least()),
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
    fn an_ended_budget_leaves_what_disjoint_sets_prove() {
        let (sets, width) = petersen(40);
        let ended = Budget::new(&Unlimited, Duration::ZERO);
        let hits = least_hits(sets, width, &mut Meter::new(&ended));
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
