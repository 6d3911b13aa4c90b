//! The role of each object in the answer.

use std::collections::HashMap;

use super::stays::{Stays, immovable, left};
use singulate_planner::scene::{Object, ObjectIndex, Scene};
use singulate_planner::statement::{Statement, Step};

/// An object's role.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// Stays where it is.
    Bystander,
    /// Is moved: drawn by its moves.
    Moved,
    /// Would have to be moved.
    Needed,
    /// In the lock's core.
    Core,
    /// In the greatest lock, outside of the core.
    Blocked,
    /// Can't be moved, whatever the plan, or is left by a clearing.
    Stays(Stays),
}

/// What the goal says of an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mark {
    /// Nothing.
    Unnamed,
    /// It is the target, or a candidate where none is chosen, or one of those that are wanted away.
    Wanted,
    /// A candidate where another one is chosen.
    Candidate,
}

/// Every object's role, and the objects by their ids: a lock may name thousands.
#[derive(Debug)]
pub(super) struct Roles<'a> {
    scene: &'a Scene,
    by_id: HashMap<&'a str, ObjectIndex>,
    roles: Vec<Role>,
    /// The candidate that the answer chose.
    chosen: Option<ObjectIndex>,
}

impl<'a> Roles<'a> {
    pub(super) fn new(scene: &'a Scene, stated: &Statement) -> Self {
        let by_id: HashMap<&str, ObjectIndex> =
            scene.indices().map(|object| (scene.object(object).id(), object)).collect();
        let standing = |object| immovable(scene, object).map_or(Role::Bystander, Role::Stays);
        let chosen = stated.target.as_deref().and_then(|id| by_id.get(id).copied());
        let mut roles = Self { scene, by_id, roles: scene.indices().map(standing).collect(), chosen };
        roles.give(Role::Moved, stated.steps().iter().map(Step::object));
        for (why, objects) in left(scene, stated) {
            objects.iter().for_each(|object| roles.roles[object.get()] = Role::Stays(why));
        }
        if let Some(lock) = stated.deadlock.as_ref().or(stated.stuck.as_ref()) {
            roles.give(Role::Blocked, lock.blocked.iter().map(String::as_str));
            roles.give(Role::Core, lock.core.iter().map(String::as_str));
        }
        roles.give(Role::Needed, stated.needed.iter().flatten().map(String::as_str));
        roles
    }

    fn give<'s>(&mut self, role: Role, ids: impl Iterator<Item = &'s str>) {
        for id in ids {
            if let Some(object) = self.by_id.get(id) {
                self.roles[object.get()] = role;
            }
        }
    }

    pub(super) fn of(&self, object: ObjectIndex) -> Role {
        self.roles[object.get()]
    }

    /// True if an object has this role.
    pub(super) fn any(&self, role: Role) -> bool {
        self.roles.contains(&role)
    }

    /// Why the object can't be moved, whatever its role.
    pub(super) fn immovable(&self, object: ObjectIndex) -> Option<Stays> {
        immovable(self.scene, object)
    }

    /// True if an object can't be moved for this reason.
    pub(super) fn any_immovable(&self, reason: Stays) -> bool {
        self.scene.indices().any(|object| self.immovable(object) == Some(reason))
    }

    pub(super) fn mark(&self, object: ObjectIndex) -> Mark {
        if self.scene.goal().named().binary_search(&object).is_err() {
            return Mark::Unnamed;
        }
        if self.chosen.is_some_and(|chosen| chosen != object) { Mark::Candidate } else { Mark::Wanted }
    }

    /// The mark of the object with this id.
    pub(super) fn marked(&self, id: &str) -> Mark {
        self.by_id.get(id).map_or(Mark::Unnamed, |&object| self.mark(object))
    }

    /// The object that is grasped in the end, as far as it is known.
    pub(super) fn grasped(&self) -> Option<&'a Object> {
        self.scene.target().or(self.chosen).map(|target| self.scene.object(target))
    }

    /// The object with this id.
    pub(super) fn object(&self, id: &str) -> Option<&'a Object> {
        self.by_id.get(id).map(|&object| self.scene.object(object))
    }
}
