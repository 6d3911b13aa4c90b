//! What it takes to move an object while others stand: the one place that says which actions there are. Locks, landmarks and
//! derivations ask here, so that a proof never rests on one action where the robot has another.

use core::fmt;

use crate::scene::ObjectIndex;

use super::ring::Ring;
use super::rings::Rings;

/// A way to move an object.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Way {
    /// By pick-and-place, with the fingers at this yaw, rad.
    Picked {
        /// rad.
        yaw: f64,
    },
}

impl Way {
    /// How the way frees what is grasped in the end.
    pub(super) fn frees(self, what: &str) -> String {
        match self {
            Self::Picked { yaw } => format!("{what} is free at yaw {yaw:.9} rad"),
        }
    }
}

/// The way in which a candidate of the goal, whose ring this is, can be grasped in the end.
pub(super) fn grasp(rings: &Rings<'_>, ring: &Ring, stands: impl Fn(ObjectIndex) -> bool) -> Option<Way> {
    rings.free_yaw(ring, stands).map(|yaw| Way::Picked { yaw })
}

/// The way in which the object of the ring can be moved off its place, counting only obstacles for which `stands` is true.
pub(super) fn way(rings: &Rings<'_>, ring: &Ring, stands: impl Fn(ObjectIndex) -> bool) -> Option<Way> {
    rings.free_yaw(ring, stands).map(|yaw| Way::Picked { yaw })
}

impl fmt::Display for Way {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Picked { yaw } => write!(f, "can be grasped at yaw {yaw:.9} rad"),
        }
    }
}
