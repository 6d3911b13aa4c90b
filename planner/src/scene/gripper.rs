//! The overhead gripper.

use core::f64::consts::TAU;

use super::footprint::Footprint;

/// A checked gripper with k fingers, evenly spaced round the object that it grasps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gripper {
    pub(super) fingers: u32,
    pub(super) finger_width: f64,
    pub(super) clearance: f64,
    pub(super) margin: f64,
    pub(super) yaw_tolerance: f64,
    pub(super) max_opening: Option<f64>,
    pub(super) opening: Opening,
    pub(super) palm: Option<Palm>,
    pub(super) tip_height: f64,
}

/// What the fingers hang from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Palm {
    /// How far it is above the fingertips, m.
    pub finger_length: f64,
    /// The radius of a disc round the gripper's axis that covers it, m.
    pub radius: f64,
}

/// How far the fingers open before a grasp, and after a release.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Opening {
    /// To the clearance beyond the object's edge: a hand with driven fingers.
    #[default]
    Fit,
    /// All the way, whatever the object: a hand that is either open or closed.
    Full,
}

/// The least width of a free interval of yaws, rad: far above the rounding of an interval's end, far below the
/// resolution of any arm.
pub const MIN_FREE_WIDTH: f64 = 1e-9;

impl Gripper {
    /// k, from 2 to 12.
    pub fn fingers(&self) -> u32 {
        self.fingers
    }

    /// w, the width of a finger across its radial direction, m.
    pub fn finger_width(&self) -> f64 {
        self.finger_width
    }

    /// c, how far beyond the object's edge an open finger reaches, m (the paper's r_g).
    pub fn clearance(&self) -> f64 {
        self.clearance
    }

    /// Extra gap between fingers and obstacles, and between a new place and other objects, m.
    pub fn margin(&self) -> f64 {
        self.margin
    }

    /// The largest error between the planned and the real yaw, rad.
    pub fn yaw_tolerance(&self) -> f64 {
        self.yaw_tolerance
    }

    /// The distance between the inner faces of two open jaws, m; for more fingers twice their distance from the axis. `None` if
    /// no object is too wide.
    pub fn max_opening(&self) -> Option<f64> {
        self.max_opening
    }

    /// How far the fingers open.
    pub fn opening(&self) -> Opening {
        self.opening
    }

    /// The palm; `None` if nothing is said of it, and so nothing can meet it.
    pub fn palm(&self) -> Option<Palm> {
        self.palm
    }

    /// How high over the table the fingertips are where the object's height does not say more, m.
    pub fn tip_height(&self) -> f64 {
        self.tip_height
    }

    /// True if a disc fits between the open fingers.
    pub(super) fn spans(&self, grasped: &Footprint) -> bool {
        self.max_opening.is_none_or(|opening| grasped.circumradius() <= opening / 2.0)
    }

    /// R, the distance of the open fingers' outer edges from the origin of a disc, m.
    pub fn outer_distance(&self, grasped: &Footprint) -> f64 {
        let inner = match (self.opening, self.max_opening) {
            (Opening::Full, Some(opening)) => opening / 2.0,
            _ => grasped.circumradius(),
        };
        inner + self.clearance
    }

    /// 2π/k: a turn by this angle gives the same grasp.
    pub fn period(&self) -> f64 {
        TAU / f64::from(self.fingers)
    }

    /// The least width of a free interval, rad: the band of the yaw tolerance.
    pub fn min_free_width(&self) -> f64 {
        (2.0 * self.yaw_tolerance).max(MIN_FREE_WIDTH)
    }

    /// The greatest distance of the open fingers' outer corners from the origin of a disc, m.
    pub fn corner_distance(&self, grasped: &Footprint) -> f64 {
        self.corner(self.outer_distance(grasped))
    }

    /// The distance from the gripper's axis to the outer corners of fingers that reach to `outer`, m.
    pub fn corner(&self, outer: f64) -> f64 {
        let half = self.finger_width / 2.0;
        (outer * outer + half * half).sqrt()
    }
}
