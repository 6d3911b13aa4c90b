//! A free way to grasp an object, or to let it go.

use core::f64::consts::TAU;

use nalgebra::Point2;

use super::arcs::{ArcSet, wrap};
use super::shadow::Shadow;
use crate::scene::{Grasps, Gripper, ListedGrasp, Placed};

/// A free yaw with its slack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grasp {
    /// The gripper's axis, m.
    pub axis: Point2<f64>,
    /// Direction of finger 0, rad, counter-clockwise from +x, in [0, 2π/k); of a listed grasp in [0, 2π).
    pub yaw: f64,
    /// The free angle on each side of the yaw, rad; π/k where nothing blocks.
    pub slack: f64,
}

/// The free ways to hold an object at one place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hold {
    /// An object that may be grasped at every yaw, at this one.
    AtYaw(Grasp),
    /// An object with listed grasps: a bit for each that is free, at least one.
    Listed(u64),
}

impl Hold {
    /// What is left of the grasps of an object that the hand can do. `None` if nothing is.
    pub fn free(gripper: &Gripper, placed: Placed<'_>, blocked: &Shadow) -> Option<Self> {
        match (placed.object.grasps(), blocked) {
            (Grasps::EveryYaw, Shadow::Yaws(blocked)) => {
                widest_grasp(gripper, placed.footprint.at(), blocked).map(Self::AtYaw)
            }
            (Grasps::Listed(list), Shadow::Grasps(blocked)) => {
                Some(Self::Listed(feasible(list) & !blocked)).filter(|hold| *hold != Self::Listed(0))
            }
            _ => None,
        }
    }

    /// The ways that two places of one object have in common. Where every yaw would do they need none.
    pub fn and(self, other: Self) -> Option<Self> {
        match (self, other) {
            (Self::Listed(one), Self::Listed(two)) => Some(Self::Listed(one & two)).filter(|_| one & two != 0),
            _ => Some(self),
        }
    }

    /// The grasp in the first of these ways.
    pub fn grasp(self, placed: Placed<'_>) -> Option<Grasp> {
        match self {
            Self::AtYaw(grasp) => Some(grasp),
            Self::Listed(ways) => {
                let list = placed.object.grasps().listed()?;
                Some(listed(placed, list.get(ways.trailing_zeros() as usize)?))
            }
        }
    }
}

/// A bit for each listed grasp that the hand can do.
fn feasible(list: &[ListedGrasp]) -> u64 {
    list.iter().enumerate().map(|(at, grasp)| u64::from(grasp.fits()) << at).fold(0, |all, one| all | one)
}

/// A listed grasp of an object that stands somewhere.
pub fn listed(placed: Placed<'_>, grasp: &ListedGrasp) -> Grasp {
    let pose = placed.footprint.pose();
    Grasp { axis: pose.point(grasp.at()), yaw: wrap(pose.yaw + grasp.yaw(), TAU), slack: grasp.band() }
}

/// Rounding of an interval's width, rad. An interval that is wide enough for the knowledge base must be wide enough
/// here.
const ROUNDING: f64 = 1e-12;

/// The middle of the widest free interval, if it is at least [`Gripper::min_free_width`] wide.
fn widest_grasp(gripper: &Gripper, axis: Point2<f64>, blocked: &ArcSet) -> Option<Grasp> {
    let widest = blocked.widest_free()?;
    if blocked.is_empty() {
        return Some(Grasp { axis, yaw: 0.0, slack: widest.width / 2.0 });
    }
    let yaw = wrap(widest.start + widest.width / 2.0, gripper.period());
    (widest.width >= gripper.min_free_width() - ROUNDING).then_some(Grasp { axis, yaw, slack: widest.width / 2.0 })
}
