//! Checks stated locks: their members, among them what is wanted, block each other against every action of `ways`.

use crate::budget::{Interrupted, Ticker};
use crate::scene::{Goal, ObjectIndex, Scene};
use crate::statement::{Deadlock, Statement};

use super::allowed::Allowed;
use super::fault::{FaultCode, Faults};
use super::names::ObjectNames;
use super::rings::Rings;
use super::ways::{grasp, way};

/// Both locks of a stated deadlock, or of what is stuck in a clearing.
pub(super) fn check(
    scene: &Scene,
    named: (&ObjectNames<'_>, &Allowed<'_>),
    statement: &Statement,
    rings: &mut Rings<'_>,
    faults: &mut Faults,
    ticker: &mut Ticker<'_>,
) -> Result<(), Interrupted> {
    let stated = if *scene.goal() == Goal::Clear { &statement.stuck } else { &statement.deadlock };
    let Some(stated) = stated else { return Ok(()) };
    let checked = both(scene, named, stated, rings, faults, ticker);
    if checked.is_err() {
        faults.of_answer(FaultCode::LockUnconfirmed, || "time ran out before the lock was proven".into());
    }
    checked
}

fn both(
    scene: &Scene,
    (names, allowed): (&ObjectNames<'_>, &Allowed<'_>),
    stated: &Deadlock,
    rings: &mut Rings<'_>,
    faults: &mut Faults,
    ticker: &mut Ticker<'_>,
) -> Result<(), Interrupted> {
    // The core comes first: it is small, and it alone proves the deadlock.
    let core = Lock::new("core", &stated.core, scene, names, faults, ticker)?;
    let blocked = Lock::new("blocked", &stated.blocked, scene, names, faults, ticker)?;
    for outside in core.members.iter().filter(|member| !blocked.holds(**member)) {
        let detail = || "is in the core but not among the blocked".to_owned();
        faults.of_object(FaultCode::CoreOutsideBlocked, scene.object(*outside).id(), detail);
    }
    core.check(scene, allowed, rings, faults, ticker)?;
    blocked.check(scene, allowed, rings, faults, ticker)
}

struct Lock {
    name: &'static str,
    members: Vec<ObjectIndex>,
    /// For each object of the scene whether it is a member.
    is_member: Vec<bool>,
}

impl Lock {
    fn new(
        name: &'static str,
        ids: &[String],
        scene: &Scene,
        names: &ObjectNames<'_>,
        faults: &mut Faults,
        ticker: &mut Ticker<'_>,
    ) -> Result<Self, Interrupted> {
        let mut lock = Self { name, members: Vec::new(), is_member: vec![false; scene.objects().len()] };
        for ids in ids.chunks(16) {
            ticker.step(1)?;
            for object in ids.iter().filter_map(|id| names.known(id, None, faults)) {
                if !lock.holds(object) {
                    lock.is_member[object.get()] = true;
                    lock.members.push(object);
                }
            }
        }
        Ok(lock)
    }

    fn holds(&self, object: ObjectIndex) -> bool {
        self.is_member[object.get()]
    }

    /// What is wanted is a member, or enough of it that the goal can't be reached without it. While all members stand, no
    /// candidate can be grasped, and no movable member can be moved.
    fn check(
        &self,
        scene: &Scene,
        allowed: &Allowed<'_>,
        rings: &mut Rings<'_>,
        faults: &mut Faults,
        ticker: &mut Ticker<'_>,
    ) -> Result<(), Interrupted> {
        self.holds_what_is_wanted(scene, allowed, faults);
        let goal = scene.goal();
        let mobile = |member: &&ObjectIndex| goal.is_candidate(**member) || allowed.relocatable(scene, **member);
        for member in self.members.iter().filter(mobile) {
            let ring = rings.ring(*member, ticker)?;
            ticker.step(1 + ring.len() / 64)?;
            let stands = |object| self.holds(object);
            let way = if goal.is_candidate(*member) { grasp(rings, &ring, stands) } else { way(rings, &ring, stands) };
            if let Some(way) = way {
                let detail = || format!("{way} though all of '{}' stand", self.name);
                faults.of_object(FaultCode::LockMemberFree, scene.object(*member).id(), detail);
            }
        }
        Ok(())
    }

    /// Reports a lock that keeps nobody from the goal.
    fn holds_what_is_wanted(&self, scene: &Scene, allowed: &Allowed<'_>, faults: &mut Faults) {
        let mut without = |object: ObjectIndex, what: &str| {
            let detail = || format!("{what} is not in '{}'", self.name);
            faults.of_object(FaultCode::LockWithoutTarget, scene.object(object).id(), detail);
        };
        match scene.goal() {
            Goal::Target(target) if !self.holds(*target) => without(*target, "the target"),
            Goal::Target(_) => {}
            Goal::AnyOf(candidates) => {
                candidates
                    .iter()
                    .filter(|object| !self.holds(**object))
                    .for_each(|object| without(*object, "a candidate"));
            }
            Goal::AllOf(wanted) if !wanted.iter().any(|object| self.holds(*object)) => {
                let detail = || format!("nothing that is wanted is in '{}'", self.name);
                faults.of_answer(FaultCode::LockWithoutTarget, detail);
            }
            Goal::Clear if !self.members.iter().any(|member| allowed.relocatable(scene, *member)) => {
                let detail = || format!("nothing that could be taken away is in '{}'", self.name);
                faults.of_answer(FaultCode::LockWithoutTarget, detail);
            }
            Goal::AllOf(_) | Goal::Clear => {}
        }
    }
}
