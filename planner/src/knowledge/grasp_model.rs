//! Grasp models: which grasps an obstacle blocks, and the options that follow from it.

use super::options::{Blocker, minimal_options};
use crate::geometry::{Shadow, shadow};
use crate::scene::{Gripper, Object, ObjectIndex, Placed, Scene};

/// A model of grasping, for knowledge and placement. The checker uses only the swept finger and takes no model.
pub trait GraspModel: Sync {
    /// The grasps of `grasped` that `obstacle` blocks, when the gripper must stay its margin plus `extra` (m) away from it.
    /// Empty for obstacles beyond [`GraspModel::reach`].
    fn shadow(&self, gripper: &Gripper, grasped: Placed<'_>, obstacle: Placed<'_>, extra: f64) -> Shadow;

    /// The options of a movable object. At least one, since removing everything in reach always frees the object.
    fn options(&self, scene: &Scene, object: ObjectIndex) -> Vec<Vec<ObjectIndex>>;

    /// How near (m) to the origin of `grasped` an obstacle must come to block a grasp of it.
    fn reach(&self, gripper: &Gripper, grasped: &Object) -> f64 {
        grasped.reach(gripper)
    }
}

/// Our own model: an obstacle blocks exactly the grasps in which a finger, on its straight way down and when it closes, or the
/// palm meets it.
#[derive(Debug, Clone, Copy)]
pub struct SweptFinger;

impl GraspModel for SweptFinger {
    fn shadow(&self, gripper: &Gripper, grasped: Placed<'_>, obstacle: Placed<'_>, extra: f64) -> Shadow {
        shadow(gripper, grasped, obstacle, extra)
    }

    fn options(&self, scene: &Scene, object: ObjectIndex) -> Vec<Vec<ObjectIndex>> {
        minimal_options(scene.object(object), &blockers(scene, object, self), scene.gripper().min_free_width())
    }
}

/// The obstacles that block some grasp of `object`, each with its shadow, in index order.
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
    let grasped = scene.placed(object);
    let mut near: Vec<Blocker> = scene
        .index()
        .within(grasped.footprint.at(), model.reach(gripper, grasped.object))
        .filter(|(other, _)| *other != object && of_kind(*other))
        .map(|(other, footprint)| (other, Placed { object: scene.object(other), footprint }))
        .map(|(other, obstacle)| Blocker { object: other, shadow: model.shadow(gripper, grasped, obstacle, 0.0) })
        .filter(|blocker| !blocker.shadow.is_empty())
        .collect();
    near.sort_unstable_by_key(|blocker| blocker.object);
    near
}
