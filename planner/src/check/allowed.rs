//! Which objects a plan may move, found from the figures of the scene: the planner's own notion is not asked.

use core::cell::Cell;
use std::collections::HashMap;

use crate::scene::{Destination, Goal, Grasps, Gripper, Object, ObjectIndex, Scene};

use super::grip::is_too_wide;
use super::leaning::Leaning;

/// The objects of a scene by what may be done with them, whatever the goal; and its drop-offs by id.
pub(super) struct Allowed<'s> {
    scene: &'s Scene,
    /// Per object whether a hand can grasp it, once that was asked.
    graspable: Vec<Cell<Option<bool>>>,
    /// Per object whether some drop-off accepts it.
    accepted: Vec<bool>,
    drop_offs: HashMap<&'s str, usize>,
}

/// How much wider than the greatest opening an object may be, as a share of it: rounding, where it is as wide.
const ROUNDING: f64 = 1e-12;

impl<'s> Allowed<'s> {
    pub(super) fn new(scene: &'s Scene) -> Self {
        let any = scene.drop_offs().iter().any(|drop_off| drop_off.accepts().is_none());
        let mut accepted = vec![any; scene.objects().len()];
        for object in scene.drop_offs().iter().filter_map(|drop_off| drop_off.accepts()).flatten() {
            accepted[object.get()] = true;
        }
        let drop_offs = scene.drop_offs().iter().enumerate().map(|(at, drop_off)| (drop_off.id(), at)).collect();
        Self { scene, graspable: vec![Cell::new(None); scene.objects().len()], accepted, drop_offs }
    }

    /// True if the caller does not call the object fixed and a hand can grasp it.
    pub(super) fn graspable(&self, object: ObjectIndex) -> bool {
        let known = &self.graspable[object.get()];
        let graspable = known.get().unwrap_or_else(|| can_grasp(self.scene.gripper(), self.scene.object(object)));
        known.set(Some(graspable));
        graspable
    }

    /// True if some drop-off accepts the object.
    pub(super) fn accepted(&self, object: ObjectIndex) -> bool {
        self.accepted[object.get()]
    }

    /// True if a plan for the goal of `scene` may move the object. What is grasped in the end is not moved before.
    pub(super) fn relocatable(&self, scene: &Scene, object: ObjectIndex) -> bool {
        let goal = scene.goal();
        let room = self.accepted(object) || !only_drops(scene);
        self.graspable(object) && room && !goal.is_candidate(object)
    }

    /// The position of the drop-off with this id.
    pub(super) fn drop_off(&self, id: &str) -> Option<usize> {
        self.drop_offs.get(id).copied()
    }
}

/// True if the object is not fixed, is higher than the fingertips, and the hand opens wide enough for it in some way.
fn can_grasp(gripper: &Gripper, object: &Object) -> bool {
    let shape = object.footprint().shape();
    let reached = object.height().is_none_or(|height| height > gripper.tip_height());
    let spans = || match object.grasps() {
        Grasps::EveryYaw => {
            let widest = gripper.max_opening().map_or(f64::INFINITY, |opening| opening * (1.0 + ROUNDING));
            2.0 * shape.radius() <= widest
        }
        Grasps::Listed(list) => list.iter().any(|grasp| !is_too_wide(shape, grasp, gripper, Leaning::Free)),
    };
    !object.fixed() && reached && spans()
}

/// True if nothing may be put aside on the table.
pub(super) fn only_drops(scene: &Scene) -> bool {
    scene.destination() == Destination::DropOff || *scene.goal() == Goal::Clear
}

/// True if the object may be taken away to a drop-off.
pub(super) fn may_drop(scene: &Scene, object: ObjectIndex) -> bool {
    scene.destination() != Destination::Table || *scene.goal() == Goal::Clear || scene.goal().wants_away(object)
}
