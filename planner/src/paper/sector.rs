//! The paper's grasp model: an obstacle blocks a sector of yaws.

use super::angles::{finger_angle, obstacle_extent, radius};
use super::histogram::PolarHistogram;
use crate::budget::{Budget, Interrupted};
use crate::geometry::{ArcSet, Shadow};
use crate::knowledge::GraspModel;
use crate::scene::{Footprint, Gripper, ObjectIndex, Placed, Scene, distance};

/// The paper's grasp model: Eq. 1-4 and 8-10.
#[derive(Debug, Clone, Copy)]
pub struct Sector;

impl GraspModel for Sector {
    /// Eq. 9 and 10, the margin plus `extra` added to the obstacle's radius. The paper has no margin; with a margin of 0 this
    /// is its formula.
    fn shadow(&self, gripper: &Gripper, grasped: Placed<'_>, obstacle: Placed<'_>, extra: f64) -> Shadow {
        Shadow::Yaws(self.sector(gripper, grasped.footprint, obstacle.footprint, extra))
    }

    /// The local obstacle sets, of which the base keeps the minimal ones.
    fn options(
        &self,
        scene: &Scene,
        object: ObjectIndex,
        _: &Budget<'_>,
    ) -> Result<Vec<Vec<ObjectIndex>>, Interrupted> {
        Ok(PolarHistogram::around(scene, object).local_sets())
    }
}

impl Sector {
    /// The yaws that an obstacle blocks, by Eq. 9 and 10.
    pub fn sector(self, gripper: &Gripper, grasped: &Footprint, obstacle: &Footprint, extra: f64) -> ArcSet {
        let (period, apart) = (gripper.period(), distance(grasped.at(), obstacle.at()));
        let grown = radius(obstacle) + gripper.margin() + extra;
        let Some(extent) = obstacle_extent(radius(grasped) + gripper.clearance(), apart, grown) else {
            return ArcSet::empty(period);
        };
        let total = extent.angle + finger_angle(gripper.finger_width(), radius(grasped));
        let towards = obstacle.at() - grasped.at();
        let bearing = libm::atan2(towards.y, towards.x);
        ArcSet::fold(period, &[(bearing - total / 2.0, bearing + total / 2.0)])
    }
}
