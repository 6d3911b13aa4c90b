//! Checks what a clearing says of its end: what is left, and that no order takes more away.

use std::collections::HashSet;

use crate::budget::{Interrupted, Ticker};
use crate::scene::{Goal, ObjectIndex, Scene};
use crate::statement::{Statement, Verdict};

use super::allowed::Allowed;
use super::drops::{Drops, Takers};
use super::fault::{FaultCode, Faults};
use super::most::{MOST_OBJECTS, most};
use super::names::ObjectNames;
use super::near::Standing;
use super::replay::Replayed;
use super::rings::Rings;

/// A clearing whose steps were replayed.
pub(super) struct Clearing<'a> {
    pub(super) scene: &'a Scene,
    pub(super) names: &'a ObjectNames<'a>,
    pub(super) allowed: &'a Allowed<'a>,
    pub(super) statement: &'a Statement,
    pub(super) replayed: &'a Replayed,
    /// True if the lock of what is stuck was confirmed, or none is stated.
    pub(super) locked: bool,
}

impl Clearing<'_> {
    /// True if it was shown that no order takes more away. The statement of another goal, or one whose steps were not all
    /// replayed, has no such end.
    pub(super) fn check(&self, rings: &mut Rings<'_>, faults: &mut Faults, ticker: &mut Ticker<'_>) -> bool {
        if *self.scene.goal() != Goal::Clear || self.replayed.interrupted {
            return false;
        }
        let left = self.left(faults);
        let clear = left.is_empty();
        if self.statement.verdict.is_some_and(|verdict| (verdict == Verdict::Cleared) != clear) {
            let detail = || format!("{} objects are left that are not fixed", left.len());
            faults.of_answer(FaultCode::WrongVerdict, detail);
        }
        self.proven(rings, faults, ticker).unwrap_or(false)
    }

    fn standing(&self) -> &Standing {
        &self.replayed.standing
    }

    fn drops(&self) -> &Drops {
        &self.replayed.drops
    }

    /// What is left, compared with what is stated.
    fn left(&self, faults: &mut Faults) -> Vec<ObjectIndex> {
        let stays = |object: &ObjectIndex| !self.scene.object(*object).fixed() && !self.standing().gone(*object);
        let left: Vec<ObjectIndex> = self.scene.indices().filter(stays).collect();
        let Some(stated) = &self.statement.left else { return left };
        let mut named = HashSet::new();
        for id in stated {
            let Some(object) = self.names.known(id, None, faults) else { continue };
            if !stays(&object) {
                faults.of_object(FaultCode::WrongLeft, id, || "is named in 'left' and does not stay".to_owned());
            } else if !named.insert(object) {
                faults.of_object(FaultCode::WrongLeft, id, || "is named twice in 'left'".to_owned());
            }
        }
        for object in left.iter().filter(|object| !named.contains(object)) {
            let id = self.scene.object(*object).id();
            faults.of_object(FaultCode::WrongLeft, id, || "stays and is not named in 'left'".to_owned());
        }
        left
    }

    /// True if no order takes more away. By counting, where the drop-offs that could take what is left are full of objects
    /// that no other drop-off takes; else, if it is claimed, by trying every order.
    fn proven(&self, rings: &mut Rings<'_>, faults: &mut Faults, ticker: &mut Ticker<'_>) -> Result<bool, Interrupted> {
        let claimed = self.statement.proven;
        let shown = self.shown(claimed == Some(true), rings, ticker);
        match (claimed, &shown) {
            (Some(true), Ok(Shown::MoreGo(count))) => {
                let detail = || format!("{} are taken away, and an order takes {count}", self.drops().taken());
                faults.of_answer(FaultCode::WrongProven, detail);
            }
            (Some(true), Ok(Shown::Nothing) | Err(Interrupted)) => {
                let detail = || "it could not be confirmed that no order takes more away".to_owned();
                faults.of_answer(FaultCode::ProvenUnconfirmed, detail);
            }
            _ => {}
        }
        Ok(matches!(shown?, Shown::NoneGoes))
    }

    fn shown(&self, claimed: bool, rings: &mut Rings<'_>, ticker: &mut Ticker<'_>) -> Result<Shown, Interrupted> {
        if !self.locked {
            return Ok(Shown::Nothing);
        }
        let stuck = self.statement.stuck.iter().flat_map(|stuck| &stuck.blocked);
        let stuck: HashSet<ObjectIndex> = stuck.filter_map(|id| self.names.find(id)).collect();
        let loose = |object: &ObjectIndex| self.allowed.relocatable(self.scene, *object) && !stuck.contains(object);
        let loose: Vec<ObjectIndex> = self.scene.indices().filter(loose).collect();
        ticker.step(1 + loose.len() / 64)?;
        let takers = Takers::new(self.scene);
        if self.counts(&loose, &takers, ticker)? {
            return Ok(Shown::NoneGoes);
        }
        if !claimed || loose.len() > MOST_OBJECTS {
            return Ok(Shown::Nothing);
        }
        let most = most(self.scene, &loose, &takers, rings, ticker)?;
        Ok(if most > self.drops().taken() { Shown::MoreGo(most) } else { Shown::NoneGoes })
    }

    /// Follows from each object that stays the drop-offs that accept it, and from each of these the objects that it holds. If
    /// all those drop-offs are full, they can hold no more of the objects that only they accept.
    fn counts(&self, loose: &[ObjectIndex], takers: &Takers, ticker: &mut Ticker<'_>) -> Result<bool, Interrupted> {
        let mut held: Vec<Vec<ObjectIndex>> = vec![Vec::new(); self.scene.drop_offs().len()];
        let (taken, mut open): (Vec<ObjectIndex>, Vec<ObjectIndex>) =
            loose.iter().partition(|object| self.standing().gone(**object));
        for object in taken {
            if let Some(at) = self.drops().of(object) {
                held[at].push(object);
            }
        }
        let mut reached = vec![false; held.len()];
        while let Some(object) = open.pop() {
            for at in takers.of(object) {
                ticker.step(1)?;
                if core::mem::replace(&mut reached[at], true) {
                    continue;
                }
                if self.drops().has_room(self.scene, at) {
                    return Ok(false);
                }
                open.append(&mut held[at]);
            }
        }
        Ok(true)
    }
}

/// What is shown of a clearing.
enum Shown {
    /// No order takes more away.
    NoneGoes,
    /// Some order takes so many away.
    MoreGo(usize),
    /// Neither.
    Nothing,
}
