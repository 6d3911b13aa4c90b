//! The independent checker: replays a stated answer on the scene with its own arithmetic.
//!
//! It shares only the scene, the budget and the stated answer with the rooms that make answers, so that it does not
//! repeat a fault of geometry, knowledge, search or placement. Reading order: `replay` carries out the steps (`place`,
//! `finger`); `yaws` and `rings` determine which objects block which; `lock`, `chain` and `needed` build on them;
//! `hitting` and `bound` confirm the bound; `claims` compares the parts of the answer.

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
mod multipliers;
mod names;
mod near;
mod needed;
mod place;
mod replay;
mod rings;
mod yaws;

pub use fault::{Fault, FaultCode, MAX_FAULTS, Report};

use std::rc::Rc;

use crate::budget::Budget;
use crate::plan::claim::Claim;
use crate::scene::Scene;

use chain::Chain;
use fault::Faults;
use meter::Meter;
use names::Names;
use near::{Places, Tree};
use rings::{Leaning, Rings};

/// How far a stated answer may be off, m for lengths and rad for slack. Coordinates reach 1e5 m, where a double resolves
/// 1.5e-11 m; a distance made of a few of them is good to about 1e-10 m, and no arm notices ten times that. Touching is
/// allowed, so a plan that touches exactly must pass in spite of rounding.
const TOLERANCE: f64 = 1e-9;

/// The checker of one scene. Its preparations are shared by all answers, whatever their targets.
pub struct Checker<'s> {
    scene: &'s Scene,
    names: Names<'s>,
    start: Rc<Tree>,
    /// Chains on rings that lean to blocked.
    blocked: Chain<'s>,
    /// Rings that lean to free, made for the first answer with needed objects.
    free: Option<Rings<'s>>,
}

impl<'s> Checker<'s> {
    /// Prepares the scene; near-linear in its size.
    pub fn new(scene: &'s Scene) -> Self {
        let start = Tree::of_start(scene);
        let blocked = Chain::new(Rings::new(scene, &start, Leaning::Blocked));
        Self { scene, names: Names::new(scene), start, blocked, free: None }
    }

    /// Check a stated answer. The time is near-linear in the steps and in what the proofs name. Locks and needed objects take
    /// a byte of memory for each object of the scene. The proofs look at the budget about every 100 µs and are reported as
    /// unconfirmed where it ends.
    pub fn check(&mut self, claim: &Claim, budget: &Budget<'_>) -> Report {
        self.check_for(self.scene, claim, budget)
    }

    /// The same for an answer to `scene`, which is the checker's scene with any target.
    pub(super) fn check_for(&mut self, scene: &Scene, claim: &Claim, budget: &Budget<'_>) -> Report {
        let Self { names, start, blocked, free, .. } = self;
        let mut faults = Faults::default();
        let steps = claim.relocations.as_deref().unwrap_or_default();
        let places = Places::new(scene, start, steps, names);
        claims::parts(claim, &mut faults);
        let replayed = replay::replay(scene, &places, names, claim, &mut faults, Meter::patient(budget));

        let mut meter = Meter::new(budget);
        let locked = lock::check(scene, names, claim, blocked.rings(), &mut faults, &mut meter);
        let needed = match &claim.needed {
            Some(ids) => {
                let rings = free.get_or_insert_with(|| Rings::new(self.scene, start, Leaning::Free));
                needed::check(scene, names, ids, rings, &mut faults, &mut meter)
            }
            None => Ok(()),
        };
        let stated = claim.landmarks.as_deref().unwrap_or_default();
        let proof = bound::prove(scene, stated, names, blocked, &mut faults, &mut meter);
        claims::bounds(claim, &proof, &mut faults);

        let unfinished = replayed.is_err() || locked.is_err() || needed.is_err() || !proof.complete;
        Report {
            faults: faults.into_vec(),
            proven_bound: proof.bound,
            sound_landmarks: proof.sound,
            interrupted: unfinished,
        }
    }
}

/// Check one stated answer.
pub fn check(scene: &Scene, claim: &Claim, budget: &Budget<'_>) -> Report {
    Checker::new(scene).check(claim, budget)
}
