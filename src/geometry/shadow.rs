//! The yaws at which one obstacle blocks the whole gripper.

use super::arcs::ArcSet;
use super::finger::{BlockedOffsets, SweptFinger};
use crate::scene::{Disc, Gripper, distance};

/// The shadow of `obstacle` on a grasp of `grasped`, when the fingers must stay the gripper's margin plus `extra` (m) away
/// from it. The k fingers are 2π/k apart, so modulo that period one finger's shadow is the gripper's.
pub fn shadow(gripper: &Gripper, grasped: &Disc, obstacle: &Disc, extra: f64) -> ArcSet {
    let period = gripper.period();
    let finger = SweptFinger {
        inner: grasped.radius,
        outer: grasped.radius + gripper.clearance(),
        half_width: gripper.finger_width() / 2.0,
    };
    let apart = distance(grasped.centre, obstacle.centre);
    match finger.blocked_offsets(apart, obstacle.radius + gripper.margin() + extra) {
        BlockedOffsets::Clear => ArcSet::empty(period),
        BlockedOffsets::Every => ArcSet::full(period),
        BlockedOffsets::Between { first, last } => {
            let towards = obstacle.centre - grasped.centre;
            let bearing = libm::atan2(towards.y, towards.x);
            if first > 0.0 {
                ArcSet::fold(period, &[(bearing - last, bearing - first), (bearing + first, bearing + last)])
            } else {
                ArcSet::fold(period, &[(bearing - last, bearing + last)])
            }
        }
    }
}
