//! Whether the stated derivation frees the target: its objects can be lifted in this order, places left aside.

use crate::budget::Interrupted;
use crate::plan::claim::Claim;
use crate::scene::{ObjectIndex, Scene};

use super::fault::{FaultCode, Faults};
use super::meter::Meter;
use super::names::Names;
use super::near::Places;
use super::rings::{Leaning, Rings};

struct Lifting<'a> {
    scene: &'a Scene,
    names: &'a Names<'a>,
    rings: Rings<'a>,
    lifted: Vec<bool>,
}

/// Lift the needed objects, then look at the target.
pub(super) fn check(
    scene: &Scene,
    places: &Places,
    names: &Names<'_>,
    claim: &Claim,
    faults: &mut Faults,
    meter: &mut Meter<'_>,
) -> Result<(), Interrupted> {
    let Some(ids) = &claim.needed else { return Ok(()) };
    let rings = Rings::new(scene, places, Leaning::Free);
    let mut lifting = Lifting { scene, names, rings, lifted: vec![false; scene.objects().len()] };
    let checked = lifting.all(ids, faults, meter);
    if checked.is_err() {
        faults.of_answer(FaultCode::NeededUnconfirmed, || "time ran out before all needed objects were lifted".into());
    }
    checked
}

impl Lifting<'_> {
    fn all(&mut self, ids: &[String], faults: &mut Faults, meter: &mut Meter<'_>) -> Result<(), Interrupted> {
        for id in ids {
            meter.spend(1)?;
            let Some(object) = self.names.known(id, None, faults) else { continue };
            let mut wrong = |why: &str| faults.of_object(FaultCode::WrongNeeded, id, || why.to_owned());
            if !self.names.relocatable(object) {
                wrong("can't be relocated");
            } else if self.lifted[object.get()] {
                wrong("is named twice");
            } else if !self.is_free(object, meter)? {
                wrong("has no free yaw when its turn comes");
            }
            self.lifted[object.get()] = self.names.relocatable(object);
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
        Ok(self.rings.is_free(&ring, |other| !self.lifted[other.get()]))
    }
}
