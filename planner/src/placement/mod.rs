//! Where objects go that are moved: to another place on the table, or to a drop-off.
//!
//! A place must be on the table, outside keep-outs, apart from every other object, with a free release yaw, and must
//! leave every grasp still to come a free yaw. Candidates come from the continuum: where border curves of the free
//! space meet.

mod arrange;
mod arranger;
mod borders;
mod candidates;
mod curves;
mod drop_offs;
mod effort;
mod layout;
mod orientations;
mod scatter;
mod tabletop;
mod task;

pub use arrange::arrange;
pub use drop_offs::DropOffs;
pub use effort::Effort;
pub use layout::{Layout, grasp_in_place, grasp_without};
pub use task::{Arrangement, Drops, Task};

use crate::geometry::Grasp;
use crate::scene::{ObjectIndex, Pose};

/// Which of the free places a relocated object goes to.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Objective {
    /// As far from the target as possible (the paper's).
    #[default]
    FarFromTarget,
    /// As near to its old place as possible.
    ShortMoves,
}

impl Objective {
    /// The other objective.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::FarFromTarget => Self::ShortMoves,
            Self::ShortMoves => Self::FarFromTarget,
        }
    }
}

/// One step of an arrangement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Move {
    /// To another place on the table.
    Place(Relocation),
    /// To a drop-off.
    Drop(Removal),
}

impl Move {
    /// The object that is moved.
    pub fn object(&self) -> ObjectIndex {
        match self {
            Self::Place(step) => step.object,
            Self::Drop(step) => step.object,
        }
    }
}

/// One pick-and-drop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Removal {
    /// The object that is taken away; never a candidate of the goal, never a fixed object.
    pub object: ObjectIndex,
    /// Where it stood.
    pub from: Pose,
    /// The grasp there.
    pub grasp: Grasp,
    /// The position of the drop-off in the scene's list.
    pub drop_off: usize,
}

/// One pick-and-place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Relocation {
    /// The object that is moved; never a candidate of the goal, never a fixed object.
    pub object: ObjectIndex,
    /// Where it stood.
    pub from: Pose,
    /// Where it is put.
    pub to: Pose,
    /// The grasp at the old place.
    pub grasp: Grasp,
    /// The release at the new place.
    pub release: Grasp,
    /// Least distance to another object at the new place, edge to edge, m.
    pub gap: f64,
}

/// The planner's distance from every bound, m: a thousand times the checker's tolerance.
pub const INSIDE: f64 = 1e-6;

/// The gaps between a place and other objects, and the table's edge, that are tried in turn, beyond the margin, m.
const GAPS: [f64; 2] = [5e-3, 0.0];

/// The same where a plan is known that has less room than the first of [`GAPS`]. An arm can't set down dishes in contact:
/// carried out in physics, places with 1 µm of room made dishes meet. The steps cost effort, so they are not for finding a plan.
const ROOMIER_GAPS: [f64; 6] = [5e-3, 3e-3, 2e-3, 1e-3, 5e-4, 0.0];
