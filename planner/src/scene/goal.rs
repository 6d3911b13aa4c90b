//! What is wanted of the table.

use super::object::ObjectIndex;

/// The goal of a scene. Its objects can all be grasped; lists are not empty and in index order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Goal {
    /// This object is grasped in the end.
    Target(ObjectIndex),
    /// One of these is grasped in the end, whichever takes the fewest steps. Members that no hand can grasp are left out.
    AnyOf(Vec<ObjectIndex>),
    /// Each of these is taken away to a drop-off.
    AllOf(Vec<ObjectIndex>),
    /// All that can go is taken away to drop-offs.
    Clear,
}

/// An unchecked goal. `None` in a list stands for an id that could not be read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum GoalDraft {
    /// The id of the one object that is wanted.
    Target(String),
    /// Ids of objects of which one is wanted.
    AnyOf(Vec<Option<String>>),
    /// Ids of objects that are all wanted.
    AllOf(Vec<Option<String>>),
    /// Everything is to be taken away.
    Clear,
}

impl Goal {
    /// The object that is grasped in the end, if there is only one choice by the kind of goal.
    pub fn target(&self) -> Option<ObjectIndex> {
        match self {
            Self::Target(target) => Some(*target),
            _ => None,
        }
    }

    /// The objects of which one is grasped in the end, and which no plan moves before; none where nothing is grasped to be
    /// held.
    pub fn candidates(&self) -> &[ObjectIndex] {
        match self {
            Self::Target(target) => core::slice::from_ref(target),
            Self::AnyOf(candidates) => candidates,
            Self::AllOf(_) | Self::Clear => &[],
        }
    }

    /// The objects that must all be taken away.
    pub fn wanted_away(&self) -> &[ObjectIndex] {
        match self {
            Self::AllOf(wanted) => wanted,
            _ => &[],
        }
    }

    /// True if the object is one of [`Goal::candidates`].
    pub fn is_candidate(&self, object: ObjectIndex) -> bool {
        self.candidates().binary_search(&object).is_ok()
    }

    /// True if the object is one of [`Goal::wanted_away`].
    pub fn wants_away(&self, object: ObjectIndex) -> bool {
        self.wanted_away().binary_search(&object).is_ok()
    }

    /// The objects that the goal names.
    pub fn named(&self) -> &[ObjectIndex] {
        match self {
            Self::AllOf(wanted) => wanted,
            _ => self.candidates(),
        }
    }
}
