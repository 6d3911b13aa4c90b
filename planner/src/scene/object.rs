//! Objects on the table.

use super::flaw::Flaw;
use super::footprint::Footprint;
use super::gripper::Gripper;

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
    pub(super) too_wide: bool,
    pub(super) accepted: bool,
}

impl Object {
    /// The caller's name for it, unique in the scene.
    pub fn id(&self) -> &str {
        &self.id
    }

    /// The flaw of being too wide for the hand; none for an object that nobody grasps.
    pub(super) fn wider_than(&self, gripper: &Gripper) -> Option<Flaw> {
        let max_opening = gripper.max_opening().filter(|_| !self.fixed && !gripper.spans(&self.footprint))?;
        Some(Flaw::TooWide { id: self.id.clone(), width: 2.0 * self.footprint.circumradius(), max_opening })
    }

    /// Where it stands at the start.
    pub fn footprint(&self) -> Footprint {
        self.footprint
    }

    /// True if the caller calls it fixed.
    pub fn fixed(&self) -> bool {
        self.fixed
    }

    /// True if some drop-off accepts it.
    pub fn accepted(&self) -> bool {
        self.accepted
    }

    /// True if it is not fixed and fits between the open fingers.
    pub fn can_be_grasped(&self) -> bool {
        !self.fixed && !self.too_wide
    }
}
