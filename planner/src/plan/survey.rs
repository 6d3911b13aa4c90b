//! Every movable object as the target: logic only, without places.

use super::confirm::{PlanError, confirm};
use super::reasons::{graspable_now, greatest_lock, prove_deadlock};
use crate::budget::Budget;
use crate::check::Checker;
use crate::cost::Cost;
use crate::knowledge::{Derivable, KnowledgeBase, NoBase, SweptFinger, complete, derivable, relevant};
use crate::scene::{ObjectIndex, Scene};
use crate::search::{Restriction, SearchOutcome, least};
use crate::statement::{Statement, Verdict};

/// The verdict for one object as the target.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SurveyVerdict {
    /// Can be grasped as the table stands.
    Graspable,
    /// Some set of relocations frees it, if there are places for them.
    Relocate,
    /// Nothing frees it.
    Deadlock,
    /// Not decided in time.
    TimedOut,
}

/// One movable object of the survey.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SurveyEntry {
    /// The object.
    pub object: ObjectIndex,
    /// The verdict for it as the target.
    pub verdict: SurveyVerdict,
    /// The proven bound; `None` for a deadlock.
    pub lower_bound: Option<Cost>,
    /// True if that many relocations suffice, places ignored; `None` for a deadlock.
    pub optimal: Option<bool>,
}

/// Every object that can be grasped as the target, in index order; the scene's own goal is ignored. Objects undecided when the
/// budget ends are `TimedOut`.
///
/// # Errors
/// [`PlanError::TooDense`] if the knowledge base would be too large, [`PlanError::Refused`] if an entry's proof fails its check.
pub fn survey(scene: &Scene, budget: &Budget<'_>) -> Result<Vec<SurveyEntry>, PlanError> {
    let scene = &scene.without_goal();
    let movable = scene.indices().filter(|&object| scene.object(object).can_be_grasped());
    let known = complete(scene, &SweptFinger, budget).and_then(|base| Ok((derivable(&base, |_| false, budget)?, base)));
    let (derivable, base) = match known {
        Ok(known) => known,
        Err(NoBase::Interrupted) => return Ok(movable.map(timed_out).collect()),
        Err(NoBase::TooLarge) => return Err(PlanError::TooDense),
    };
    let checker = Checker::new(scene);
    let mut surveyor = Surveyor { scene, base: &base, derivable: &derivable, checker, locked: None };
    movable.map(|object| surveyor.entry(object, budget)).collect()
}

struct Surveyor<'a> {
    scene: &'a Scene,
    base: &'a KnowledgeBase,
    derivable: &'a Derivable,
    checker: Checker<'a>,
    /// The greatest lock as the checker confirmed it: one and the same for every object in it. Empty where time ran out.
    locked: Option<Vec<ObjectIndex>>,
}

