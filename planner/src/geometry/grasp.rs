//! A free yaw for a grasp or a release.

use super::arcs::{ArcSet, wrap};
use crate::scene::Gripper;

/// A free yaw with its slack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grasp {
    /// Direction of finger 0, rad, counter-clockwise from +x, in [0, 2π/k).
    pub yaw: f64,
    /// The free angle on each side of the yaw, rad; π/k where nothing blocks.
    pub slack: f64,
}

/// Rounding of an interval's width, rad. An interval that is wide enough for the knowledge base must be wide enough
/// here.
const ROUNDING: f64 = 1e-12;

/// The middle of the widest free interval, if it is at least [`Gripper::min_free_width`] wide.
pub fn widest_grasp(gripper: &Gripper, blocked: &ArcSet) -> Option<Grasp> {
    let widest = blocked.widest_free()?;
    if blocked.is_empty() {
        return Some(Grasp { yaw: 0.0, slack: widest.width / 2.0 });
    }
    (widest.width >= gripper.min_free_width() - ROUNDING)
        .then(|| Grasp { yaw: wrap(widest.start + widest.width / 2.0, gripper.period()), slack: widest.width / 2.0 })
}
