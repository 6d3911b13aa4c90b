//! Grasp models: which grasps an obstacle blocks, and the options that follow from it.

use super::options::{Blocker, minimal_options};
use crate::budget::{Budget, Interrupted, Ticker};
use crate::geometry::{Shadow, shadow};
use crate::scene::{Gripper, Object, ObjectIndex, Placed, Scene};

/// Grasps times corners between two looks at the budget, some 0.1 ms.
const BEAT: usize = 512;

/// A model of grasping, for knowledge and placement. The checker uses only the swept finger and takes no model.
pub trait GraspModel: Sync {
    /// The grasps of `grasped` that `obstacle` blocks, when the gripper must stay its margin plus `extra` (m) away from it.
    /// Empty for obstacles beyond [`GraspModel::reach`].
    fn shadow(&self, gripper: &Gripper, grasped: Placed<'_>, obstacle: Placed<'_>, extra: f64) -> Shadow;

    /// The options of a movable object. At least one, since removing everything in reach always frees the object.
    ///
    /// # Errors
    /// [`Interrupted`] when the budget ends.
    fn options(
        &self,
        scene: &Scene,
        object: ObjectIndex,
        budget: &Budget<'_>,
    ) -> Result<Vec<Vec<ObjectIndex>>, Interrupted>;

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

    fn options(
        &self,
        scene: &Scene,
        object: ObjectIndex,
        budget: &Budget<'_>,
    ) -> Result<Vec<Vec<ObjectIndex>>, Interrupted> {
        let blockers = blockers(scene, object, self, budget)?;
        Ok(minimal_options(scene.object(object), &blockers, scene.gripper().min_free_width()))
    }
}

/// The obstacles that block some grasp of `object`, each with its shadow, in index order.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub fn blockers(
    scene: &Scene,
    object: ObjectIndex,
    model: &dyn GraspModel,
    budget: &Budget<'_>,
) -> Result<Vec<Blocker>, Interrupted> {
    those_blocking(scene, object, model, |_| true, budget)
}

/// The same, of those obstacles for which `of_kind` is true.
pub(super) fn those_blocking(
    scene: &Scene,
    object: ObjectIndex,
    model: &dyn GraspModel,
    of_kind: impl Fn(ObjectIndex) -> bool,
    budget: &Budget<'_>,
) -> Result<Vec<Blocker>, Interrupted> {
    let gripper = scene.gripper();
    let grasped = scene.placed(object);
    let ways = grasped.object.grasps().listed().map_or(1, <[_]>::len);
    let (mut near, mut ticker) = (Vec::new(), Ticker::every(BEAT, budget));
    for (other, footprint) in scene.index().within(grasped.footprint.at(), model.reach(gripper, grasped.object)) {
        if other == object || !of_kind(other) {
            continue;
        }
        // A few discs take no time worth a look.
        if let Some(core) = footprint.core() {
            ticker.step(ways * core.vertices().len())?;
        }
        let obstacle = Placed { object: scene.object(other), footprint };
        let shadow = model.shadow(gripper, grasped, obstacle, 0.0);
        if !shadow.is_empty() {
            near.push(Blocker { object: other, shadow });
        }
    }
    near.sort_unstable_by_key(|blocker| blocker.object);
    Ok(near)
}
