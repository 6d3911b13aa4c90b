//! The checked scene: table, gripper, objects, drop-offs, goal. All other rooms use these types.
//!
//! A [`SceneDraft`] is unchecked input. A [`Scene`] is valid: every number is in its range, ids are unique, centres are
//! on the table, overlaps are no deeper than perception noise, and what the goal names can be grasped. [`Scene::new`] is the only
//! way to make one.

mod closing;
mod convex;
mod draft;
mod drop_off;
mod fault;
mod flaw;
mod footprint;
mod goal;
mod grasps;
mod gripper;
mod index;
mod likely;
mod limits;
mod object;
mod relations;
#[cfg(test)]
pub(crate) mod scenes;
mod shape;
mod shape_draft;
mod slips;
mod table;
mod validate;
mod wanted;

use std::sync::Arc;

pub use convex::{Axis, Core, direction, length, turned};
pub use draft::{GripperDraft, ObjectDraft, RectangleDraft, SceneDraft, TableDraft};
pub use drop_off::{Destination, DropOff, DropOffDraft};
pub use fault::{Finding, MAX_FINDINGS, Place};
pub use flaw::Flaw;
pub use footprint::{Footprint, Pose, distance};
pub use goal::{Goal, GoalDraft};
pub use grasps::{DEFAULT_TOLERANCE, GraspDraft, Grasps, ListedGrasp};
pub use gripper::{Gripper, MIN_FREE_WIDTH, Opening, Palm};
pub use index::FootprintIndex;
pub use likely::{Lack, Likely, Yardstick};
pub use limits::{
    CAPACITY_RANGE, COORDINATE_RANGE, FINGERS_RANGE, GRASP_OFFSET_RANGE, LENGTH_RANGE, MARGIN_RANGE, MAX_CLOSING_WORK,
    MAX_DROP_OFFS, MAX_GRASPS, MAX_ID_LENGTH, MAX_POINTS, POINT_RANGE, SceneLimits, TIP_HEIGHT_RANGE, YAW_RANGE,
    YAW_TOLERANCE_RANGE,
};
pub use object::{Object, ObjectIndex, Placed};
pub use shape::{Kind, Shape};
pub use shape_draft::ShapeDraft;
pub use table::{Rectangle, Table};

/// A valid scene. Cheap to clone.
#[derive(Debug, Clone)]
pub struct Scene {
    parts: Arc<Parts>,
    goal: Arc<Goal>,
}

/// The scene without its goal.
#[derive(Debug)]
struct Parts {
    table: Table,
    gripper: Gripper,
    objects: Vec<Object>,
    index: FootprintIndex,
    drop_offs: Vec<DropOff>,
    destination: Destination,
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

    /// One object where it stands at the start.
    pub fn placed(&self, index: ObjectIndex) -> Placed<'_> {
        let object = self.object(index);
        Placed { object, footprint: object.footprint() }
    }

    /// Every object's index, in order.
    pub fn indices(&self) -> impl Iterator<Item = ObjectIndex> + use<> {
        (0..self.parts.objects.len()).map(ObjectIndex::new)
    }

    /// What is wanted.
    pub fn goal(&self) -> &Goal {
        &self.goal
    }

    /// The one object to be grasped; `None` for another kind of goal.
    pub fn target(&self) -> Option<ObjectIndex> {
        self.goal.target()
    }

    /// The same scene with another goal: to grasp this object. `None` if it can't be grasped.
    pub fn with_target(&self, target: ObjectIndex) -> Option<Self> {
        let goal = Arc::new(Goal::Target(target));
        self.object(target).can_be_grasped().then(|| Self { parts: Arc::clone(&self.parts), goal })
    }

    /// The same scene without a goal, for questions about every object.
    #[must_use]
    pub fn without_goal(&self) -> Self {
        Self { parts: Arc::clone(&self.parts), goal: Arc::new(Goal::AnyOf(Vec::new())) }
    }

    /// The drop-offs, in the caller's order.
    pub fn drop_offs(&self) -> &[DropOff] {
        &self.parts.drop_offs
    }

    /// Where objects go that have to move.
    pub fn destination(&self) -> Destination {
        self.parts.destination
    }

    /// True if what is moved leaves the table in any case.
    pub fn only_drops(&self) -> bool {
        *self.goal == Goal::Clear || self.parts.destination == Destination::DropOff
    }

    /// True if a plan may move the object, the goal's own candidates apart. All others are as if fixed: those that are, those that the
    /// hand can't grasp, and where what is moved leaves the table, those that no drop-off accepts.
    pub fn movable(&self, object: ObjectIndex) -> bool {
        let object = self.object(object);
        object.can_be_grasped() && (object.accepted || !self.only_drops())
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
