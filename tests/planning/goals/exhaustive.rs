//! Every set of objects that can be moved, found by trying all orders.

use singulate_planner::knowledge::SweptFinger;
use singulate_planner::placement::grasp_without;
use singulate_planner::scene::{ObjectIndex, Scene};

/// A set of objects, one bit for each.
pub(super) type Set = u32;

/// A scene with what can be moved at all.
pub(super) struct Trial<'a> {
    pub(super) scene: &'a Scene,
    /// What may be moved, by the words of the contract: not fixed, not too wide, and where it leaves the table accepted.
    pub(super) movable: Set,
    /// Per set of objects that are gone those that can be grasped then.
    graspable: Vec<Set>,
}

impl<'a> Trial<'a> {
    pub(super) fn new(scene: &'a Scene, leaves: bool) -> Self {
        let count = scene.objects().len();
        let fits = |object: ObjectIndex| {
            let widest = scene.gripper().max_opening().map_or(f64::INFINITY, |opening| opening / 2.0);
            !scene.object(object).fixed() && scene.object(object).footprint().circumradius() <= widest
        };
        let of = |set: Set| scene.indices().filter(move |object| set >> object.get() & 1 == 1);
        let set = |objects: &mut dyn Iterator<Item = ObjectIndex>| objects.fold(0, |set, o| set | 1 << o.get());
        let all = (1 << count) - 1;
        let movable =
            set(&mut of(all).filter(|&object| fits(object) && (!leaves || taken_by(scene, object).count() > 0)));
        let graspable = (0..=all).map(|gone| {
            let away: Vec<ObjectIndex> = of(gone).collect();
            set(&mut of(all & !gone).filter(|&o| fits(o) && grasp_without(scene, o, &away, &SweptFinger).is_some()))
        });
        Self { scene, movable, graspable: graspable.collect() }
    }

    pub(super) fn graspable(&self, gone: Set) -> Set {
        self.graspable[gone as usize]
    }

    /// Every set that some order moves, never one of `held`, and of which `fits` says that there is room for it.
    pub(super) fn sets(&self, held: Set, fits: impl Fn(Set) -> bool) -> Vec<Set> {
        let mut found = vec![0];
        let mut seen = vec![false; self.graspable.len()];
        seen[0] = true;
        let mut at = 0;
        while let Some(&gone) = found.get(at) {
            at += 1;
            let next = self.graspable(gone) & self.movable & !held;
            for object in (0..32).filter(|object| next >> object & 1 == 1) {
                let gone = gone | 1 << object;
                if !core::mem::replace(&mut seen[gone as usize], true) && fits(gone) {
                    found.push(gone);
                }
            }
        }
        found
    }

    /// True if the drop-offs have room for the whole set, by trying every drop-off for each.
    pub(super) fn fits(&self, set: Set) -> bool {
        let objects: Vec<ObjectIndex> = self.scene.indices().filter(|object| set >> object.get() & 1 == 1).collect();
        settle(self.scene, &objects, &mut vec![0; self.scene.drop_offs().len()])
    }
}

/// The drop-offs that accept an object.
fn taken_by(scene: &Scene, object: ObjectIndex) -> impl Iterator<Item = usize> + '_ {
    let accepts = move |at: &usize| scene.drop_offs()[*at].accepts().is_none_or(|objects| objects.contains(&object));
    (0..scene.drop_offs().len()).filter(accepts)
}

fn settle(scene: &Scene, objects: &[ObjectIndex], held: &mut Vec<u64>) -> bool {
    let Some((&first, rest)) = objects.split_first() else { return true };
    for at in taken_by(scene, first).collect::<Vec<_>>() {
        if scene.drop_offs()[at].capacity().is_none_or(|capacity| held[at] < capacity) {
            held[at] += 1;
            if settle(scene, rest, held) {
                return true;
            }
            held[at] -= 1;
        }
    }
    false
}
