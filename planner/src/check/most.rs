//! The greatest number of objects that can be taken away, by trying every set of them, smaller sets first.

use std::collections::{HashMap, HashSet};
use std::rc::Rc;

use crate::budget::{Interrupted, Ticker};
use crate::scene::{ObjectIndex, Scene};

use super::drops::Takers;
use super::ring::Ring;
use super::rings::Rings;

/// The most objects of which every set is tried: a million sets.
pub(super) const MOST_OBJECTS: usize = 20;

/// A set of the objects, one bit for each.
type Set = u32;

struct Trial<'a, 's> {
    scene: &'a Scene,
    objects: &'a [ObjectIndex],
    rings: &'a Rings<'s>,
    ring_of: Vec<Rc<Ring>>,
    /// Per object those others that block it at some yaw.
    blockers: Vec<Set>,
    /// Whether an object can be lifted once some of its blockers are gone.
    liftable: HashMap<(usize, Set), bool>,
    /// Per object the drop-offs that accept it.
    takers: Vec<Vec<usize>>,
}

/// The greatest number of `objects`, at most [`MOST_OBJECTS`], that any order takes away while all others stand.
pub(super) fn most(
    scene: &Scene,
    objects: &[ObjectIndex],
    takers: &Takers,
    rings: &mut Rings<'_>,
    ticker: &mut Ticker<'_>,
) -> Result<usize, Interrupted> {
    let mut ring_of = Vec::with_capacity(objects.len());
    for &object in objects {
        ring_of.push(rings.ring(object, ticker)?);
    }
    let bit = |object: ObjectIndex| objects.binary_search(&object).map_or(0, |at| 1 << at);
    let blockers = ring_of.iter().map(|ring| ring.blockers().fold(0, |set, by| set | bit(by))).collect();
    let takers = objects.iter().map(|&object| takers.of(object).collect()).collect();
    let mut trial = Trial { scene, objects, rings, ring_of, blockers, liftable: HashMap::new(), takers };
    let (mut layer, mut size) = (vec![0], 0);
    loop {
        layer = trial.larger(&layer, ticker)?;
        if layer.is_empty() {
            return Ok(size);
        }
        size += 1;
    }
}

impl Trial<'_, '_> {
    /// The sets with one object more that can be taken away.
    fn larger(&mut self, sets: &[Set], ticker: &mut Ticker<'_>) -> Result<Vec<Set>, Interrupted> {
        let (mut seen, mut larger) = (HashSet::new(), Vec::new());
        for &set in sets {
            ticker.step(1)?;
            for at in (0..self.objects.len()).filter(|at| set >> at & 1 == 0) {
                let next = set | 1 << at;
                if !seen.contains(&next) && self.lifts(at, set) {
                    ticker.step(1)?;
                    seen.insert(next);
                    if self.has_room_for(next) {
                        larger.push(next);
                    }
                }
            }
        }
        Ok(larger)
    }

    /// True if the object can be lifted once the set is gone.
    fn lifts(&mut self, at: usize, gone: Set) -> bool {
        let gone = gone & self.blockers[at];
        let Self { objects, rings, ring_of, liftable, .. } = self;
        *liftable.entry((at, gone)).or_insert_with(|| {
            let stands =
                |object: ObjectIndex| objects.binary_search(&object).map_or(true, |other| gone >> other & 1 == 0);
            rings.free_yaw(&ring_of[at], stands).is_some()
        })
    }

    /// True if the drop-offs have room for the whole set.
    fn has_room_for(&self, set: Set) -> bool {
        let mut held: HashMap<usize, Vec<usize>> = HashMap::new();
        let members = (0..self.objects.len()).filter(|at| set >> at & 1 == 1);
        members.into_iter().all(|at| self.settle(at, &mut held, &mut HashSet::new()))
    }

    /// Brings the object to a drop-off, moving others to further ones where that makes room. `tried` are those looked at.
    fn settle(&self, at: usize, held: &mut HashMap<usize, Vec<usize>>, tried: &mut HashSet<usize>) -> bool {
        for &drop_off in &self.takers[at] {
            if !tried.insert(drop_off) {
                continue;
            }
            let there = held.entry(drop_off).or_default();
            let full =
                self.scene.drop_offs()[drop_off].capacity().is_some_and(|capacity| there.len() as u64 >= capacity);
            if !full {
                there.push(at);
                return true;
            }
            for place in 0..there.len() {
                let other = held[&drop_off][place];
                if self.settle(other, held, tried) {
                    if let Some(there) = held.get_mut(&drop_off) {
                        there[place] = at;
                    }
                    return true;
                }
            }
        }
        false
    }
}
