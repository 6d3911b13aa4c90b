//! The independent checker: replays a statement on the scene with its own arithmetic.
//!
//! It shares only the scene, the budget and the statement, with what a step costs, with the rooms that make answers. So it
//! does not repeat a fault of geometry, knowledge, search or placement. Reading order: `body` and `measure` say what objects cover;
//! `finger`, `stop`, `contact`, `sweep`, `grip` and `hand` what a hand does and meets. `replay` carries out the steps (`grasping`,
//! `place`, `drops`); `allowed` says which objects may move at all, `yaws` and `rings` which objects block which, `ways` what can
//! be moved then; `lock`, `chain` and `needed` build on them; `hitting` and `bound` confirm the bound; `clearing` and `most` confirm
//! what a clearing leaves; `parts` compares the parts of the statement.

mod allowed;
mod body;
mod bound;
mod branch;
mod chain;
mod clearing;
mod contact;
mod drops;
mod family;
mod fault;
mod finger;
mod fork;
mod grasping;
mod grip;
mod hand;
mod hitting;
mod leaning;
mod lock;
mod measure;
mod most;
mod multipliers;
mod names;
mod near;
mod needed;
mod parts;
mod place;
mod poses;
mod replay;
mod ring;
mod rings;
#[cfg(test)]
mod shapes;
mod stop;
mod sweep;
mod terms;
#[cfg(test)]
mod tests;
mod ways;
mod yaws;

pub use fault::{Fault, FaultCode, MAX_FAULTS, Report};
pub use terms::{POSITION_TOLERANCE_RANGE, Terms};

use std::rc::Rc;

use crate::budget::{Budget, Ticker};
use crate::scene::Scene;
use crate::statement::Statement;

use allowed::Allowed;
use chain::Chain;
use clearing::Clearing;
use fault::Faults;
use leaning::Leaning;
use names::ObjectNames;
use near::{Places, Tree};
use replay::Replayed;
use rings::Rings;

/// How far a stated answer may be off, m for lengths and rad for slack. Coordinates reach 1e5 m, where a double resolves
/// 1.5e-11 m; a distance made of a few of them is good to about 1e-10 m, and no arm notices ten times that. Touching is
/// allowed, so a plan that touches exactly must pass in spite of rounding.
const TOLERANCE: f64 = 1e-9;

/// Units of work between two looks at the budget: about 100 µs. In tests each is a look, so that time can end anywhere.
const BEAT: usize = if cfg!(test) { 1 } else { 100 };

/// Units that a replay may spend even after the budget has ended, about 50 ms: a plan found at the last moment must
/// still be replayed before it is served. Only plans from outside are longer.
const PATIENCE: usize = 50_000;

/// The checker of one scene. Its preparations are shared by all answers, whatever their goals.
pub struct Checker<'s> {
    scene: &'s Scene,
    names: ObjectNames<'s>,
    allowed: Allowed<'s>,
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
        Self { scene, names: ObjectNames::new(scene), allowed: Allowed::new(scene), start, blocked, free: None }
    }

    /// Check a stated answer. The time is near-linear in the steps and in what the proofs name. Locks and needed objects take
    /// a byte of memory for each object of the scene. The proofs look at the budget about every 100 µs and are reported as
    /// unconfirmed where it ends.
    pub fn check(&mut self, statement: &Statement, budget: &Budget<'_>) -> Report {
        self.check_for(self.scene, statement, &Terms::default(), budget)
    }

    /// The same on other terms, and for an answer to `scene`, which is the checker's scene with any goal.
    pub(crate) fn check_for(
        &mut self,
        scene: &Scene,
        statement: &Statement,
        terms: &Terms,
        budget: &Budget<'_>,
    ) -> Report {
        let mut faults = Faults::default();
        if !terms.partial {
            parts::agree(scene, statement, &mut faults);
        }
        let replayed = self.replayed(scene, statement, terms, &mut faults, budget);
        let Replayed { first_failing_step, steps, interrupted, .. } = replayed;
        let report = Report { first_failing_step, replayed: steps, interrupted, ..Report::default() };
        if terms.partial {
            return Report { faults: faults.into_vec(), ..report };
        }
        let Self { names, allowed, start, blocked, free, .. } = self;
        let mut ticker = Ticker::every(BEAT, budget);
        let before = faults.count();
        let locked = lock::check(scene, (names, allowed), statement, blocked.rings(), &mut faults, &mut ticker);
        let clearing =
            Clearing { scene, names, allowed, statement, replayed: &replayed, locked: faults.count() == before };
        let clearing_proven = clearing.check(blocked.rings(), &mut faults, &mut ticker);
        let needed = match &statement.needed {
            Some(ids) => {
                let rings = free.get_or_insert_with(|| Rings::new(self.scene, start, Leaning::Free));
                let stated = (ids.as_slice(), statement.target.as_deref());
                needed::check(scene, (names, allowed), stated, rings, &mut faults, &mut ticker)
            }
            None => Ok(()),
        };
        let stated = statement.landmarks.as_deref().unwrap_or_default();
        let proof = bound::prove(scene, stated, (names, allowed), blocked, &mut faults, &mut ticker);
        parts::bounded(statement, &proof, &mut faults);

        let unfinished = interrupted || locked.is_err() || needed.is_err() || !proof.complete;
        Report {
            faults: faults.into_vec(),
            proven_bound: proof.bound,
            sound_landmarks: proof.sound,
            clearing_proven,
            interrupted: unfinished,
            ..report
        }
    }

    fn replayed(
        &self,
        scene: &Scene,
        statement: &Statement,
        terms: &Terms,
        faults: &mut Faults,
        budget: &Budget<'_>,
    ) -> Replayed {
        let places = Places::new(scene, &self.start, statement.steps(), &self.names, &self.allowed);
        let ticker = Ticker::patient(PATIENCE, BEAT, budget);
        replay::replay(scene, &places, (&self.names, &self.allowed), statement, terms, faults, ticker)
    }
}

/// Check one stated answer.
pub fn check(scene: &Scene, statement: &Statement, budget: &Budget<'_>) -> Report {
    check_on(scene, statement, &Terms::default(), budget)
}

/// The same on other terms.
pub fn check_on(scene: &Scene, statement: &Statement, terms: &Terms, budget: &Budget<'_>) -> Report {
    Checker::new(scene).check_for(scene, statement, terms, budget)
}
