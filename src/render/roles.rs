//! The role of each object in the answer.

use std::collections::HashMap;

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
}

/// Every object's role, and the objects by their ids: a lock may name thousands.
#[derive(Debug)]
pub(super) struct Roles<'a> {
    scene: &'a Scene,
    by_id: HashMap<&'a str, ObjectIndex>,
    roles: Vec<Role>,
}

impl<'a> Roles<'a> {
    pub(super) fn new(scene: &'a Scene, stated: &Statement) -> Self {
        let by_id = scene.indices().map(|object| (scene.object(object).id(), object)).collect();
        let mut roles = Self { scene, by_id, roles: vec![Role::Bystander; scene.objects().len()] };
        roles.give(Role::Moved, stated.steps().iter().map(Step::object));
        if let Some(deadlock) = &stated.deadlock {
            roles.give(Role::Blocked, deadlock.blocked.iter().map(String::as_str));
            roles.give(Role::Core, deadlock.core.iter().map(String::as_str));
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

    /// True for the target, and for whatever else the goal names.
    pub(super) fn wanted(&self, object: ObjectIndex) -> bool {
        self.scene.goal().named().binary_search(&object).is_ok()
    }

    /// The object that is grasped in the end, as far as it is known.
    pub(super) fn grasped(&self, stated: &Statement) -> Option<&'a Object> {
        let chosen = || stated.target.as_deref().and_then(|id| self.object(id));
        self.scene.target().map(|target| self.scene.object(target)).or_else(chosen)
    }

    /// The object with this id.
    pub(super) fn object(&self, id: &str) -> Option<&'a Object> {
        self.by_id.get(id).map(|&object| self.scene.object(object))
    }
}
