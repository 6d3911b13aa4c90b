//! The obstacles that block each object at the start, and the yaws that those still standing leave free.

use std::rc::Rc;

use crate::budget::{Interrupted, Ticker};
use crate::scene::{ObjectIndex, Scene};

use super::finger::Finger;
use super::near::Tree;
use super::yaws::blocked_by;

/// How a case is decided that rounding leaves open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Leaning {
    /// As blocked: for claims that an object can't be grasped (locks, landmarks).
    Blocked,
    /// As free: for claims that an object can be grasped (needed objects).
    Free,
}

/// Added to the least width of a free interval, or subtracted, by leaning, rad. Two ways to compute an interval's end
/// differ by less.
const WIDTH_LEANING: f64 = 1e-10;
/// Added to an obstacle's radius, or subtracted, by leaning, as a share of the lengths involved. Where a circle is only
/// just touched, the last digit decides between no shadow and one of 1e-8 rad; this is far above the last digit and far
/// below `WIDTH_LEANING`.
const LENGTH_LEANING: f64 = 1e-12;

impl Leaning {
    fn sign(self) -> f64 {
        match self {
            Self::Blocked => 1.0,
            Self::Free => -1.0,
        }
    }
}

/// An interval of yaws that one obstacle blocks.
struct Shade {
    lo: f64,
    hi: f64,
    by: ObjectIndex,
}

/// The blocked yaws of one object at the start.
pub(super) struct Ring {
    /// Sorted by `lo`.
    shades: Vec<Shade>,
}

impl Ring {
    /// The number of intervals.
    pub(super) fn len(&self) -> usize {
        self.shades.len()
    }

    /// The obstacles that block some yaw, once for each interval.
    pub(super) fn blockers(&self) -> impl Iterator<Item = ObjectIndex> + '_ {
        self.shades.iter().map(|shade| shade.by)
    }
}

/// The rings of a scene, each computed on first use. They don't depend on the target.
pub(super) struct Rings<'s> {
    scene: &'s Scene,
    start: Rc<Tree>,
    leaning: Leaning,
    made: Vec<Option<Rc<Ring>>>,
    /// Per object the objects whose computed rings hold it.
    watchers: Vec<Vec<ObjectIndex>>,
}

impl<'s> Rings<'s> {
    pub(super) fn new(scene: &'s Scene, start: &Rc<Tree>, leaning: Leaning) -> Self {
        let count = scene.objects().len();
        Self { scene, start: Rc::clone(start), leaning, made: vec![None; count], watchers: vec![Vec::new(); count] }
    }

    /// The number of objects in the scene.
    pub(super) fn count(&self) -> usize {
        self.made.len()
    }

    /// The ring of an object.
    pub(super) fn ring(&mut self, object: ObjectIndex, ticker: &mut Ticker<'_>) -> Result<Rc<Ring>, Interrupted> {
        if let Some(ring) = &self.made[object.get()] {
            return Ok(Rc::clone(ring));
        }
        let ring = Rc::new(self.make(object, ticker)?);
        for by in ring.blockers() {
            let watchers = &mut self.watchers[by.get()];
            if watchers.last() != Some(&object) {
                watchers.push(object);
            }
        }
        self.made[object.get()] = Some(Rc::clone(&ring));
        Ok(ring)
    }

    /// The objects whose rings, as far as they are computed, hold this one.
    pub(super) fn watchers(&self, object: ObjectIndex) -> &[ObjectIndex] {
        &self.watchers[object.get()]
    }

    fn make(&self, object: ObjectIndex, ticker: &mut Ticker<'_>) -> Result<Ring, Interrupted> {
        let (gripper, grasped) = (self.scene.gripper(), self.scene.object(object).footprint());
        let finger = Finger::new(gripper, grasped);
        let reach = (finger.corner_distance() + gripper.margin()) * (1.0 + 4.0 * LENGTH_LEANING);
        let mut near = Vec::new();
        self.start.within(grasped.pose().at, reach, |at| near.push(ObjectIndex::new(at)));
        ticker.step(1)?;
        let mut shades = Vec::new();
        for by in near.into_iter().filter(|by| *by != object) {
            ticker.step(1)?;
            let obstacle = self.scene.object(by).footprint();
            let leaning = self.leaning.sign() * LENGTH_LEANING;
            let yaws = blocked_by(obstacle, &finger, grasped, gripper, leaning);
            shades.extend(yaws.into_iter().map(|[lo, hi]| Shade { lo, hi, by }));
        }
        shades.sort_unstable_by(|a, b| a.lo.total_cmp(&b.lo).then(a.by.cmp(&b.by)));
        Ok(Ring { shades })
    }

