//! The draft of a scene: unchecked input.

use super::drop_off::{Destination, DropOffDraft};
use super::footprint::ShapeDraft;
use super::goal::GoalDraft;
use super::gripper::Opening;

/// An unchecked scene. `None` means that the part was absent or unreadable; the reader of the input reports that if the part is
/// required.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SceneDraft {
    /// The table.
    pub table: TableDraft,
    /// The gripper.
    pub gripper: GripperDraft,
    /// The objects, in the caller's order; unreadable ones keep their place.
    pub objects: Vec<ObjectDraft>,
    /// What is wanted.
    pub goal: Option<GoalDraft>,
    /// The drop-offs, in the caller's order; `None` if the caller named none.
    pub drop_offs: Option<Vec<DropOffDraft>>,
    /// Where objects go that have to move; `None` for the default.
    pub destination: Option<Destination>,
}

/// An unchecked rectangle, m.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct RectangleDraft {
    /// Left side.
    pub x_min: Option<f64>,
    /// Lower side.
    pub y_min: Option<f64>,
    /// Right side.
    pub x_max: Option<f64>,
    /// Upper side.
    pub y_max: Option<f64>,
}

/// An unchecked table.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TableDraft {
    /// The table top.
    pub top: RectangleDraft,
    /// Where nothing may be placed.
    pub keep_out: Vec<RectangleDraft>,
}

/// An unchecked gripper.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct GripperDraft {
    /// k.
    pub fingers: Option<f64>,
    /// w, m.
    pub finger_width: Option<f64>,
    /// c, m.
    pub clearance: Option<f64>,
    /// m. Default: 0.
    pub margin: Option<f64>,
    /// rad. Default: 0.
    pub yaw_tolerance: Option<f64>,
    /// m. Default: no limit.
    pub max_opening: Option<f64>,
    /// Default: [`Opening::Fit`].
    pub opening: Option<Opening>,
}

/// An unchecked object.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ObjectDraft {
    /// The caller's name for it.
    pub id: Option<String>,
    /// Centre, m.
    pub x: Option<f64>,
    /// Centre, m.
    pub y: Option<f64>,
    /// What it covers of the table.
    pub shape: ShapeDraft,
    /// True if it can't be moved.
    pub fixed: bool,
}
