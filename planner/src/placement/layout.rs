//! The layout: where each object stands after some moves.

use nalgebra::Point2;

use crate::geometry::{ArcSet, Grasp, Shadow, widest_grasp};
use crate::scene::{Disc, Gripper, ObjectIndex, Scene};

/// The scene after some moves, with some objects lifted off the table.
#[derive(Debug, Clone)]
pub struct Layout<'a> {
    scene: &'a Scene,
    model: Shadow,
    /// Per object its new place, if it was moved.
    place: Vec<Option<Point2<f64>>>,
    moved: Vec<ObjectIndex>,
    lifted: Vec<bool>,
}

impl<'a> Layout<'a> {
    /// The scene as it is; `model` says which yaws are free.
    pub fn new(scene: &'a Scene, model: Shadow) -> Self {
        let count = scene.objects().len();
        Self { scene, model, place: vec![None; count], moved: Vec::new(), lifted: vec![false; count] }
    }

    pub(super) fn scene(&self) -> &'a Scene {
        self.scene
    }

    /// Where an object stands.
    pub fn disc(&self, object: ObjectIndex) -> Disc {
        let disc = self.scene.object(object).disc();
        self.place[object.get()].map_or(disc, |centre| disc.at(centre))
    }

    /// Puts an object somewhere. Returns the place to which it was moved before, if it was.
    pub fn put(&mut self, object: ObjectIndex, centre: Point2<f64>) -> Option<Point2<f64>> {
        let before = self.place[object.get()].replace(centre);
        if before.is_none() {
            self.moved.push(object);
        }
        before
    }

    /// Undoes the last [`Layout::put`] of this object.
    pub(super) fn take_back(&mut self, object: ObjectIndex, before: Option<Point2<f64>>) {
        self.place[object.get()] = before;
        if before.is_none() {
            self.moved.retain(|&other| other != object);
        }
    }

    pub(super) fn lift(&mut self, object: ObjectIndex, lifted: bool) {
        self.lifted[object.get()] = lifted;
    }

    pub(super) fn is_lifted(&self, object: ObjectIndex) -> bool {
        self.lifted[object.get()]
    }

    /// The objects nearer than `reach` (edge to point, m) to `centre`, in a fixed order.
    pub(super) fn near(&self, centre: Point2<f64>, reach: f64) -> impl Iterator<Item = (ObjectIndex, Disc)> + '_ {
        let in_place =
            self.scene.index().within(centre, reach).filter(|(object, _)| self.place[object.get()].is_none());
        let moved = self.moved.iter().map(|&object| (object, self.disc(object)));
        let moved = moved.filter(move |(_, disc)| {
            let (apart, far) = (disc.centre - centre, reach + disc.radius);
            apart.norm_squared() < far * far
        });
        in_place.chain(moved).filter(|(object, _)| !self.is_lifted(*object))
    }

    /// The blocked yaws of a grasp or release of `object` at `disc`. Fingers keep the margin and `extra` (m) from all
    /// other objects.
    pub fn blocked(&self, object: ObjectIndex, disc: &Disc, extra: f64) -> ArcSet {
        let gripper = self.scene.gripper();
        let others = self.near(disc.centre, reach(gripper, disc) + extra).filter(|(other, _)| *other != object);
        let shadows: Vec<ArcSet> = others.map(|(_, other)| (self.model)(gripper, disc, &other, extra)).collect();
        ArcSet::union(gripper.period(), &shadows)
    }

    /// The widest grasp of an object where it stands.
    pub fn grasp(&self, object: ObjectIndex) -> Option<Grasp> {
        widest_grasp(self.scene.gripper(), &self.blocked(object, &self.disc(object), 0.0))
    }

    /// The least distance from `object` at `disc` to another object, edge to edge, m; infinite if there is none.
    pub fn gap(&self, object: ObjectIndex, disc: &Disc) -> f64 {
        let others = self.scene.indices().filter(|&other| other != object && !self.is_lifted(other));
        others.map(|other| disc.gap(&self.disc(other))).fold(f64::INFINITY, f64::min)
    }
}

/// The distance from the centre of `disc` within which other objects can block its grasp, m.
fn reach(gripper: &Gripper, disc: &Disc) -> f64 {
    gripper.corner_distance(disc.radius) + gripper.margin()
}

/// The widest grasp of an object in the scene at the start.
pub fn grasp_in_place(scene: &Scene, object: ObjectIndex, model: Shadow) -> Option<Grasp> {
    let (gripper, disc) = (scene.gripper(), scene.object(object).disc());
    let others = scene.index().within(disc.centre, reach(gripper, &disc)).filter(|(other, _)| *other != object);
    let shadows: Vec<ArcSet> = others.map(|(_, other)| model(gripper, &disc, &other, 0.0)).collect();
    widest_grasp(gripper, &ArcSet::union(gripper.period(), &shadows))
}
