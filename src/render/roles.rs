//! The role of each object in the answer.

use singulate_planner::plan::{Answer, Verdict};
use singulate_planner::scene::{ObjectIndex, Scene};

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

/// Every object's role.
#[derive(Debug)]
pub(super) struct Roles(Vec<Role>);

impl Roles {
    pub(super) fn new(scene: &Scene, answer: &Answer) -> Self {
        let mut roles = Self(vec![Role::Bystander; scene.objects().len()]);
        match &answer.verdict {
            Verdict::Relocate(plan) => roles.give(Role::Moved, plan.relocations.iter().map(|step| step.object)),
            Verdict::Deadlock(Some(deadlock)) => {
                roles.give(Role::Blocked, deadlock.blocked.iter().copied());
                roles.give(Role::Core, deadlock.core.iter().copied());
            }
            Verdict::NoSpace(known) | Verdict::TimedOut(known) => {
                roles.give(Role::Needed, known.needed.iter().flatten().copied());
            }
            Verdict::Graspable(_) | Verdict::Deadlock(None) => {}
        }
        roles
    }

    fn give(&mut self, role: Role, objects: impl Iterator<Item = ObjectIndex>) {
        for object in objects {
            self.0[object.get()] = role;
        }
    }

    pub(super) fn of(&self, object: ObjectIndex) -> Role {
        self.0[object.get()]
    }
}
