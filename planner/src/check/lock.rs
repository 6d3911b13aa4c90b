//! Checks a stated deadlock: its members, among them the target, block each other against every action of `ways`.

use crate::budget::{Interrupted, Ticker};
use crate::scene::{ObjectIndex, Scene};
use crate::statement::{Deadlock, Statement};

use super::fault::{FaultCode, Faults};
use super::names::ObjectNames;
use super::rings::Rings;
use super::ways::{grasp, way};

/// Both locks of a stated deadlock.
pub(super) fn check(
    scene: &Scene,
    names: &ObjectNames<'_>,
    statement: &Statement,
    rings: &mut Rings<'_>,
    faults: &mut Faults,
    ticker: &mut Ticker<'_>,
) -> Result<(), Interrupted> {
    let Some(stated) = &statement.deadlock else { return Ok(()) };
    let checked = both(scene, names, stated, rings, faults, ticker);
    if checked.is_err() {
        faults.of_answer(FaultCode::LockUnconfirmed, || "time ran out before the lock was proven".into());
    }
    checked
}

fn both(
    scene: &Scene,
    names: &ObjectNames<'_>,
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
    core.check(scene, rings, faults, ticker)?;
    blocked.check(scene, rings, faults, ticker)
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

    /// The target is a member. While all members stand, it can't be grasped, and no other movable member can be moved.
    fn check(
        &self,
        scene: &Scene,
        rings: &mut Rings<'_>,
        faults: &mut Faults,
        ticker: &mut Ticker<'_>,
    ) -> Result<(), Interrupted> {
        if !self.holds(scene.target()) {
            let id = scene.object(scene.target()).id();
            faults.of_object(FaultCode::LockWithoutTarget, id, || format!("the target is not in '{}'", self.name));
        }
        for member in self.members.iter().filter(|member| !scene.object(**member).fixed()) {
            let ring = rings.ring(*member, ticker)?;
            ticker.step(1 + ring.len() / 64)?;
            let stands = |object| self.holds(object);
            let way = if *member == scene.target() { grasp(rings, &ring, stands) } else { way(rings, &ring, stands) };
            if let Some(way) = way {
                let detail = || format!("{way} though all of '{}' stand", self.name);
                faults.of_object(FaultCode::LockMemberFree, scene.object(*member).id(), detail);
            }
        }
        Ok(())
    }
}
