//! From the ids of a stated answer to objects.

use std::collections::HashMap;

use crate::scene::{ObjectIndex, Scene};

use super::fault::{FaultCode, Faults};

/// The objects of a scene by id: an answer may hold a million ids, and a scan for each would be quadratic.
pub(super) struct Names<'a> {
    scene: &'a Scene,
    by_id: HashMap<&'a str, ObjectIndex>,
}

impl<'a> Names<'a> {
    pub(super) fn new(scene: &'a Scene) -> Self {
        let by_id = scene.indices().map(|object| (scene.object(object).id(), object)).collect();
        Self { scene, by_id }
    }

    pub(super) fn find(&self, id: &str) -> Option<ObjectIndex> {
        self.by_id.get(id).copied()
    }

    /// The object, or a fault.
    pub(super) fn known(&self, id: &str, step: Option<usize>, faults: &mut Faults) -> Option<ObjectIndex> {
        let found = self.find(id);
        if found.is_none() {
            faults.add(FaultCode::UnknownObject, step, Some(id), || format!("there is no object '{id}'"));
        }
        found
    }

    /// True for what a plan may move: neither fixed nor the target.
    pub(super) fn relocatable(&self, object: ObjectIndex) -> bool {
        object != self.scene.target() && !self.scene.object(object).fixed()
    }
}
