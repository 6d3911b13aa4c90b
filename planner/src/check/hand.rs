//! The hand over the table while it grasps an object: how high its fingertips are, and whether its palm meets an obstacle.

use nalgebra::Point2;

use crate::scene::{Gripper, Object, Palm};

use super::body::Body;
use super::leaning::Leaning;
use super::measure::away;

/// The hand at one object, whatever the grasp.
pub(super) struct Hand {
    /// How high the fingertips are over the table, m.
    tips: f64,
    palm: Option<Underside>,
}

/// The palm seen from below.
struct Underside {
    /// How high it is over the table, m.
    height: f64,
    /// How near to the gripper's axis a taller obstacle may come, m.
    keeps: f64,
}

/// Heights that differ by no more are equal, m. It is above the leaning, so that what is equal in decimals blocks in no claim.
const SAME_HEIGHT: f64 = 1.5e-9;

impl Hand {
    /// The hand that grasps `grasped`, or sets it down. Heights that rounding makes equal decide in favour of the claim.
    pub(super) fn at(grasped: &Object, gripper: &Gripper, leaning: Leaning) -> Self {
        let lowest = gripper.tip_height();
        let Some(Palm { finger_length, radius }) = gripper.palm() else {
            return Self { tips: leaning.back(lowest + SAME_HEIGHT), palm: None };
        };
        // Either the fingertips are as low as they may be, or the palm is down on the object.
        let top = grasped.height().unwrap_or(0.0);
        let (tips, height) = (lowest.max(top - finger_length), top.max(lowest + finger_length));
        let palm = Underside { height: leaning.back(height + SAME_HEIGHT), keeps: radius + gripper.margin() };
        Self { tips: leaning.back(tips + SAME_HEIGHT), palm: Some(palm) }
    }

    /// True if the fingers may meet the obstacle at all. One of unknown height may be as high as any.
    pub(super) fn fingers_reach(&self, obstacle: &Object) -> bool {
        obstacle.height().is_none_or(|height| height > self.tips)
    }

    /// How much too near to the palm an obstacle comes that stands as high, m; negative where it keeps away. One of unknown height
    /// is not held against the palm.
    pub(super) fn under_palm(&self, obstacle: &Object, body: &Body, axis: Point2<f64>) -> Option<f64> {
        let palm = self.palm.as_ref()?;
        let tall = obstacle.height().is_some_and(|height| height > palm.height);
        tall.then(|| palm.keeps - away(body, axis))
    }

    /// How far from the axis the palm can meet an obstacle, m.
    pub(super) fn span(&self) -> f64 {
        self.palm.as_ref().map_or(0.0, |palm| palm.keeps)
    }
}
