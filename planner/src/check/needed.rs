//! Checks a stated derivation: its objects can be moved in this order, and the goal is reached. Places are ignored.

use std::rc::Rc;

use crate::budget::{Interrupted, Ticker};
use crate::scene::{Goal, ObjectIndex, Scene};

use super::allowed::Allowed;
use super::fault::{FaultCode, Faults};
use super::names::ObjectNames;
use super::ring::Ring;
use super::rings::Rings;
use super::ways::{grasp, way};

struct Moving<'a, 's> {
    scene: &'a Scene,
    names: &'a ObjectNames<'s>,
    allowed: &'a Allowed<'s>,
    rings: &'a mut Rings<'s>,
    moved: Vec<bool>,
}

/// Lifts the needed objects, then tries the goal. The rings lean to free.
pub(super) fn check<'s>(
    scene: &Scene,
    (names, allowed): (&ObjectNames<'s>, &Allowed<'s>),
    (ids, target): (&[String], Option<&str>),
    rings: &mut Rings<'s>,
    faults: &mut Faults,
    ticker: &mut Ticker<'_>,
) -> Result<(), Interrupted> {
    let mut moving = Moving { scene, names, allowed, rings, moved: vec![false; scene.objects().len()] };
    let target = target.and_then(|id| names.find(id)).filter(|object| scene.goal().is_candidate(*object));
    let checked = moving.all(ids, faults, ticker).and_then(|()| moving.goal(target, faults, ticker));
    if checked.is_err() {
        faults.of_answer(FaultCode::NeededUnconfirmed, || "time ran out before all needed objects were lifted".into());
    }
    checked
}

impl Moving<'_, '_> {
    fn all(&mut self, ids: &[String], faults: &mut Faults, ticker: &mut Ticker<'_>) -> Result<(), Interrupted> {
        for id in ids {
            ticker.step(1)?;
            let Some(object) = self.names.known(id, None, faults) else { continue };
            let mut wrong = |why: &str| faults.of_object(FaultCode::WrongNeeded, id, || why.to_owned());
            let movable = self.allowed.relocatable(self.scene, object);
            if !movable {
                wrong("can't be relocated");
            } else if self.moved[object.get()] {
                wrong("is named twice");
            } else if !self.can_be_moved(object, ticker)? {
                wrong("can't be moved when its turn comes");
            }
            self.moved[object.get()] = movable;
        }
        Ok(())
    }

    fn can_be_moved(&mut self, object: ObjectIndex, ticker: &mut Ticker<'_>) -> Result<bool, Interrupted> {
        let ring = self.ring(object, ticker)?;
        Ok(way(self.rings, &ring, |other| !self.moved[other.get()]).is_some())
    }

    /// The stated target, or else some candidate, can be grasped, and all that is to be taken away was moved.
    fn goal(
        &mut self,
        target: Option<ObjectIndex>,
        faults: &mut Faults,
        ticker: &mut Ticker<'_>,
    ) -> Result<(), Interrupted> {
        let (scene, goal) = (self.scene, self.scene.goal());
        for &object in goal.wanted_away().iter().filter(|object| !self.moved[object.get()]) {
            let detail = || "is wanted and not among the needed objects".to_owned();
            faults.of_object(FaultCode::WrongNeeded, scene.object(object).id(), detail);
        }
        let stated = target.as_slice();
        for &candidate in if stated.is_empty() { goal.candidates() } else { stated } {
            let ring = self.ring(candidate, ticker)?;
            if grasp(self.rings, &ring, |other| !self.moved[other.get()]).is_some() {
                return Ok(());
            }
        }
        let blocked = || "has no free yaw after all needed objects".to_owned();
        match goal {
            Goal::Target(target) => faults.of_object(FaultCode::WrongNeeded, scene.object(*target).id(), blocked),
            Goal::AnyOf(_) => faults.of_answer(FaultCode::WrongNeeded, || format!("no candidate {}", blocked())),
            Goal::AllOf(_) | Goal::Clear => {}
        }
        Ok(())
    }

    fn ring(&mut self, object: ObjectIndex, ticker: &mut Ticker<'_>) -> Result<Rc<Ring>, Interrupted> {
        let ring = self.rings.ring(object, ticker)?;
        ticker.step(ring.len() / 64)?;
        Ok(ring)
    }
}
