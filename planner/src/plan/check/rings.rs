//! Who stands round each object at the start, and whether those that still stand leave it a yaw.

use std::rc::Rc;

use crate::budget::Interrupted;
use crate::scene::{ObjectIndex, Scene};

use super::finger::Finger;
use super::meter::Meter;
use super::near::Places;
use super::yaws::blocked_yaws;

/// Which way a case is decided that rounding leaves open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Leaning {
    /// Rather blocked: for statements that an object can't be grasped (locks, landmarks).
    Blocked,
    /// Rather free: for statements that it can (needed objects).
    Free,
}

/// A free interval is called so only when its width is this much beyond the least, rad: two ways to find an end of it
/// differ by less.
const WIDTH_LEANING: f64 = 1e-10;
/// An obstacle is taken larger by this share of the lengths in play. Where a circle is only just touched, the last digit
/// decides between no shadow and one of 1e-8 rad; this is far above the last digit and far below `WIDTH_LEANING`.
const LENGTH_LEANING: f64 = 1e-12;

impl Leaning {
    fn sign(self) -> f64 {
        match self {
            Self::Blocked => 1.0,
            Self::Free => -1.0,
        }
    }
}

/// Yaws that one obstacle blocks.
struct Shade {
    lo: f64,
    hi: f64,
    by: ObjectIndex,
}

/// All that blocks one object at the start.
pub(super) struct Ring {
    /// By `lo`.
    shades: Vec<Shade>,
}

impl Ring {
    /// How many intervals it holds.
    pub(super) fn len(&self) -> usize {
        self.shades.len()
    }

    /// Who blocks some yaw; one that has several shades is named several times.
    pub(super) fn blockers(&self) -> impl Iterator<Item = ObjectIndex> + '_ {
        self.shades.iter().map(|shade| shade.by)
    }
}

/// The rings of a scene, each made when it is first asked for.
pub(super) struct Rings<'a> {
    scene: &'a Scene,
    places: &'a Places,
    leaning: Leaning,
    made: Vec<Option<Rc<Ring>>>,
    /// For each object those whose ring, if made, holds it.
    watchers: Vec<Vec<ObjectIndex>>,
}

impl<'a> Rings<'a> {
    pub(super) fn new(scene: &'a Scene, places: &'a Places, leaning: Leaning) -> Self {
        let count = scene.objects().len();
        Self { scene, places, leaning, made: vec![None; count], watchers: vec![Vec::new(); count] }
    }

    /// The ring of an object.
    pub(super) fn ring(&mut self, object: ObjectIndex, meter: &mut Meter<'_>) -> Result<Rc<Ring>, Interrupted> {
        if let Some(ring) = &self.made[object.get()] {
            return Ok(Rc::clone(ring));
        }
        let ring = Rc::new(self.make(object, meter)?);
        for by in ring.blockers() {
            let watchers = &mut self.watchers[by.get()];
            if watchers.last() != Some(&object) {
                watchers.push(object);
            }
        }
        self.made[object.get()] = Some(Rc::clone(&ring));
        Ok(ring)
    }

    /// The objects in whose rings, as far as they are made, this one stands.
    pub(super) fn watchers(&self, object: ObjectIndex) -> &[ObjectIndex] {
        &self.watchers[object.get()]
    }

    fn make(&self, object: ObjectIndex, meter: &mut Meter<'_>) -> Result<Ring, Interrupted> {
        let (gripper, disc) = (self.scene.gripper(), self.scene.object(object).disc());
        let finger = Finger::new(gripper, disc.radius);
        let reach = (finger.corner_distance() + gripper.margin()) * (1.0 + 4.0 * LENGTH_LEANING);
        let mut near = Vec::new();
        self.places.within(disc.centre, reach, |place| near.push(place));
        meter.spend(1)?;
        let mut shades = Vec::new();
        for place in near {
            let by = self.places.owner(place);
            if by == object || !self.places.is_start(place) {
                continue;
            }
            meter.spend(1)?;
            let (obstacle, rho) = (self.places.disc(place), self.places.disc(place).radius + gripper.margin());
            let apart = obstacle.centre - disc.centre;
            let rho = rho + self.leaning.sign() * LENGTH_LEANING * (rho + apart.norm());
            let yaws = blocked_yaws(&finger, gripper.period(), apart, rho);
            shades.extend(yaws.into_iter().map(|[lo, hi]| Shade { lo, hi, by }));
        }
        shades.sort_unstable_by(|a, b| a.lo.total_cmp(&b.lo).then(a.by.cmp(&b.by)));
        Ok(Ring { shades })
    }

    /// True if the object of this ring has a free interval of yaws that counts, while those obstacles stand for which
    /// `stands` is true. Where nothing blocks every yaw will do, whatever the tolerance.
    pub(super) fn is_free(&self, ring: &Ring, stands: impl Fn(ObjectIndex) -> bool) -> bool {
        let gripper = self.scene.gripper();
        let mut shades = ring.shades.iter().filter(|shade| stands(shade.by));
        let Some(first) = shades.next() else { return true };
        let (mut covered, mut widest) = (first.hi, 0.0_f64);
        for shade in shades {
            widest = widest.max(shade.lo - covered);
            covered = covered.max(shade.hi);
        }
        // The interval round the period's end.
        widest = widest.max(first.lo + gripper.period() - covered);
        widest > gripper.min_free_width() + self.leaning.sign() * WIDTH_LEANING
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::budget::Budget;
    use crate::plan::check::names::Names;
    use crate::scene::scenes::TestScene;

    /// True if some sampled yaw has `band` rad on each side free of every other disc, judged by distance.
    fn some_band_is_free(scene: &Scene, band: f64) -> bool {
        let (gripper, target) = (scene.gripper(), scene.object(scene.target()).disc());
        let finger = Finger::new(gripper, target.radius);
        (0..500).any(|sample| {
            let yaw = gripper.period() * f64::from(sample) / 500.0;
            scene.indices().filter(|object| *object != scene.target()).all(|object| {
                let disc = scene.object(object).disc();
                finger.closest(gripper, disc.centre - target.centre, yaw, band) >= disc.radius
            })
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
            let names = Names::new(&scene);
            let places = Places::new(&scene, &[], &names);
            let mut rings = Rings::new(&scene, &places, leaning);
            let ring = rings.ring(scene.target(), &mut Meter::new(&Budget::unlimited())).unwrap();
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
            let names = Names::new(&scene);
            let places = Places::new(&scene, &[], &names);
            for leaning in [Leaning::Blocked, Leaning::Free] {
                let mut rings = Rings::new(&scene, &places, leaning);
                let ring = rings.ring(scene.target(), &mut Meter::new(&Budget::unlimited())).unwrap();
                // The middle of a free interval is at most half a sample off.
                let half_sample = scene.gripper().period() / 1000.0 + 1e-9;
                if rings.is_free(&ring, |_| true) {
                    prop_assert!(some_band_is_free(&scene, tolerance - half_sample));
                } else {
                    prop_assert!(!some_band_is_free(&scene, tolerance + 1e-9));
                }
            }
        }
    }
}
