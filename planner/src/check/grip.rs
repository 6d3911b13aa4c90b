//! A gripper over a place: its axis, its fingers, and the band of yaws at which they must be free.

use nalgebra::{Point2, Vector2};
use smallvec::SmallVec;

use crate::scene::{Gripper, ListedGrasp, Opening, Shape};

use super::TOLERANCE;
use super::body::Body;
use super::finger::{Finger, wrap};
use super::leaning::Leaning;
use super::stop::Grasped;
use super::sweep::Sweep;

/// A listed grasp, with what the checker finds out about it, in the object's own frame.
pub(super) struct Hold {
    axis: Vector2<f64>,
    yaw: f64,
    band: f64,
    fingers: SmallVec<[Finger; 4]>,
    /// True if the hand does not open as wide.
    pub(super) too_wide: bool,
}

/// Fingers over a place on the table.
pub(super) struct Grip {
    /// The gripper's axis.
    pub(super) axis: Point2<f64>,
    /// The direction of finger 0, rad.
    pub(super) yaw: f64,
    /// How far the yaw may be off, rad.
    pub(super) band: f64,
    fingers: SmallVec<[Finger; 4]>,
    period: f64,
}

/// How far the real yaw of a listed grasp may be off, rad.
pub(super) fn band_of(grasp: &ListedGrasp, gripper: &Gripper) -> f64 {
    grasp.tolerance().max(gripper.yaw_tolerance())
}

/// True if the hand does not open wide enough for the grasp. Where that is a matter of rounding, it is as the claim needs it.
pub(super) fn is_too_wide(shape: &Shape, grasp: &ListedGrasp, gripper: &Gripper, leaning: Leaning) -> bool {
    let Some(opening) = gripper.max_opening() else { return false };
    let grasped = Grasped::new(shape, grasp.at());
    let exceeds = |width: f64| leaning.out(width) > opening / 2.0;
    exceeds(grasped.extent()) && exceeds(widest(&grasped, grasp, gripper, leaning))
}

/// How far from the axis a finger stops at most, m, in favour of the claim.
fn widest(grasped: &Grasped, grasp: &ListedGrasp, gripper: &Gripper, leaning: Leaning) -> f64 {
    let half = leaning.out(gripper.finger_width() / 2.0);
    let most = |finger| grasped.most((yaw_of(grasp, gripper, finger), band_of(grasp, gripper)), half);
    (0..gripper.fingers()).map(most).fold(0.0, f64::max)
}

/// The direction of a finger in the object's own frame, rad.
fn yaw_of(grasp: &ListedGrasp, gripper: &Gripper, finger: u32) -> f64 {
    grasp.yaw() + f64::from(finger) * gripper.period()
}

impl Hold {
    /// Finds out how far the fingers close and open, in favour of the claim.
    pub(super) fn new(shape: &Shape, grasp: &ListedGrasp, gripper: &Gripper, leaning: Leaning) -> Self {
        let grasped = Grasped::new(shape, grasp.at());
        let widest = widest(&grasped, grasp, gripper, leaning);
        let open = match (gripper.opening(), gripper.max_opening()) {
            (Opening::Full, Some(opening)) => opening / 2.0,
            _ => widest,
        };
        let (outer, half) = (open + gripper.clearance(), gripper.finger_width() / 2.0);
        let (band, strip) = (band_of(grasp, gripper), leaning.back(half));
        let turns = grasped.turns(strip);
        let finger = |finger| {
            let inner = grasped.least((yaw_of(grasp, gripper, finger), band), strip, &turns);
            // Where only leaning lets the finger stop farther out than it opens, there is nothing to close.
            Finger { inner: inner.min(outer), outer, half }
        };
        let too_wide = gripper.max_opening().is_some_and(|opening| leaning.out(widest) > opening / 2.0);
        let fingers = (0..gripper.fingers()).map(finger).collect();
        Self { axis: grasp.at(), yaw: grasp.yaw(), band, fingers, too_wide }
    }

    /// The grasp of an object where it stands.
    pub(super) fn of(self, body: &Body, gripper: &Gripper) -> Grip {
        let Self { axis, yaw, band, fingers, .. } = self;
        let (axis, yaw) = (body.point(axis), body.pose.yaw + yaw);
        Grip { axis, yaw, band, fingers, period: gripper.period() }
    }
}

impl Grip {
    /// A grasp of a disc over its centre.
    pub(super) fn centred(disc: &Body, gripper: &Gripper, (yaw, band): (f64, f64)) -> Self {
        let finger = Finger::new(gripper, disc);
        let fingers = (0..gripper.fingers()).map(|_| finger).collect();
        Self { axis: disc.pose.at, yaw, band, fingers, period: gripper.period() }
    }

    /// From the axis to the fingers' farthest corners, m.
    pub(super) fn span(&self) -> f64 {
        self.fingers.iter().map(Finger::corner_distance).fold(0.0, f64::max)
    }

    /// True if a finger comes nearer than `rho` to the obstacle's core at some yaw of the band.
    pub(super) fn comes_near(&self, obstacle: &Body, rho: f64) -> bool {
        if obstacle.is_disc() {
            return self.closest(obstacle) < rho;
        }
        self.sweeps(obstacle).any(|mut sweep| sweep.comes_near(2.0 * self.band, rho))
    }

    /// How much nearer than the margin an obstacle comes to the fingers, m, if that is more than rounding.
    pub(super) fn depth(&self, obstacle: &Body, margin: f64) -> Option<f64> {
        let rho = obstacle.radius + margin;
        if obstacle.is_disc() {
            return Some(rho - self.closest(obstacle)).filter(|depth| *depth > TOLERANCE);
        }
        self.comes_near(obstacle, rho - TOLERANCE).then(|| {
            let nearest = self.sweeps(obstacle).map(|mut sweep| sweep.nearest(2.0 * self.band));
            (rho - nearest.fold(f64::INFINITY, f64::min)).max(TOLERANCE)
        })
    }

    /// The least distance from a finger to the centre of a disc, m.
    fn closest(&self, disc: &Body) -> f64 {
        let apart = disc.pose.at - self.axis;
        let (distance, bearing) = (apart.norm(), libm::atan2(apart.y, apart.x));
        let closest = |(at, finger): (u32, &Finger)| {
            let offset = wrap(bearing - self.yaw - f64::from(at) * self.period);
            finger.closest(distance, offset, self.band)
        };
        (0..).zip(&self.fingers).map(closest).fold(f64::INFINITY, f64::min)
    }

    /// Each finger from the begin of the band on.
    fn sweeps<'a>(&'a self, obstacle: &'a Body) -> impl Iterator<Item = Sweep<'a>> + 'a {
        (0..).zip(&self.fingers).map(|(at, finger)| {
            let begin = self.yaw + f64::from(at) * self.period - self.band;
            Sweep::new(finger, self.axis, begin, obstacle)
        })
    }
}
