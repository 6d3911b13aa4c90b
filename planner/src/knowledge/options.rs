//! Options: the subset-minimal sets of obstacles that must go before an object can be grasped.
//!
//! As the yaw turns once through its period, the set of blockers changes only at the ends of shadows. A band of yaws of
//! width t is free exactly when its middle is outside every shadow widened by t/2 on each side, so the sweep runs over
//! widened shadows, and no option leaves only a sliver of free yaw. Only points where shadows have just ended
//! and the next one starts can be minimal, so at most one candidate per shadow is kept.

use crate::geometry::{ArcSet, Shadow};
use crate::scene::{Grasps, ListedGrasp, Object, ObjectIndex};

/// An obstacle with its shadow on the object in question.
#[derive(Debug, Clone, PartialEq)]
pub struct Blocker {
    /// The obstacle.
    pub object: ObjectIndex,
    /// The grasps that it blocks; not empty.
    pub shadow: Shadow,
}

#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Turn {
    /// Ends sort before starts at the same yaw, since an arc's end is free.
    End,
    Start,
}

struct SweepEvent {
    yaw: f64,
    turn: Turn,
    blocker: usize,
}

/// The options of an object, given its blockers: sets of obstacles whose removal leaves a listed grasp free, or a free interval of
/// yaws at least `min_free_width` (rad) wide, such that no smaller set does. `[[]]` if it is graspable now.
///
/// The result may still hold supersets; [`super::KnowledgeBase::push`] drops them.
pub fn minimal_options(object: &Object, blockers: &[Blocker], min_free_width: f64) -> Vec<Vec<ObjectIndex>> {
    match object.grasps() {
        Grasps::Listed(list) => {
            let ways = list.iter().zip(0_u32..).filter(|(grasp, _)| ListedGrasp::fits(grasp));
            ways.map(|(_, way)| blocking(blockers, way)).collect()
        }
        Grasps::EveryYaw => {
            let yaws: Vec<(ObjectIndex, &ArcSet)> =
                blockers.iter().filter_map(|blocker| Some((blocker.object, blocker.shadow.yaws()?))).collect();
            options_of_yaws(&yaws, min_free_width)
        }
    }
}

/// The obstacles that block a listed grasp.
pub(super) fn blocking(blockers: &[Blocker], way: u32) -> Vec<ObjectIndex> {
    let blocks = |blocker: &&Blocker| blocker.shadow.grasps() >> way & 1 == 1;
    blockers.iter().filter(blocks).map(|blocker| blocker.object).collect()
}

/// The options where every yaw would do, given the yaws that each obstacle blocks.
fn options_of_yaws(blockers: &[(ObjectIndex, &ArcSet)], min_free_width: f64) -> Vec<Vec<ObjectIndex>> {
    let mut events = Vec::with_capacity(4 * blockers.len());
    // Per blocker the number of its widened arcs that cover the current yaw. One that blocks every yaw is an arc
    // without end.
    let mut depth = vec![0_u32; blockers.len()];
    for (at, (_, shadow)) in blockers.iter().enumerate() {
        match widened(shadow, min_free_width) {
            None => depth[at] = 1,
            Some(arcs) => {
                for (start, end) in arcs {
                    events.push(SweepEvent { yaw: start, turn: Turn::Start, blocker: at });
                    events.push(SweepEvent { yaw: end, turn: Turn::End, blocker: at });
                    depth[at] += u32::from(end <= start);
                }
            }
        }
    }
    events.sort_unstable_by(|a, b| {
        let order = a.yaw.total_cmp(&b.yaw);
        order.then((a.turn == Turn::Start).cmp(&(b.turn == Turn::Start))).then(a.blocker.cmp(&b.blocker))
    });
    sweep(blockers, &events, depth)
}

fn sweep(blockers: &[(ObjectIndex, &ArcSet)], events: &[SweepEvent], mut depth: Vec<u32>) -> Vec<Vec<ObjectIndex>> {
    let current = |depth: &[u32]| -> Vec<ObjectIndex> {
        blockers.iter().zip(depth).filter(|(_, depth)| **depth > 0).map(|(blocker, _)| blocker.0).collect()
    };
    let Some(last) = events.last() else { return vec![current(&depth)] };
    let mut options = Vec::new();
    let mut before = last.turn;
    for event in events {
        match event.turn {
            Turn::End => depth[event.blocker] -= 1,
            Turn::Start => {
                if before == Turn::End {
                    options.push(current(&depth));
                }
                depth[event.blocker] += 1;
            }
        }
        before = event.turn;
    }
    options
}

