//! Which of an object's grasps is stated, and how far the hand reaches in it.

use singulate_planner::scene::{Footprint, Grasps, Gripper, ListedGrasp, Object};
use singulate_planner::statement::StatedGrasp;

/// Two places or yaws nearer than this are one, m and rad.
const SAME: f64 = 1e-6;

/// How far the open fingers and the palm reach from the gripper's axis, m.
pub(super) fn reach(object: &Object, place: &Footprint, grasp: StatedGrasp, gripper: &Gripper) -> f64 {
    let fingers = listed(object, place, grasp, gripper);
    let fingers = fingers.map_or_else(|| gripper.corner_distance(place), ListedGrasp::corner_distance);
    gripper.palm().map_or(fingers, |palm| fingers.max(palm.radius))
}

/// The listed grasp that is stated.
pub(super) fn listed<'a>(
    object: &'a Object,
    place: &Footprint,
    grasp: StatedGrasp,
    gripper: &Gripper,
) -> Option<&'a ListedGrasp> {
    let Grasps::Listed(list) = object.grasps() else { return None };
    let (pose, axis) = (place.pose(), grasp.at.unwrap_or(place.at()));
    let is = |listed: &&ListedGrasp| {
        let apart = pose.point(listed.at()) - axis;
        let turns = (pose.yaw + listed.yaw() - grasp.yaw) / gripper.period();
        apart.norm() < SAME && (turns - turns.round()).abs() < SAME
    };
    list.iter().find(is)
}
