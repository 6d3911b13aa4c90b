//! The checked scene: table, gripper, objects, target. All other rooms use these types.
//!
//! A [`SceneDraft`] is unchecked input. A [`Scene`] is valid: every number is in its range, ids are unique, centres are
//! on the table, overlaps are no deeper than perception noise, and the target is movable. [`Scene::new`] is the only
//! way to make one.

mod draft;
mod fault;
mod footprint;
mod gripper;
mod index;
mod limits;
mod object;
mod relations;
#[cfg(test)]
pub(crate) mod scenes;
mod slips;
mod table;
mod validate;

use std::sync::Arc;

pub use draft::{GripperDraft, ObjectDraft, RectangleDraft, SceneDraft, TableDraft};
pub use fault::{Finding, Flaw, Likely, MAX_FINDINGS, Place, Yardstick};
pub use footprint::{Footprint, Pose, Shape, ShapeDraft, distance};
pub use gripper::{Gripper, MIN_FREE_WIDTH};
pub use index::FootprintIndex;
pub use limits::{
    COORDINATE_RANGE, FINGERS_RANGE, LENGTH_RANGE, MARGIN_RANGE, MAX_ID_LENGTH, SceneLimits, YAW_TOLERANCE_RANGE,
};
pub use object::{Object, ObjectIndex};
pub use table::{Rectangle, Table};

/// A valid scene. Cheap to clone.
#[derive(Debug, Clone)]
pub struct Scene {
    parts: Arc<Parts>,
    target: ObjectIndex,
}

/// The scene without its target.
#[derive(Debug)]
struct Parts {
    table: Table,
    gripper: Gripper,
    objects: Vec<Object>,
    index: FootprintIndex,
}

impl Scene {
    /// Checks a draft. On success the second value lists the warnings.
    ///
    /// # Errors
    /// Every fault of the draft. The list is empty where the only faults are absent or unreadable parts, which the reader of
    /// the draft reports.
    pub fn new(draft: SceneDraft, limits: &SceneLimits) -> Result<(Self, Vec<Finding>), Vec<Finding>> {
        validate::validate(draft, limits)
    }

    /// The table.
    pub fn table(&self) -> &Table {
        &self.parts.table
    }

    /// The gripper.
    pub fn gripper(&self) -> &Gripper {
        &self.parts.gripper
    }

    /// All objects, in the caller's order.
    pub fn objects(&self) -> &[Object] {
        &self.parts.objects
    }

    /// One object.
    pub fn object(&self, index: ObjectIndex) -> &Object {
        &self.parts.objects[index.get()]
    }

    /// Every object's index, in order.
    pub fn indices(&self) -> impl Iterator<Item = ObjectIndex> + use<> {
        (0..self.parts.objects.len()).map(ObjectIndex::new)
    }

    /// The object to be grasped; never a fixed one.
    pub fn target(&self) -> ObjectIndex {
        self.target
    }

    /// The same scene with another target. `None` if that one is fixed.
    pub fn with_target(&self, target: ObjectIndex) -> Option<Self> {
        (!self.object(target).fixed).then(|| Self { parts: Arc::clone(&self.parts), target })
    }

    /// The object with this id.
    pub fn find(&self, id: &str) -> Option<ObjectIndex> {
        self.parts.objects.iter().position(|object| object.id == id).map(ObjectIndex::new)
    }

    /// The spatial index of the objects at the start.
    pub fn index(&self) -> &FootprintIndex {
        &self.parts.index
    }
}
