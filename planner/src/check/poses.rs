//! Stated poses: whether they are places at all, and how far they are from real ones.

use crate::scene::{COORDINATE_RANGE, Grasps, ObjectIndex, Pose, Scene};
use crate::statement::StatedPose;

/// The largest yaw whose digits still resolve 1e-9 rad after reduction modulo whole turns.
pub(super) const MAX_YAW: f64 = 1e6;

/// True if doubles resolve the coordinates well enough, and the yaw if there is one. A plan outside this range is on no table.
pub(super) fn resolvable(pose: StatedPose) -> bool {
    let (min, max) = (10.0 * COORDINATE_RANGE.0, 10.0 * COORDINATE_RANGE.1);
    let yaw = pose.yaw.is_none_or(|yaw| yaw.abs() <= MAX_YAW);
    (min..=max).contains(&pose.at.x) && (min..=max).contains(&pose.at.y) && yaw
}

/// True if a stated pose says all of where the object is to stand.
pub(super) fn is_place(scene: &Scene, object: ObjectIndex, to: StatedPose) -> bool {
    resolvable(to) && (to.yaw.is_some() || at_every_yaw(scene, object))
}

/// True for an object whose own yaw is of no account.
pub(super) fn at_every_yaw(scene: &Scene, object: ObjectIndex) -> bool {
    *scene.object(object).grasps() == Grasps::EveryYaw
}

/// How far an object is from where it is said to stand, m.
pub(super) fn apart(a: Pose, b: StatedPose) -> f64 {
    (a.at - b.at).norm()
}
