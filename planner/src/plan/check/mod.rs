//! The independent checker: replays a stated answer on the scene with its own arithmetic.
//!
//! It shares nothing with the rooms that make answers: only the scene, the budget and the stated answer come in, so that
//! a fault in geometry, knowledge, search or placement can't hide behind itself. Reading order: `replay` carries the
//! steps out (`place`, `finger`); `yaws` and `rings` say which objects hold which; on them stand `lock`,
//! `chain` and `needed`; `hitting` and `bound` confirm the bound; `claims` compares the parts of the answer.

mod bound;
mod branch;
mod chain;
mod claims;
mod family;
mod fault;
mod finger;
mod fork;
mod hitting;
mod lock;
mod meter;
mod names;
mod near;
mod needed;
mod place;
mod replay;
mod rings;
mod shares;
mod yaws;

pub use fault::{Fault, FaultCode, MAX_FAULTS, Report};

use crate::budget::Budget;
use crate::plan::claim::Claim;
use crate::scene::Scene;

use chain::Chain;
use fault::Faults;
use meter::Meter;
use names::Names;
use near::Places;
use rings::{Leaning, Rings};

/// How far a stated answer may be off, m for lengths and rad for slack. Coordinates reach 1e5 m, where a double resolves
/// 1.5e-11 m; a distance made of a few of them is good to about 1e-10 m, and no arm notices ten times that. Touching is
/// allowed, so a plan that touches exactly must pass in spite of rounding.
const TOLERANCE: f64 = 1e-9;

/// Check a stated answer. The cost is near-linear in the scene and the steps; the proofs look at the budget about every
/// 100 µs and are reported as unconfirmed where it ends.
pub fn check(scene: &Scene, claim: &Claim, budget: &Budget<'_>) -> Report {
    let mut faults = Faults::default();
    let names = Names::new(scene);
    let steps = claim.relocations.as_deref().unwrap_or_default();
    let places = Places::new(scene, steps, &names);
    claims::parts(claim, &mut faults);
    let replayed = replay::replay(scene, &places, &names, claim, &mut faults, Meter::patient(budget));

    let mut meter = Meter::new(budget);
    let mut rings = Rings::new(scene, &places, Leaning::Blocked);
    let locked = lock::check(scene, &names, claim, &mut rings, &mut faults, &mut meter);
    let needed = needed::check(scene, &places, &names, claim, &mut faults, &mut meter);
    let stated = claim.landmarks.as_deref().unwrap_or_default();
    let proof = bound::prove(stated, &names, &mut Chain::new(scene, rings), &mut faults, &mut meter);
    claims::bounds(claim, &proof, &mut faults);

    let unfinished = replayed.is_err() || locked.is_err() || needed.is_err() || !proof.complete;
    Report {
        faults: faults.into_vec(),
        proven_bound: proof.bound,
        sound_landmarks: proof.sound,
        interrupted: unfinished,
    }
}
