//! Sets of yaws modulo the gripper's period.

use smallvec::SmallVec;

/// An interval of yaws, rad: `lo` < `hi` within [0, period]. One that runs over 0 is kept as two arcs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arc {
    /// Lower end.
    pub lo: f64,
    /// Upper end.
    pub hi: f64,
}

/// A set of blocked yaws modulo a period in its one canonical form: arcs sorted, disjoint, none touching the next, all
/// within [0, period]. Equal sets are equal values. Arcs are open: their ends are free.
#[derive(Debug, Clone, PartialEq)]
pub struct ArcSet {
    period: f64,
    arcs: SmallVec<[Arc; 4]>,
}

/// A maximal interval of free yaws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeInterval {
    /// Its start, in [0, period).
    pub start: f64,
    /// Its width, rad; the period where nothing is blocked.
    pub width: f64,
}

impl ArcSet {
    /// Nothing is blocked.
    pub fn empty(period: f64) -> Self {
        Self { period, arcs: SmallVec::new() }
    }

    /// Everything is blocked.
    pub fn full(period: f64) -> Self {
        Self { period, arcs: SmallVec::from_slice(&[Arc { lo: 0.0, hi: period }]) }
    }

    /// The arcs from `lo` to `hi` (any reals, `lo` ≤ `hi`), folded into the period. An arc at least one period long
    /// blocks everything.
    pub fn fold(period: f64, arcs: &[(f64, f64)]) -> Self {
        if arcs.iter().any(|(lo, hi)| hi - lo >= period) {
            return Self::full(period);
        }
        let mut set = Self::empty(period);
        for &(lo, hi) in arcs.iter().filter(|(lo, hi)| lo < hi) {
            let start = wrap(lo, period);
            let end = start + (hi - lo);
            if end > period {
                set.arcs.push(Arc { lo: start, hi: period });
                set.arcs.push(Arc { lo: 0.0, hi: end - period });
            } else {
                set.arcs.push(Arc { lo: start, hi: end });
            }
        }
        set.canonicalise();
        set
    }

    /// The union of many sets of one period.
    pub fn union<'a>(period: f64, sets: impl IntoIterator<Item = &'a Self>) -> Self {
        let mut union = Self::empty(period);
        for set in sets {
            union.arcs.extend_from_slice(&set.arcs);
        }
        union.canonicalise();
        union
    }

    /// 2π/k, rad.
    pub fn period(&self) -> f64 {
        self.period
    }

    /// The blocked arcs, sorted.
    pub fn arcs(&self) -> &[Arc] {
        &self.arcs
    }

    /// True if nothing is blocked.
    pub fn is_empty(&self) -> bool {
        self.arcs.is_empty()
    }

    /// True if everything is blocked.
    pub fn is_full(&self) -> bool {
        matches!(self.arcs.as_slice(), [Arc { lo, hi }] if *lo <= 0.0 && *hi >= self.period)
    }

    /// The maximal free intervals. One that runs over 0 comes last, in one piece.
    pub fn free(&self) -> impl Iterator<Item = FreeInterval> + '_ {
        let period = self.period;
        let whole = self.is_empty().then_some(FreeInterval { start: 0.0, width: period });
        let between =
            self.arcs.windows(2).map(|pair| FreeInterval { start: pair[0].hi, width: pair[1].lo - pair[0].hi });
        let round = self.arcs.first().zip(self.arcs.last()).and_then(|(first, last)| {
            let width = first.lo + (period - last.hi);
            (width > 0.0).then_some(FreeInterval { start: if last.hi < period { last.hi } else { 0.0 }, width })
        });
        whole.into_iter().chain(between).chain(round)
    }

    /// The widest free interval, the first of equals.
    pub fn widest_free(&self) -> Option<FreeInterval> {
        self.free().reduce(|best, next| if next.width > best.width { next } else { best })
    }

    fn canonicalise(&mut self) {
        self.arcs.sort_unstable_by(|a, b| a.lo.total_cmp(&b.lo));
        let mut kept = 0;
        for at in 0..self.arcs.len() {
            let arc = self.arcs[at];
            if kept > 0 && arc.lo <= self.arcs[kept - 1].hi {
                self.arcs[kept - 1].hi = self.arcs[kept - 1].hi.max(arc.hi);
            } else {
                self.arcs[kept] = arc;
                kept += 1;
            }
        }
        self.arcs.truncate(kept);
    }
}

