//! Objects on the table.

use super::footprint::Footprint;

/// The position of an object in its scene's list. The planner names objects only by it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ObjectIndex(u32);

impl ObjectIndex {
    /// The object at `position` of a list that has fewer than 2³² entries.
    pub fn new(position: usize) -> Self {
        Self(u32::try_from(position).expect("a scene holds fewer than 2^32 objects"))
    }

    /// The position in the list.
    pub fn get(self) -> usize {
        self.0 as usize
    }
}

/// An object of a checked scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Object {
    pub(super) id: String,
    pub(super) footprint: Footprint,
    pub(super) fixed: bool,
}

impl Object {
    /// The caller's name for it, unique in the scene.
    pub fn id(&self) -> &str {
        &self.id
    }

    /// Where it stands at the start.
    pub fn footprint(&self) -> Footprint {
        self.footprint
    }

    /// True if it can't be moved.
    pub fn fixed(&self) -> bool {
        self.fixed
    }
}
