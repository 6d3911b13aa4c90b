//! Which objects to take away where drop-offs can't take all that could go: the greatest number, by dynamic programming over
//! the sets of objects that are gone.

use std::collections::{BTreeMap, HashMap};

use smallvec::SmallVec;

use crate::budget::{Interrupted, Ticker};
use crate::knowledge::KnowledgeBase;
use crate::scene::{ObjectIndex, Scene};

/// The most objects for which every set may be tried: a million sets.
pub(super) const MOST_OBJECTS: usize = 20;

/// A set of the objects, one bit for each.
type Set = u32;

/// The objects that each kind of drop-off holds.
type Held = SmallVec<[Set; 8]>;

/// The choice among at most [`MOST_OBJECTS`] objects, each of which could go if drop-offs had no limits.
pub(super) struct Choice {
    objects: Vec<ObjectIndex>,
    /// Per object its options, as sets of objects that must be gone; those with any other object are left out.
    options: Vec<Vec<Set>>,
    /// Drop-offs that accept the same of these objects, as one: what they accept, and how many.
    kinds: Vec<(Set, u32)>,
    /// No set has more objects.
    bound: u32,
    /// Per set that can be taken away the size of the greatest that it is part of.
    greatest: HashMap<Set, u32>,
}

impl Choice {
    /// `objects` are in index order; `bound` is the size of a greatest set that the drop-offs hold.
    pub(super) fn new(scene: &Scene, base: &KnowledgeBase, objects: &[ObjectIndex], bound: usize) -> Self {
        let bit = |object: &ObjectIndex| objects.binary_search(object).ok().map(|at| 1 << at);
        let set = |members: &[ObjectIndex]| members.iter().map(bit).try_fold(0, |set, bit| Some(set | bit?));
        let options = objects.iter().map(|&object| base.options(object).filter_map(set).collect()).collect();
        let mut kinds: BTreeMap<Set, u32> = BTreeMap::new();
        for drop_off in scene.drop_offs() {
            let accepted = match drop_off.accepts() {
                Some(accepted) => accepted.iter().filter_map(bit).fold(0, |set, bit| set | bit),
                None => Set::MAX,
            };
            let room = drop_off.capacity().map_or(u32::MAX, |capacity| u32::try_from(capacity).unwrap_or(u32::MAX));
            let capacity = kinds.entry(accepted).or_default();
            *capacity = capacity.saturating_add(room);
        }
        Self {
            objects: objects.to_vec(),
            options,
            kinds: kinds.into_iter().collect(),
            bound: u32::try_from(bound).unwrap_or(u32::MAX),
            greatest: HashMap::new(),
        }
    }

    /// The size of the greatest set that can be taken away.
    pub(super) fn most(&mut self, ticker: &mut Ticker<'_>) -> Result<usize, Interrupted> {
        let none = Held::from_elem(0, self.kinds.len());
        Ok(self.from(0, &none, ticker)? as usize)
    }

    /// True if a greatest set can still be taken away once `gone` and then `object` are.
    pub(super) fn leads_on(
        &mut self,
        gone: &[ObjectIndex],
        object: ObjectIndex,
        ticker: &mut Ticker<'_>,
    ) -> Result<bool, Interrupted> {
        let most = self.most(ticker)?;
        let (mut set, mut held) = (0, Held::from_elem(0, self.kinds.len()));
        for next in gone.iter().chain([&object]) {
            let Ok(at) = self.objects.binary_search(next) else { return Ok(false) };
            if !self.settle(at, &mut held, &mut Held::from_elem(0, self.kinds.len())) {
                return Ok(false);
            }
            set |= 1 << at;
        }
        Ok(self.from(set, &held, ticker)? as usize == most)
    }

    /// The size of the greatest set that can be taken away, given that `set` is gone, to where it is `held`.
    fn from(&mut self, set: Set, held: &Held, ticker: &mut Ticker<'_>) -> Result<u32, Interrupted> {
        if let Some(&known) = self.greatest.get(&set) {
            return Ok(known);
        }
        ticker.step(1)?;
        let mut greatest = set.count_ones();
        for at in 0..self.objects.len() {
            if greatest >= self.bound {
                break;
            }
            let frees = |option: &Set| option & !set == 0;
            if set >> at & 1 == 1 || !self.options[at].iter().any(frees) {
                continue;
            }
            let next = set | 1 << at;
            let size = match self.greatest.get(&next) {
                Some(&known) => known,
                None => {
                    let mut settled = held.clone();
                    let fits = self.settle(at, &mut settled, &mut Held::from_elem(0, self.kinds.len()));
                    if fits { self.from(next, &settled, ticker)? } else { 0 }
                }
            };
            greatest = greatest.max(size);
        }
        self.greatest.insert(set, greatest);
        Ok(greatest)
    }

    /// Brings the object to a drop-off, where others may have to move on. `tried` marks the kinds that were looked at.
    fn settle(&self, at: usize, held: &mut Held, tried: &mut Held) -> bool {
        for kind in 0..self.kinds.len() {
            let (accepted, capacity) = self.kinds[kind];
            if accepted >> at & 1 == 0 || core::mem::replace(&mut tried[kind], 1) == 1 {
                continue;
            }
            if held[kind].count_ones() < capacity {
                held[kind] |= 1 << at;
                return true;
            }
            for other in
                (0..self.objects.len()).filter(|other| held[kind] >> other & 1 == 1).collect::<SmallVec<[usize; 20]>>()
            {
                if self.settle(other, held, tried) {
                    held[kind] = held[kind] & !(1 << other) | 1 << at;
                    return true;
                }
            }
        }
        false
    }
}
