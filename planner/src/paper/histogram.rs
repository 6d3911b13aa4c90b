//! TG-MVFH+: the polar histogram round an object, and the local obstacle sets read off it. Eq. 1 to 4, 8 and 11, with
//! sectors of one degree (α = 1).

use super::angles::{finger_angle, obstacle_extent, radius};
use crate::budget::{Budget, Interrupted};
use crate::scene::{ObjectIndex, Scene, distance};

/// The side of a cell of the grid in which Eq. 1 measures distances, m. The paper gives no figure; whether a sector is
/// blocked does not depend on it.
const CELL: f64 = 0.005;

/// b of Eq. 8, per square cell. The paper leaves it open: Eq. 8 then gives a.
const B: f64 = 1.0;

/// The widening of each obstacle on both sides, rad. With it, a sector is free only if a wide enough interval round it
/// is free.
const ROUNDING: f64 = 1e-9;

/// One local obstacle in the histogram.
#[derive(Debug, Clone, Copy, PartialEq)]
struct LocalObstacle {
    object: ObjectIndex,
    /// c_i² (a − b d_i²) of Eq. 1, with c_i = 1: positive, the larger the nearer.
    magnitude: f64,
    /// β_i, degrees.
    bearing: f64,
    /// γ_total / 2, degrees.
    half: f64,
}

/// The histogram round each object, in index order; `None` for a fixed one.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub fn histograms(scene: &Scene, budget: &Budget<'_>) -> Result<Vec<Option<PolarHistogram>>, Interrupted> {
    let each = scene.indices().map(|object| {
        budget.check()?;
        Ok((!scene.object(object).fixed()).then(|| PolarHistogram::around(scene, object)))
    });
    each.collect()
}

/// The polar histogram round one object.
#[derive(Debug, Clone, PartialEq)]
pub struct PolarHistogram {
    fingers: u32,
    obstacles: Vec<LocalObstacle>,
}

impl PolarHistogram {
    /// The histogram round `object`, over all obstacles that reach into the ring which its fingers sweep. A yaw
    /// tolerance, which the paper doesn't have, widens each obstacle on both sides.
    pub fn around(scene: &Scene, object: ObjectIndex) -> Self {
        let (gripper, grasped) = (scene.gripper(), scene.object(object).footprint());
        let outer = radius(grasped) + gripper.clearance();
        let finger = finger_angle(gripper.finger_width(), radius(grasped));
        let mut near: Vec<_> = scene
            .index()
            .within(grasped.at(), outer + gripper.margin())
            .filter(|(other, _)| *other != object)
            .collect();
        near.sort_unstable_by_key(|(other, _)| *other);
        let cells = |length: f64| length / CELL;
        // Eq. 8: the window of w_s cells holds every local obstacle's centre, and Eq. 1 gives 1 at its border.
        let farthest = near.iter().map(|(_, disc)| distance(disc.at(), grasped.at())).fold(0.0, f64::max);
        let window = 2.0 * cells(farthest).ceil() + 1.0;
        let a = 1.0 + B * ((window - 1.0) / 2.0) * ((window - 1.0) / 2.0);
        let obstacles = near.into_iter().filter_map(|(other, disc)| {
            let apart = distance(disc.at(), grasped.at());
            let extent = obstacle_extent(outer, apart, radius(disc) + gripper.margin())?;
            let total = extent.angle + finger + 2.0 * gripper.yaw_tolerance().max(ROUNDING);
            let towards = disc.at() - grasped.at();
            Some(LocalObstacle {
                object: other,
                magnitude: a - B * cells(apart) * cells(apart),
                bearing: libm::atan2(towards.y, towards.x).to_degrees(),
                half: (total / 2.0).to_degrees(),
            })
        });
        Self { fingers: gripper.fingers(), obstacles: obstacles.collect() }
    }

    /// H(z) = Σ_i H_i(z) for z = 0, 1, … 359 degrees (Eq. 1, summed over the obstacles).
    pub fn h(&self) -> Vec<f64> {
        (0..360_u32).map(|z| self.obstacles.iter().map(|obstacle| obstacle.h(f64::from(z))).sum()).collect()
    }

    /// G(z) = Σ_i G_i(z) for z = 0, 1, … below θ_k degrees (Eq. 2 and 11). Where 360/k is no whole number, H is looked
    /// up between its sectors.
    pub fn g(&self) -> Vec<f64> {
        self.sectors().map(|z| self.obstacles.iter().map(|obstacle| obstacle.g(z, self.fingers)).sum()).collect()
    }

    /// S_j, the local obstacle sets of all sectors (Eq. 3 and 4), equal neighbours taken together.
    pub fn local_sets(&self) -> Vec<Vec<ObjectIndex>> {
        let set = |z| -> Vec<ObjectIndex> {
            let blocking = self.obstacles.iter().filter(|obstacle| obstacle.g(z, self.fingers) > 0.0);
            blocking.map(|obstacle| obstacle.object).collect()
        };
        let mut sets: Vec<_> = self.sectors().map(set).collect();
        sets.dedup();
        sets
    }

    /// z = 0, 1, … below θ_k.
    fn sectors(&self) -> impl Iterator<Item = f64> + use<> {
        let turn = 360.0 / f64::from(self.fingers);
        (0..360_u32).map(f64::from).take_while(move |z| *z < turn)
    }
}

impl LocalObstacle {
    /// Eq. 1, for any z in degrees.
    fn h(&self, z: f64) -> f64 {
        let off = (z - self.bearing).rem_euclid(360.0);
        if off.min(360.0 - off) <= self.half { self.magnitude } else { 0.0 }
    }

    /// Eq. 2.
    fn g(&self, z: f64, fingers: u32) -> f64 {
        let apart = 360.0 / f64::from(fingers);
        (0..fingers).map(|finger| self.h(z + f64::from(finger) * apart)).sum()
    }
}
