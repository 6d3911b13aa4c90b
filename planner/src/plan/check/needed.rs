//! Checks a stated derivation: its objects can be lifted in this order, and free the target. Places are ignored.

use crate::budget::Interrupted;
use crate::scene::{ObjectIndex, Scene};

use super::fault::{FaultCode, Faults};
use super::meter::Meter;
use super::names::{Names, relocatable};
use super::rings::Rings;

struct Lifting<'a, 's> {
    scene: &'a Scene,
    names: &'a Names<'s>,
    rings: &'a mut Rings<'s>,
    lifted: Vec<bool>,
}

/// Lifts the needed objects, then tries the target. The rings lean to free.
pub(super) fn check<'s>(
    scene: &Scene,
    names: &Names<'s>,
    ids: &[String],
    rings: &mut Rings<'s>,
    faults: &mut Faults,
    meter: &mut Meter<'_>,
) -> Result<(), Interrupted> {
    let mut lifting = Lifting { scene, names, rings, lifted: vec![false; scene.objects().len()] };
    let checked = lifting.all(ids, faults, meter);
    if checked.is_err() {
        faults.of_answer(FaultCode::NeededUnconfirmed, || "time ran out before all needed objects were lifted".into());
    }
    checked
}

impl Lifting<'_, '_> {
    fn all(&mut self, ids: &[String], faults: &mut Faults, meter: &mut Meter<'_>) -> Result<(), Interrupted> {
        for id in ids {
            meter.spend(1)?;
            let Some(object) = self.names.known(id, None, faults) else { continue };
            let mut wrong = |why: &str| faults.of_object(FaultCode::WrongNeeded, id, || why.to_owned());
            if !relocatable(self.scene, object) {
                wrong("can't be relocated");
            } else if self.lifted[object.get()] {
                wrong("is named twice");
            } else if !self.is_free(object, meter)? {
                wrong("has no free yaw when its turn comes");
            }
            self.lifted[object.get()] = relocatable(self.scene, object);
        }
        if !self.is_free(self.scene.target(), meter)? {
            let id = self.scene.object(self.scene.target()).id();
            faults.of_object(FaultCode::WrongNeeded, id, || "has no free yaw after all needed objects".to_owned());
        }
        Ok(())
    }

    fn is_free(&mut self, object: ObjectIndex, meter: &mut Meter<'_>) -> Result<bool, Interrupted> {
        let ring = self.rings.ring(object, meter)?;
        meter.spend(ring.len() / 64)?;
        Ok(self.rings.free_yaw(&ring, |other| !self.lifted[other.get()]).is_some())
    }
}
