//! The layout: where each object stands after some moves.

use nalgebra::Point2;

use super::INSIDE;
use crate::geometry::{Grasp, Hold, Shadow};
use crate::knowledge::GraspModel;
use crate::scene::{Footprint, ObjectIndex, Placed, Pose, Scene, distance};

/// The scene after some moves, with some objects lifted off the table.
#[derive(Clone)]
pub struct Layout<'a> {
    scene: &'a Scene,
    model: &'a dyn GraspModel,
    /// Per object its new place, if it was moved.
    place: Vec<Option<Footprint>>,
    moved: Vec<ObjectIndex>,
    lifted: Vec<bool>,
}

impl<'a> Layout<'a> {
    /// The scene as it is; `model` says which grasps are free.
    pub fn new(scene: &'a Scene, model: &'a dyn GraspModel) -> Self {
        let count = scene.objects().len();
        Self { scene, model, place: vec![None; count], moved: Vec::new(), lifted: vec![false; count] }
    }

    pub(super) fn scene(&self) -> &'a Scene {
        self.scene
    }

    /// Where an object stands.
    pub fn footprint(&self, object: ObjectIndex) -> &Footprint {
        self.place[object.get()].as_ref().unwrap_or_else(|| self.scene.object(object).footprint())
    }

    pub(super) fn placed(&self, object: ObjectIndex) -> Placed<'_> {
        Placed { object: self.scene.object(object), footprint: self.footprint(object) }
    }

    /// Puts an object somewhere. Returns the place to which it was moved before, if it was.
    pub fn put(&mut self, object: ObjectIndex, pose: Pose) -> Option<Footprint> {
        let place = self.footprint(object).moved_to(pose);
        let before = self.place[object.get()].replace(place);
        if before.is_none() {
            self.moved.push(object);
        }
        before
    }

    /// Undoes the last [`Layout::put`] of this object.
    pub(super) fn take_back(&mut self, object: ObjectIndex, before: Option<Footprint>) {
        if before.is_none() {
            self.moved.retain(|&other| other != object);
        }
        self.place[object.get()] = before;
    }

    /// The object leaves the table for good.
    pub fn take_away(&mut self, object: ObjectIndex) {
        self.lift(object, true);
    }

    pub(super) fn lift(&mut self, object: ObjectIndex, lifted: bool) {
        self.lifted[object.get()] = lifted;
    }

    pub(super) fn is_lifted(&self, object: ObjectIndex) -> bool {
        self.lifted[object.get()]
    }

    /// The objects nearer than `reach` (edge to point, m) to `centre`, in a fixed order.
    pub(super) fn near(&self, centre: Point2<f64>, reach: f64) -> impl Iterator<Item = (ObjectIndex, &Footprint)> {
        let in_place =
            self.scene.index().within(centre, reach).filter(|(object, _)| self.place[object.get()].is_none());
        let moved = self.moved.iter().map(|&object| (object, self.footprint(object)));
        let moved = moved.filter(move |(_, footprint)| footprint.comes_within(centre, reach));
        in_place.chain(moved).filter(|(object, _)| !self.is_lifted(*object))
    }

    /// How near to the origin of an object another one must come to block a grasp of it, m.
    pub(super) fn reach(&self, grasped: ObjectIndex) -> f64 {
        self.model.reach(self.scene.gripper(), self.scene.object(grasped))
    }

    /// The blocked ways to grasp or to release `object` at `place`. The gripper keeps the margin and `extra` (m) from all other
    /// objects.
    pub fn blocked(&self, object: ObjectIndex, place: &Footprint, extra: f64) -> Shadow {
        let (gripper, grasped) = (self.scene.gripper(), Placed { object: self.scene.object(object), footprint: place });
        let others = self.near(place.at(), self.reach(object) + extra).filter(|(other, _)| *other != object);
        let shadows: Vec<Shadow> =
            others.map(|(other, _)| self.model.shadow(gripper, grasped, self.placed(other), extra)).collect();
        Shadow::union(gripper, grasped.object.grasps(), &shadows)
    }

    /// The free ways to hold `object` at `place` while the gripper keeps the margin and `extra` (m) from all others.
    pub fn hold_at(&self, object: ObjectIndex, place: &Footprint, extra: f64) -> Option<Hold> {
        let grasped = Placed { object: self.scene.object(object), footprint: place };
        Hold::free(self.scene.gripper(), grasped, &self.blocked(object, place, extra))
    }

    /// The free ways to hold an object where it stands.
    pub fn hold(&self, object: ObjectIndex) -> Option<Hold> {
        self.hold_at(object, self.footprint(object), 0.0)
    }

    /// The best grasp of an object where it stands: the widest, or the first of its list.
    pub fn grasp(&self, object: ObjectIndex) -> Option<Grasp> {
        self.hold(object)?.grasp(self.placed(object))
    }

    /// The least distance from `object` at `place` to another object, edge to edge, m; infinite if there is none.
    pub fn gap(&self, object: ObjectIndex, place: &Footprint) -> f64 {
        let others = self.scene.indices().filter(|&other| other != object && !self.is_lifted(other));
        others.map(|other| self.footprint(other)).fold(f64::INFINITY, |least, other| {
            let reach = place.circumradius() + other.circumradius();
            // With room for rounding: the least gap is stated to the last digit.
            let may_be_nearer = distance(place.at(), other.at()) - reach < least + INSIDE;
            if may_be_nearer { least.min(place.gap(other)) } else { least }
        })
    }
}

/// The best grasp of an object in the scene at the start.
pub fn grasp_in_place(scene: &Scene, object: ObjectIndex, model: &dyn GraspModel) -> Option<Grasp> {
    grasp_without(scene, object, &[], model)
}

/// The same once some objects are gone.
pub fn grasp_without(
    scene: &Scene,
    object: ObjectIndex,
    gone: &[ObjectIndex],
    model: &dyn GraspModel,
) -> Option<Grasp> {
    let (gripper, grasped) = (scene.gripper(), scene.placed(object));
    let near = scene.index().within(grasped.footprint.at(), model.reach(gripper, grasped.object));
    let others = near.filter(|(other, _)| *other != object && !gone.contains(other));
    let shadows: Vec<Shadow> =
        others.map(|(other, _)| model.shadow(gripper, grasped, scene.placed(other), 0.0)).collect();
    let blocked = Shadow::union(gripper, grasped.object.grasps(), &shadows);
    Hold::free(gripper, grasped, &blocked)?.grasp(grasped)
}
