//! From the ids of a stated answer to objects.

use std::collections::HashMap;

use crate::scene::{ObjectIndex, Scene};

use super::fault::{FaultCode, Faults};

/// The objects of a scene by id: an answer may hold a million ids, and a scan for each would be quadratic.
pub(super) struct ObjectNames<'s>(HashMap<&'s str, ObjectIndex>);

impl<'s> ObjectNames<'s> {
    pub(super) fn new(scene: &'s Scene) -> Self {
        Self(scene.indices().map(|object| (scene.object(object).id(), object)).collect())
    }

    pub(super) fn find(&self, id: &str) -> Option<ObjectIndex> {
        self.0.get(id).copied()
    }

    /// The object, or a fault.
    pub(super) fn known(&self, id: &str, step: Option<usize>, faults: &mut Faults) -> Option<ObjectIndex> {
        let found = self.find(id);
        if found.is_none() {
            faults.add(FaultCode::UnknownObject, step, Some(id), || format!("there is no object '{id}'"));
        }
        found
    }
}