/// The shadow's arcs widened by half of `width` on each side, as (start, end) in [0, period). An arc across 0 has `end` ≤
/// `start`. `None` if no free gap is wide enough.
fn widened(shadow: &ArcSet, width: f64) -> Option<Vec<(f64, f64)>> {
    let period = shadow.period();
    let gaps: Vec<_> = shadow.free().filter(|gap| gap.width >= width).collect();
    if gaps.is_empty() {
        return None;
    }
    // Between two neighbouring gaps that are wide enough lies one widened arc; it may cover narrower gaps.
    let wrap = |yaw: f64| if yaw >= period { yaw - period } else { yaw };
    let next = gaps.iter().cycle().skip(1);
    let arcs = gaps.iter().zip(next).map(|(gap, next)| {
        // Computed from the end before it: where a gap is only just wide enough, rounding must not swap end and start.
        let start = wrap(wrap(gap.start + width / 2.0) + (gap.width - width));
        let end = wrap(next.start + width / 2.0);
        (start, end)
    });
    Some(arcs.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const PERIOD: f64 = 2.0;

    fn blockers(shadows: &[Vec<(f64, f64)>]) -> Vec<(ObjectIndex, ArcSet)> {
        let shadow = |(at, arcs): (usize, &Vec<(f64, f64)>)| (ObjectIndex::new(at), ArcSet::fold(PERIOD, arcs));
        shadows.iter().enumerate().map(shadow).filter(|(_, shadow)| !shadow.is_empty()).collect()
    }

    fn options(shadows: &[Vec<(f64, f64)>], width: f64) -> Vec<Vec<usize>> {
        let blockers = blockers(shadows);
        let blockers: Vec<_> = blockers.iter().map(|(object, shadow)| (*object, shadow)).collect();
        let base: super::super::KnowledgeBase = [options_of_yaws(&blockers, width)].into_iter().collect();
        base.options(ObjectIndex::new(0)).map(|option| option.iter().map(|o| o.get()).collect()).collect()
    }

    #[test]
    fn options_are_the_minimal_sets_round_the_turn() {
        assert_eq!(options(&[], 1e-9), [Vec::<usize>::new()]);
        assert_eq!(options(&[vec![(0.0, 1.0)]], 1e-9), [Vec::<usize>::new()]);
        assert_eq!(options(&[vec![(0.0, 1.0)], vec![(0.9, 2.1)]], 1e-9), [vec![0], vec![1]]);
        assert_eq!(options(&[vec![(0.0, 2.0)]], 1e-9), [vec![0]]);
        let full_and_two_halves = [vec![(0.0, 2.0)], vec![(0.0, 1.0)], vec![(1.0, 2.0)]];
        assert_eq!(options(&full_and_two_halves, 1e-9), [vec![0, 1], vec![0, 2]]);
    }

    #[test]
    fn a_free_sliver_counts_only_when_it_is_wide_enough() {
        let shadows = [vec![(0.0, 1.0)], vec![(1.25, 2.0)]];
        assert_eq!(options(&shadows, 0.25), [Vec::<usize>::new()]);
        assert_eq!(options(&shadows, 0.251), [vec![0], vec![1]]);
    }

    #[test]
    fn a_gap_that_is_just_wide_enough_is_the_only_one() {
        for n in 0..1000_u32 {
            // One shadow leaves a single gap, and the other covers it.
            let (start, length) = (1e-3 * f64::from(n), 1.3);
            let gap = (start + length, start + PERIOD);
            let shadows = [vec![(start, gap.0)], vec![(gap.0 - 0.05, gap.1 + 0.05)]];
            let width = blockers(&shadows)[0].1.widest_free().map(|gap| gap.width).unwrap();
            assert_eq!(options(&shadows, width), [vec![0], vec![1]], "{gap:?}");
        }
    }

    proptest! {
        #[test]
        fn a_set_frees_a_yaw_exactly_when_it_holds_an_option(
            shadows in proptest::collection::vec(
                proptest::collection::vec((0.0..PERIOD, 0.0..1.9_f64), 1..3), 0..7),
            width in prop_oneof![Just(1e-9), 0.0..0.4_f64],
            removed in 0_u32..128,
        ) {
            let shadows: Vec<Vec<_>> =
                shadows.into_iter().map(|arcs| arcs.into_iter().map(|(lo, length)| (lo, lo + length)).collect()).collect();
            let width = width.max(1e-9);
            let all = blockers(&shadows);
            let gone = |object: ObjectIndex| removed >> object.get() & 1 == 1;
            let left = ArcSet::union(PERIOD, all.iter().filter(|b| !gone(b.0)).map(|b| &b.1));
            let widest = left.widest_free().map_or(0.0, |gap| gap.width);
            prop_assume!((widest - width).abs() > 1e-12);
            let holds_option =
                options(&shadows, width).iter().any(|option| option.iter().all(|member| removed >> member & 1 == 1));
            prop_assert_eq!(widest > width, holds_option);
        }
    }
}
