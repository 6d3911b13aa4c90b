//! The layout: where each object stands after some moves.

use nalgebra::Point2;

use crate::geometry::{ArcSet, Grasp, widest_grasp};
use crate::knowledge::GraspModel;
use crate::scene::{Footprint, ObjectIndex, Pose, Scene};

/// The scene after some moves, with some objects lifted off the table.
#[derive(Clone)]
pub struct Layout<'a> {
    scene: &'a Scene,
    model: &'a dyn GraspModel,
    /// Per object its new place, if it was moved.
    place: Vec<Option<Pose>>,
    moved: Vec<ObjectIndex>,
    lifted: Vec<bool>,
}

impl<'a> Layout<'a> {
    /// The scene as it is; `model` says which yaws are free.
    pub fn new(scene: &'a Scene, model: &'a dyn GraspModel) -> Self {
        let count = scene.objects().len();
        Self { scene, model, place: vec![None; count], moved: Vec::new(), lifted: vec![false; count] }
    }

    pub(super) fn scene(&self) -> &'a Scene {
        self.scene
    }

    /// Where an object stands.
    pub fn footprint(&self, object: ObjectIndex) -> Footprint {
        let footprint = self.scene.object(object).footprint();
        self.place[object.get()].map_or(footprint, |pose| footprint.moved_to(pose))
    }

    /// Puts an object somewhere. Returns the place to which it was moved before, if it was.
    pub fn put(&mut self, object: ObjectIndex, pose: Pose) -> Option<Pose> {
        let before = self.place[object.get()].replace(pose);
        if before.is_none() {
            self.moved.push(object);
        }
        before
    }

    /// Undoes the last [`Layout::put`] of this object.
    pub(super) fn take_back(&mut self, object: ObjectIndex, before: Option<Pose>) {
        self.place[object.get()] = before;
        if before.is_none() {
            self.moved.retain(|&other| other != object);
        }
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
    pub(super) fn near(&self, centre: Point2<f64>, reach: f64) -> impl Iterator<Item = (ObjectIndex, Footprint)> + '_ {
        let in_place =
            self.scene.index().within(centre, reach).filter(|(object, _)| self.place[object.get()].is_none());
        let moved = self.moved.iter().map(|&object| (object, self.footprint(object)));
        let moved = moved.filter(move |(_, footprint)| footprint.comes_within(centre, reach));
        in_place.chain(moved).filter(|(object, _)| !self.is_lifted(*object))
    }

    /// How near to the origin of `grasped` another object must come to block a grasp of it, m.
    pub(super) fn reach(&self, grasped: &Footprint) -> f64 {
        self.model.reach(self.scene.gripper(), grasped)
    }

    /// The blocked yaws of a grasp or release of `object` at `place`. Fingers keep the margin and `extra` (m) from all
    /// other objects.
    pub fn blocked(&self, object: ObjectIndex, place: &Footprint, extra: f64) -> ArcSet {
        let gripper = self.scene.gripper();
        let others =
            self.near(place.at(), self.model.reach(gripper, place) + extra).filter(|(other, _)| *other != object);
        let shadows: Vec<ArcSet> = others.map(|(_, other)| self.model.shadow(gripper, place, &other, extra)).collect();
        ArcSet::union(gripper.period(), &shadows)
    }

    /// The widest grasp of an object where it stands.
    pub fn grasp(&self, object: ObjectIndex) -> Option<Grasp> {
        widest_grasp(self.scene.gripper(), &self.blocked(object, &self.footprint(object), 0.0))
    }

    /// The least distance from `object` at `place` to another object, edge to edge, m; infinite if there is none.
    pub fn gap(&self, object: ObjectIndex, place: &Footprint) -> f64 {
        let others = self.scene.indices().filter(|&other| other != object && !self.is_lifted(other));
        others.map(|other| place.gap(&self.footprint(other))).fold(f64::INFINITY, f64::min)
    }
}

/// The widest grasp of an object in the scene at the start.
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
    let (gripper, grasped) = (scene.gripper(), scene.object(object).footprint());
    let near = scene.index().within(grasped.at(), model.reach(gripper, &grasped));
    let others = near.filter(|(other, _)| *other != object && !gone.contains(other));
    let shadows: Vec<ArcSet> = others.map(|(_, other)| model.shadow(gripper, &grasped, &other, 0.0)).collect();
    widest_grasp(gripper, &ArcSet::union(gripper.period(), &shadows))
}
