//! Grasp models: which yaws an obstacle blocks, and the options that follow from it.

use super::options::{Blocker, minimal_options};
use crate::geometry::{ArcSet, shadow};
use crate::scene::{Footprint, Gripper, ObjectIndex, Scene};

/// A model of grasping, for knowledge and placement. The checker uses only the swept finger and takes no model.
pub trait GraspModel: Sync {
    /// The yaws of a grasp of `grasped` that `obstacle` blocks, when the fingers must stay the gripper's margin plus
    /// `extra` (m) away from it. Empty for obstacles beyond [`GraspModel::reach`].
    fn shadow(&self, gripper: &Gripper, grasped: &Footprint, obstacle: &Footprint, extra: f64) -> ArcSet;

    /// The options of a movable object. At least one, since removing everything in reach always frees the object.
    fn options(&self, scene: &Scene, object: ObjectIndex) -> Vec<Vec<ObjectIndex>>;

    /// How near (m) to the origin of `grasped` an obstacle must come to block a grasp of it.
    fn reach(&self, gripper: &Gripper, grasped: &Footprint) -> f64 {
        gripper.reach(grasped)
    }
}

/// Our own model: an obstacle blocks exactly the yaws at which a finger, on its straight way down and when it closes, meets
/// it.
#[derive(Debug, Clone, Copy)]
pub struct SweptFinger;

impl GraspModel for SweptFinger {
    fn shadow(&self, gripper: &Gripper, grasped: &Footprint, obstacle: &Footprint, extra: f64) -> ArcSet {
        shadow(gripper, grasped, obstacle, extra)
    }

    fn options(&self, scene: &Scene, object: ObjectIndex) -> Vec<Vec<ObjectIndex>> {
        minimal_options(&blockers(scene, object, self), scene.gripper().min_free_width())
    }
}

/// The obstacles that block a grasp of `object` at some yaw, each with its shadow, in index order.
pub fn blockers(scene: &Scene, object: ObjectIndex, model: &dyn GraspModel) -> Vec<Blocker> {
    those_blocking(scene, object, model, |_| true)
}

/// The same, of those obstacles for which `of_kind` is true.
pub(super) fn those_blocking(
    scene: &Scene,
    object: ObjectIndex,
    model: &dyn GraspModel,
    of_kind: impl Fn(ObjectIndex) -> bool,
) -> Vec<Blocker> {
    let gripper = scene.gripper();
    let grasped = scene.object(object).footprint();
    let mut near: Vec<Blocker> = scene
        .index()
        .within(grasped.at(), model.reach(gripper, &grasped))
        .filter(|(other, _)| *other != object && of_kind(*other))
        .map(|(other, obstacle)| Blocker { object: other, shadow: model.shadow(gripper, &grasped, &obstacle, 0.0) })
        .filter(|blocker| !blocker.shadow.is_empty())
        .collect();
    near.sort_unstable_by_key(|blocker| blocker.object);
    near
}
