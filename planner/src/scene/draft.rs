//! The draft of a scene: unchecked input.

use super::drop_off::{Destination, DropOffDraft};
use super::goal::GoalDraft;
use super::grasps::GraspDraft;
use super::gripper::Opening;
use super::shape_draft::ShapeDraft;

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
    /// m. Default: no palm.
    pub finger_length: Option<f64>,
    /// m. Default: no palm.
    pub palm_radius: Option<f64>,
    /// m. Default: 0.
    pub tip_height: Option<f64>,
}

/// An unchecked object.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ObjectDraft {
    /// The caller's name for it.
    pub id: Option<String>,
    /// The origin of its frame, m.
    pub x: Option<f64>,
    /// The origin of its frame, m.
    pub y: Option<f64>,
    /// How far its frame is turned, rad. Default: 0.
    pub yaw: Option<f64>,
    /// What it covers of the table.
    pub shape: ShapeDraft,
    /// How high it stands over the table, m; `None` if that is not known.
    pub height: Option<f64>,
    /// How it may be grasped; `None` for what goes with its shape.
    pub grasps: Option<Vec<GraspDraft>>,
    /// True if it can't be moved.
    pub fixed: bool,
}
