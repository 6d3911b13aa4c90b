//! The checked scene: table, gripper, objects, target. The one vocabulary that every other room shares.
//!
//! A [`SceneDraft`] is what somebody said; a [`Scene`] is what holds: every number in its range, ids unique, centres on the
//! table, overlaps no deeper than perception noise, a movable target. There is no other way to make one.

mod draft;
mod fault;
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
pub use gripper::{Gripper, MIN_FREE_WIDTH};
pub use index::DiscIndex;
pub use limits::{
    COORDINATE_RANGE, FINGERS_RANGE, LENGTH_RANGE, MARGIN_RANGE, MAX_ID_LENGTH, SceneLimits, YAW_TOLERANCE_RANGE,
};
pub use object::{Disc, Object, ObjectIndex, distance};
pub use table::{Rectangle, Table};

/// A scene that holds. Cheap to clone.
#[derive(Debug, Clone)]
pub struct Scene {
    parts: Arc<Parts>,
    target: ObjectIndex,
}

/// All of a scene but its target.
#[derive(Debug)]
struct Parts {
    table: Table,
    gripper: Gripper,
    objects: Vec<Object>,
    index: DiscIndex,
}

impl Scene {
    /// Check a draft. On success also what is worth a warning.
    ///
    /// # Errors
    /// Every fault of the draft. The list is empty where the only faults are parts that were absent or unreadable: those
    /// have been told by whoever read the draft.
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

    /// The object that is wanted; never a fixed one.
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

    /// The objects at their first places, by nearness.
    pub fn index(&self) -> &DiscIndex {
        &self.parts.index
    }
}
