//! Checks a stated deadlock: its members, among them the target, block each other.

use crate::budget::Interrupted;
use crate::plan::claim::{Claim, ClaimedDeadlock};
use crate::scene::{ObjectIndex, Scene};

use super::fault::{FaultCode, Faults};
use super::meter::Meter;
use super::names::Names;
use super::rings::Rings;

/// Both locks of a stated deadlock.
pub(super) fn check(
    scene: &Scene,
    names: &Names<'_>,
    claim: &Claim,
    rings: &mut Rings<'_>,
    faults: &mut Faults,
    meter: &mut Meter<'_>,
) -> Result<(), Interrupted> {
    let Some(stated) = &claim.deadlock else { return Ok(()) };
    let checked = both(scene, names, stated, rings, faults, meter);
    if checked.is_err() {
        faults.of_answer(FaultCode::LockUnconfirmed, || "time ran out before the lock was proven".into());
    }
    checked
}

fn both(
    scene: &Scene,
    names: &Names<'_>,
    stated: &ClaimedDeadlock,
    rings: &mut Rings<'_>,
    faults: &mut Faults,
    meter: &mut Meter<'_>,
) -> Result<(), Interrupted> {
    // The core comes first: it is small, and it alone proves the deadlock.
    let core = Lock::new("core", &stated.core, scene, names, faults, meter)?;
    let blocked = Lock::new("blocked", &stated.blocked, scene, names, faults, meter)?;
    for outside in core.members.iter().filter(|member| !blocked.holds(**member)) {
        let detail = || "is in the core but not among the blocked".to_owned();
        faults.of_object(FaultCode::CoreOutsideBlocked, scene.object(*outside).id(), detail);
    }
    core.check(scene, rings, faults, meter)?;
    blocked.check(scene, rings, faults, meter)
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
        names: &Names<'_>,
        faults: &mut Faults,
        meter: &mut Meter<'_>,
    ) -> Result<Self, Interrupted> {
        let mut lock = Self { name, members: Vec::new(), is_member: vec![false; scene.objects().len()] };
        for ids in ids.chunks(16) {
            meter.spend(1)?;
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

    /// The target is a member, and at every yaw of every movable member some member blocks.
    fn check(
        &self,
        scene: &Scene,
        rings: &mut Rings<'_>,
        faults: &mut Faults,
        meter: &mut Meter<'_>,
    ) -> Result<(), Interrupted> {
        if !self.holds(scene.target()) {
            let id = scene.object(scene.target()).id();
            faults.of_object(FaultCode::LockWithoutTarget, id, || format!("the target is not in '{}'", self.name));
        }
        for member in self.members.iter().filter(|member| !scene.object(**member).fixed()) {
            let ring = rings.ring(*member, meter)?;
            meter.spend(1 + ring.len() / 64)?;
            if let Some(yaw) = rings.free_yaw(&ring, |object| self.holds(object)) {
                let detail = || format!("can be grasped at yaw {yaw:.9} rad though all of '{}' stand", self.name);
                faults.of_object(FaultCode::LockMemberFree, scene.object(*member).id(), detail);
            }
        }
        Ok(())
    }
}
