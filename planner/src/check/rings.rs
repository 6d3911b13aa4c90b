//! The obstacles that block each object at the start, and the yaws that those still standing leave free.

use std::rc::Rc;

use nalgebra::Point2;

use crate::budget::{Interrupted, Ticker};
use crate::scene::{Grasps, ListedGrasp, ObjectIndex, Scene};

use super::body::Body;
use super::finger::Finger;
use super::grip::{Hold, work};
use super::hand::Hand;
use super::leaning::Leaning;
use super::near::Tree;
use super::ring::{Listed, Ring, Shade};
use super::yaws::{LENGTH_LEANING, all, blocked_by};

/// Added to the least width of a free interval, or subtracted, by leaning, rad. Two ways to compute an interval's end
/// differ by less.
const WIDTH_LEANING: f64 = 1e-10;
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
        ticker.step(1)?;
        let (stated, body) = (self.scene.object(object), self.start.body(object.get()));
        let hand = Hand::at(stated, self.scene.gripper(), self.leaning);
        match stated.grasps() {
            Grasps::EveryYaw => self.every_yaw(object, body, &hand, ticker).map(Ring::EveryYaw),
            Grasps::Listed(list) => self.listed(object, (body, list), &hand, ticker).map(Ring::Listed),
        }
    }

    /// The other objects that come nearer than `reach` to a point (edge to point, m), in order.
    fn near(&self, object: ObjectIndex, at: Point2<f64>, reach: f64) -> Vec<ObjectIndex> {
        let mut near = Vec::new();
        self.start.within(at, reach, |at| near.push(ObjectIndex::new(at)));
        near.retain(|by| *by != object);
        near
    }

    fn every_yaw(
        &self,
        object: ObjectIndex,
        body: &Body,
        hand: &Hand,
        ticker: &mut Ticker<'_>,
    ) -> Result<Vec<Shade>, Interrupted> {
        let (gripper, at) = (self.scene.gripper(), body.pose.at);
        let finger = Finger::new(gripper, body);
        let reach = (finger.corner_distance() + gripper.margin()).max(hand.span()) * (1.0 + 4.0 * LENGTH_LEANING);
        let mut shades = Vec::new();
        for by in self.near(object, at, reach) {
            ticker.step(1)?;
            let (obstacle, other) = (self.scene.object(by), self.start.body(by.get()));
            let yaws = if self.under_palm(hand, by, at) {
                all(gripper)
            } else if hand.fingers_reach(obstacle) {
                blocked_by(other, &finger, body, gripper, self.leaning)
            } else {
                continue;
            };
            shades.extend(yaws.into_iter().map(|[lo, hi]| Shade { lo, hi, by }));
        }
        shades.sort_unstable_by(|a, b| a.lo.total_cmp(&b.lo).then(a.by.cmp(&b.by)));
        Ok(shades)
    }

    fn listed(
        &self,
        object: ObjectIndex,
        (body, list): (&Body, &[ListedGrasp]),
        hand: &Hand,
        ticker: &mut Ticker<'_>,
    ) -> Result<Vec<Listed>, Interrupted> {
        let (gripper, shape) = (self.scene.gripper(), self.scene.object(object).footprint().shape());
        let mut grasps = Vec::with_capacity(list.len());
        for grasp in list {
            ticker.step(work(grasp, shape, gripper))?;
            let hold = Hold::new(shape, grasp, gripper, self.leaning);
            if hold.too_wide {
                continue;
            }
            let grip = hold.of(body, gripper);
            let reach = (grip.span() + gripper.margin()).max(hand.span());
            let mut by = self.near(object, grip.axis, reach);
            ticker.step(by.len())?;
            by.retain(|by| {
                let (obstacle, other) = (self.scene.object(*by), self.start.body(by.get()));
                let rho = self.leaning.to_keep(other.radius + gripper.margin());
                self.under_palm(hand, *by, grip.axis) || (hand.fingers_reach(obstacle) && grip.comes_near(other, rho))
            });
            grasps.push(Listed { yaw: grip.yaw, by });
        }
        Ok(grasps)
    }

    /// True if the palm meets an obstacle, in favour of the claim.
    fn under_palm(&self, hand: &Hand, by: ObjectIndex, axis: Point2<f64>) -> bool {
        let depth = hand.under_palm(self.scene.object(by), self.start.body(by.get()), axis);
        depth.is_some_and(|depth| self.leaning.to_keep(depth) > 0.0)
    }

    /// The yaw of some free grasp of the object whose ring this is (rad, in one period from 0 where every yaw will do), counting only
    /// obstacles for which `stands` is true.
    pub(super) fn free_yaw(&self, ring: &Ring, stands: impl Fn(ObjectIndex) -> bool) -> Option<f64> {
        match ring {
            Ring::EveryYaw(shades) => self.widest(shades, stands),
            Ring::Listed(grasps) => {
                grasps.iter().find(|grasp| !grasp.by.iter().any(|by| stands(*by))).map(|grasp| grasp.yaw)
            }
        }
    }

    /// The middle of the widest free interval of yaws. `None` if no interval is wide enough. Where nothing blocks, every yaw is
    /// free, whatever the tolerance.
    fn widest(&self, shades: &[Shade], stands: impl Fn(ObjectIndex) -> bool) -> Option<f64> {
        let gripper = self.scene.gripper();
        let mut shades = shades.iter().filter(|shade| stands(shade.by));
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
    use crate::check::grip::Grip;
    use crate::scene::scenes::TestScene;

    /// True if some sampled yaw has `band` rad on each side free of every other disc, judged by distance.
    fn some_band_is_free(scene: &Scene, band: f64) -> bool {
        let (gripper, start) = (scene.gripper(), Tree::of_start(scene));
        (0..500).any(|sample| {
            let yaw = gripper.period() * f64::from(sample) / 500.0;
            let grip = Grip::centred(start.body(scene.target().unwrap().get()), gripper, (yaw, band));
            let others = scene.indices().filter(|object| Some(*object) != scene.target());
            others.map(|object| start.body(object.get())).all(|other| !grip.comes_near(other, other.radius))
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

    /// A free interval is found where, and only where, sampling finds one.
    fn agrees(scene: &Scene) -> Result<(), TestCaseError> {
        let (start, tolerance) = (Tree::of_start(scene), scene.gripper().yaw_tolerance());
        for leaning in [Leaning::Blocked, Leaning::Free] {
            let mut rings = Rings::new(scene, &start, leaning);
            let ring = rings.ring(scene.target().unwrap(), &mut Ticker::new(&Budget::unlimited())).unwrap();
            // The middle of a free interval is at most half a sample off.
            let half_sample = scene.gripper().period() / 1000.0 + 1e-9;
            if rings.free_yaw(&ring, |_| true).is_some() {
                prop_assert!(some_band_is_free(scene, tolerance - half_sample));
            } else {
                prop_assert!(!some_band_is_free(scene, tolerance + 1e-9));
            }
        }
        Ok(())
    }

    proptest! {
        #[test]
        fn a_free_interval_is_found_where_a_band_of_its_width_is_free(
            fingers in 2_u32..=6, tolerance in 0.01..0.3_f64,
            others in proptest::collection::vec((0.3..0.7_f64, 0.3..0.7_f64, 0.005..0.09_f64), 1..16),
        ) {
            let mut discs = vec![(0.5, 0.5, 0.05)];
            discs.extend(others);
            agrees(&TestScene::new(fingers).yaw_tolerance(tolerance).scatter(&discs).build("d0"))?;
        }

        #[test]
        fn a_free_interval_between_bars_is_found(
            fingers in 2_u32..=6, tolerance in 0.01..0.3_f64,
            bars in proptest::collection::vec((0.0..6.3_f64, 0.0..0.08_f64, 0.0..6.3_f64, 0.01..0.2_f64), 1..6),
        ) {
            let mut scene = TestScene::new(fingers).yaw_tolerance(tolerance).disc("t", 0.5, 0.5, 0.05);
            for (n, (bearing, beyond, yaw, length)) in bars.into_iter().enumerate() {
                let (id, away) = (format!("bar{n}"), 0.05 + 0.01 + length / 2.0 + beyond);
                let (x, y) = (0.5 + away * libm::cos(bearing), 0.5 + away * libm::sin(bearing));
                // Fixed objects may overlap.
                scene = scene.rectangle(&id, [x, y, yaw], [length, 0.02]).fix(&id);
            }
            agrees(&scene.build("t"))?;
        }
    }
}