impl Surveyor<'_> {
    fn entry(&mut self, object: ObjectIndex, budget: &Budget<'_>) -> Result<SurveyEntry, PlanError> {
        let Some(scene) = self.scene.with_target(object) else { return Ok(timed_out(object)) };
        if budget.check().is_err() {
            return Ok(timed_out(object));
        }
        if !self.scene.movable(object) {
            return self.only_grasped(&scene, object, budget);
        }
        if !self.derivable.derives(object) {
            return self.deadlock(&scene, object, budget);
        }
        if self.base.free_now(object) {
            return self.graspable(&scene, object, budget);
        }
        self.derived(&scene, object, least(self.base, object, &Restriction::default(), budget), budget)
    }

    /// An object that no drop-off accepts: no rule of the common base moves it, so it gets a base of its own.
    fn only_grasped(
        &mut self,
        scene: &Scene,
        object: ObjectIndex,
        budget: &Budget<'_>,
    ) -> Result<SurveyEntry, PlanError> {
        let base = match relevant(scene, object, &SweptFinger, budget) {
            Ok(base) => base,
            Err(NoBase::Interrupted) => return Ok(timed_out(object)),
            Err(NoBase::TooLarge) => return Err(PlanError::TooDense),
        };
        if base.free_now(object) {
            return self.graspable(scene, object, budget);
        }
        let outcome = least(&base, object, &Restriction::default(), budget);
        if outcome != SearchOutcome::Underivable {
            return self.derived(scene, object, outcome, budget);
        }
        let Ok(locks) = prove_deadlock(scene, &base, budget) else { return Ok(timed_out(object)) };
        let confirmed = confirm(&mut self.checker, scene, Statement::deadlock(scene, &locks), budget)?;
        Ok(if confirmed.verdict == Some(Verdict::Deadlock) { deadlock(object) } else { timed_out(object) })
    }

    fn graspable(&mut self, scene: &Scene, object: ObjectIndex, budget: &Budget<'_>) -> Result<SurveyEntry, PlanError> {
        let stated = Statement::graspable(graspable_now(scene, object, &SweptFinger)?);
        Ok(match confirm(&mut self.checker, scene, stated, budget)?.verdict {
            Some(Verdict::Graspable) => SurveyEntry {
                object,
                verdict: SurveyVerdict::Graspable,
                lower_bound: Some(Cost::ZERO),
                optimal: Some(true),
            },
            _ => timed_out(object),
        })
    }

    /// A derivation with its bound, stated as an answer without places.
    fn derived(
        &mut self,
        scene: &Scene,
        object: ObjectIndex,
        outcome: SearchOutcome,
        budget: &Budget<'_>,
    ) -> Result<SurveyEntry, PlanError> {
        let (SearchOutcome::Least(set) | SearchOutcome::Interrupted(Some(set))) = outcome else {
            return Ok(timed_out(object));
        };
        let stated = Statement::no_space(scene, &set.derivation.order).bounded(scene, &set);
        let confirmed = confirm(&mut self.checker, scene, stated, budget)?;
        let lower_bound = confirmed.lower_bound;
        Ok(if confirmed.verdict == Some(Verdict::NoSpace) && confirmed.needed.is_some() {
            let optimal = lower_bound.map(|bound| bound == set.derivation.cost());
            SurveyEntry { object, verdict: SurveyVerdict::Relocate, lower_bound, optimal }
        } else {
            timed_out(object)
        })
    }

    fn deadlock(&mut self, scene: &Scene, object: ObjectIndex, budget: &Budget<'_>) -> Result<SurveyEntry, PlanError> {
        let holds = |lock: &Vec<ObjectIndex>| lock.binary_search(&object).is_ok();
        // An object that follows from nothing and is in no confirmed lock gets a check of its own.
        let lock = match self.locked.take() {
            Some(lock) if lock.is_empty() || holds(&lock) => lock,
            _ => self.confirmed_lock(scene, object, budget)?,
        };
        let lock = self.locked.insert(lock);
        Ok(if holds(lock) { deadlock(object) } else { timed_out(object) })
    }

    /// In index order.
    fn confirmed_lock(
        &mut self,
        scene: &Scene,
        object: ObjectIndex,
        budget: &Budget<'_>,
    ) -> Result<Vec<ObjectIndex>, PlanError> {
        let Ok(locks) = greatest_lock(scene, self.base, self.derivable, &[object], budget) else {
            return Ok(Vec::new());
        };
        let confirmed = confirm(&mut self.checker, scene, Statement::deadlock(scene, &locks), budget)?;
        Ok(if confirmed.verdict == Some(Verdict::Deadlock) { locks.blocked } else { Vec::new() })
    }
}

fn deadlock(object: ObjectIndex) -> SurveyEntry {
    SurveyEntry { object, verdict: SurveyVerdict::Deadlock, lower_bound: None, optimal: None }
}

fn timed_out(object: ObjectIndex) -> SurveyEntry {
    SurveyEntry { object, verdict: SurveyVerdict::TimedOut, lower_bound: Some(Cost::ZERO), optimal: Some(false) }
}
