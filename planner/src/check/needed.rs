//! Checks a stated derivation: its objects can be moved in this order, and free the target. Places are ignored.

use std::rc::Rc;

use crate::budget::{Interrupted, Ticker};
use crate::scene::{ObjectIndex, Scene};

use super::fault::{FaultCode, Faults};
use super::names::{ObjectNames, relocatable};
use super::rings::{Ring, Rings};
use super::ways::{grasp, way};

struct Moving<'a, 's> {
    scene: &'a Scene,
    names: &'a ObjectNames<'s>,
    rings: &'a mut Rings<'s>,
    moved: Vec<bool>,
}

/// Lifts the needed objects, then tries the target. The rings lean to free.
pub(super) fn check<'s>(
    scene: &Scene,
    names: &ObjectNames<'s>,
    ids: &[String],
    rings: &mut Rings<'s>,
    faults: &mut Faults,
    ticker: &mut Ticker<'_>,
) -> Result<(), Interrupted> {
    let mut moving = Moving { scene, names, rings, moved: vec![false; scene.objects().len()] };
    let checked = moving.all(ids, faults, ticker);
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
            if !relocatable(self.scene, object) {
                wrong("can't be relocated");
            } else if self.moved[object.get()] {
                wrong("is named twice");
            } else if !self.can_be_moved(object, ticker)? {
                wrong("can't be moved when its turn comes");
            }
            self.moved[object.get()] = relocatable(self.scene, object);
        }
        if !self.target_is_free(ticker)? {
            let id = self.scene.object(self.scene.target()).id();
            faults.of_object(FaultCode::WrongNeeded, id, || "has no free yaw after all needed objects".to_owned());
        }
        Ok(())
    }

    fn can_be_moved(&mut self, object: ObjectIndex, ticker: &mut Ticker<'_>) -> Result<bool, Interrupted> {
        let ring = self.ring(object, ticker)?;
        Ok(way(self.rings, &ring, |other| !self.moved[other.get()]).is_some())
    }

    fn target_is_free(&mut self, ticker: &mut Ticker<'_>) -> Result<bool, Interrupted> {
        let ring = self.ring(self.scene.target(), ticker)?;
        Ok(grasp(self.rings, &ring, |other| !self.moved[other.get()]).is_some())
    }

    fn ring(&mut self, object: ObjectIndex, ticker: &mut Ticker<'_>) -> Result<Rc<Ring>, Interrupted> {
        let ring = self.rings.ring(object, ticker)?;
        ticker.step(ring.len() / 64)?;
        Ok(ring)
    }
}