    /// The middle of the widest free interval of yaws (rad, in one period from 0), counting only obstacles for which
    /// `stands` is true. `None` if no interval is wide enough. Where nothing blocks, every yaw is free, whatever the
    /// tolerance.
    pub(super) fn free_yaw(&self, ring: &Ring, stands: impl Fn(ObjectIndex) -> bool) -> Option<f64> {
        let gripper = self.scene.gripper();
        let mut shades = ring.shades.iter().filter(|shade| stands(shade.by));
        let Some(first) = shades.next() else { return Some(0.0) };
        let (mut covered, mut widest, mut ends) = (first.hi, 0.0_f64, 0.0);
        let mut interval = |covered: f64, lo: f64| {
            if lo - covered > widest {
                (widest, ends) = (lo - covered, lo);
            }
        };
        for shade in shades {
            interval(covered, shade.lo);
            covered = covered.max(shade.hi);
        }
        // The interval round the period's end.
        interval(covered, first.lo + gripper.period());
        let counts = widest > gripper.min_free_width() + self.leaning.sign() * WIDTH_LEANING;
        counts.then(|| (ends - widest / 2.0).rem_euclid(gripper.period()))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::budget::Budget;
    use crate::scene::scenes::TestScene;

    /// True if some sampled yaw has `band` rad on each side free of every other disc, judged by distance.
    fn some_band_is_free(scene: &Scene, band: f64) -> bool {
        let (gripper, target) = (scene.gripper(), scene.object(scene.target().unwrap()).footprint());
        let finger = Finger::new(gripper, target);
        (0..500).any(|sample| {
            let yaw = gripper.period() * f64::from(sample) / 500.0;
            scene
                .indices()
                .filter(|object| Some(*object) != scene.target())
                .all(|object| finger.depth(gripper, target, scene.object(object).footprint(), (yaw, band)) <= 0.0)
        })
    }

    #[test]
    fn an_obstacle_that_only_just_touches_blocks_or_not_as_the_question_leans() {
        let finger = Finger { inner: 0.05, outer: 0.1, half: 0.01 };
        for (off, leaning, blocks) in [
            (1e-15, Leaning::Blocked, true),
            (-1e-15, Leaning::Free, false),
            (1e-10, Leaning::Blocked, false),
            (-1e-10, Leaning::Free, true),
        ] {
            let x = 0.5 + (finger.corner_distance() + 0.08) * (1.0 + off);
            let scene = TestScene::new(3).disc("t", 0.5, 0.5, 0.05).disc("o", x, 0.5, 0.08).build("t");
            let mut rings = Rings::new(&scene, &Tree::of_start(&scene), leaning);
            let ring = rings.ring(scene.target().unwrap(), &mut Ticker::new(&Budget::unlimited())).unwrap();
            assert_eq!(ring.len() > 0, blocks, "{off:e} {leaning:?}");
        }
    }

    proptest! {
        #[test]
        fn a_free_interval_is_found_where_a_band_of_its_width_is_free(
            fingers in 2_u32..=6, tolerance in 0.01..0.3_f64,
            others in proptest::collection::vec((0.3..0.7_f64, 0.3..0.7_f64, 0.005..0.09_f64), 1..16),
        ) {
            let mut discs = vec![(0.5, 0.5, 0.05)];
            discs.extend(others);
            let scene = TestScene::new(fingers).yaw_tolerance(tolerance).scatter(&discs).build("d0");
            let start = Tree::of_start(&scene);
            for leaning in [Leaning::Blocked, Leaning::Free] {
                let mut rings = Rings::new(&scene, &start, leaning);
                let ring = rings.ring(scene.target().unwrap(), &mut Ticker::new(&Budget::unlimited())).unwrap();
                // The middle of a free interval is at most half a sample off.
                let half_sample = scene.gripper().period() / 1000.0 + 1e-9;
                if rings.free_yaw(&ring, |_| true).is_some() {
                    prop_assert!(some_band_is_free(&scene, tolerance - half_sample));
                } else {
                    prop_assert!(!some_band_is_free(&scene, tolerance + 1e-9));
                }
            }
        }
    }
}