/// The angle modulo the period, in [0, period).
pub(super) fn wrap(angle: f64, period: f64) -> f64 {
    let rest = angle % period;
    let rest = if rest < 0.0 { rest + period } else { rest };
    // A tiny negative rest plus the period rounds to the period itself.
    if rest >= period { 0.0 } else { rest }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const PERIOD: f64 = 2.0;

    fn arcs(set: &ArcSet) -> Vec<(f64, f64)> {
        set.arcs().iter().map(|arc| (arc.lo, arc.hi)).collect()
    }

    #[test]
    fn equal_sets_are_equal_values() {
        let split = ArcSet::fold(PERIOD, &[(0.0, 0.5), (0.5, 1.0)]);
        assert_eq!(split, ArcSet::fold(PERIOD, &[(2.0, 3.0)]));
        assert_eq!(arcs(&split), [(0.0, 1.0)]);
    }

    #[test]
    fn an_arc_over_zero_is_kept_as_two_and_its_complement_in_one_piece() {
        let set = ArcSet::fold(PERIOD, &[(-0.5, 0.25)]);
        assert_eq!(arcs(&set), [(0.0, 0.25), (1.5, 2.0)]);
        assert_eq!(set.free().collect::<Vec<_>>(), [FreeInterval { start: 0.25, width: 1.25 }]);
        let set = ArcSet::fold(PERIOD, &[(0.5, 1.0)]);
        assert_eq!(set.free().collect::<Vec<_>>(), [FreeInterval { start: 1.0, width: 1.5 }]);
    }

    #[test]
    fn arcs_that_cover_the_period_together_are_full() {
        assert!(ArcSet::fold(PERIOD, &[(0.0, 1.25), (1.0, 2.5)]).is_full());
        assert!(ArcSet::fold(PERIOD, &[(0.25, 2.25)]).is_full());
        assert_eq!(ArcSet::full(PERIOD).widest_free(), None);
        assert_eq!(ArcSet::empty(PERIOD).widest_free(), Some(FreeInterval { start: 0.0, width: PERIOD }));
    }

    proptest! {
        #[test]
        fn a_yaw_is_blocked_exactly_when_some_arc_covers_it(
            list in proptest::collection::vec((-9.0..9.0_f64, 0.0..2.5_f64), 0..6),
            yaw in 0.0..PERIOD,
        ) {
            let list: Vec<_> = list.into_iter().map(|(lo, length)| (lo, lo + length)).collect();
            let set = ArcSet::fold(PERIOD, &list);
            let near = |a: f64, b: f64| (a - b).abs() < 1e-12;
            prop_assume!(!list.iter().any(|&(lo, hi)| near(wrap(lo, PERIOD), yaw) || near(wrap(hi, PERIOD), yaw)));
            let covers = |&(lo, hi): &(f64, f64)| (-10..10).any(|n| {
                let turned = yaw + PERIOD * f64::from(n);
                lo < turned && turned < hi
            });
            let blocked = list.iter().any(covers);
            prop_assert_eq!(set.arcs().iter().any(|arc| arc.lo < yaw && yaw < arc.hi), blocked);
            let free = set.free().any(|gap| wrap(yaw - gap.start, PERIOD) <= gap.width);
            prop_assert_eq!(free, !blocked);
            prop_assert!(set.arcs().windows(2).all(|pair| pair[0].hi < pair[1].lo));
        }
    }
}
