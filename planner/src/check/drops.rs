//! What is taken to each drop-off.

use std::collections::HashMap;

use crate::scene::{ObjectIndex, Scene};

use super::allowed::Allowed;
use super::fault::{FaultCode, Faults};

/// The objects at the drop-offs.
pub(super) struct Drops {
    /// Per drop-off how many objects it holds.
    held: Vec<u64>,
    /// Where each object that was taken away is. One that was taken to no known drop-off is nowhere.
    at: HashMap<ObjectIndex, usize>,
    /// The number of objects that were taken away.
    taken: usize,
}

impl Drops {
    pub(super) fn new(scene: &Scene) -> Self {
        Self { held: vec![0; scene.drop_offs().len()], at: HashMap::new(), taken: 0 }
    }

    /// Takes the object to the drop-off, which must be there, accept it and have room.
    pub(super) fn take(
        &mut self,
        scene: &Scene,
        allowed: &Allowed<'_>,
        step: usize,
        object: ObjectIndex,
        drop_off: &str,
        faults: &mut Faults,
    ) {
        self.taken += 1;
        let id = scene.object(object).id();
        let Some(at) = allowed.drop_off(drop_off) else {
            let detail = || format!("there is no drop-off '{drop_off}'");
            faults.of_step(FaultCode::UnknownDropOff, step, id, detail);
            return;
        };
        if !accepts(scene, at, object) {
            faults.of_step(FaultCode::NotAccepted, step, id, || format!("'{drop_off}' does not accept it"));
        }
        self.held[at] += 1;
        if let Some(capacity) = scene.drop_offs()[at].capacity().filter(|capacity| self.held[at] > *capacity) {
            let detail = || format!("'{drop_off}' takes no more than {capacity} and holds {}", self.held[at]);
            faults.of_step(FaultCode::OverCapacity, step, id, detail);
        }
        self.at.insert(object, at);
    }

    /// The number of objects that were taken away.
    pub(super) fn taken(&self) -> usize {
        self.taken
    }

    /// The drop-off at which the object is.
    pub(super) fn of(&self, object: ObjectIndex) -> Option<usize> {
        self.at.get(&object).copied()
    }

    /// True if the drop-off takes one more object.
    pub(super) fn has_room(&self, scene: &Scene, drop_off: usize) -> bool {
        scene.drop_offs()[drop_off].capacity().is_none_or(|capacity| self.held[drop_off] < capacity)
    }
}

/// True if the drop-off at this position accepts the object.
fn accepts(scene: &Scene, drop_off: usize, object: ObjectIndex) -> bool {
    scene.drop_offs()[drop_off].accepts().is_none_or(|accepted| accepted.binary_search(&object).is_ok())
}

/// The drop-offs that accept each object.
pub(super) struct Takers {
    /// Those that accept any object.
    any: Vec<usize>,
    /// Per object those that name it.
    by_name: HashMap<ObjectIndex, Vec<usize>>,
}

impl Takers {
    pub(super) fn new(scene: &Scene) -> Self {
        let mut takers = Self { any: Vec::new(), by_name: HashMap::new() };
        for (at, drop_off) in scene.drop_offs().iter().enumerate() {
            match drop_off.accepts() {
                Some(objects) => objects.iter().for_each(|&object| takers.by_name.entry(object).or_default().push(at)),
                None => takers.any.push(at),
            }
        }
        takers
    }

    pub(super) fn of(&self, object: ObjectIndex) -> impl Iterator<Item = usize> + '_ {
        self.any.iter().chain(self.by_name.get(&object).into_iter().flatten()).copied()
    }
}
