//! Every movable object as the target: logic only, without places.

use super::confirm::{PlanError, confirm};
use super::reasons::{graspable_now, greatest_lock};
use crate::budget::Budget;
use crate::check::Checker;
use crate::cost::Cost;
use crate::knowledge::{Derivable, KnowledgeBase, NoBase, SweptFinger, complete, derivable};
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

/// Every movable object as the target, in index order. Objects undecided when the budget ends are `TimedOut`.
///
/// # Errors
/// [`PlanError::TooDense`] if the knowledge base would be too large, [`PlanError::Refused`] if an entry's proof fails its check.
pub fn survey(scene: &Scene, budget: &Budget<'_>) -> Result<Vec<SurveyEntry>, PlanError> {
    let movable = scene.indices().filter(|&object| !scene.object(object).fixed());
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
        if !self.derivable.derives(object) {
            return self.deadlock(&scene, budget);
        }
        if self.base.free_now(object) {
            let stated = Statement::graspable(graspable_now(&scene, &SweptFinger)?);
            return Ok(match confirm(&mut self.checker, &scene, stated, budget)?.verdict {
                Some(Verdict::Graspable) => SurveyEntry {
                    object,
                    verdict: SurveyVerdict::Graspable,
                    lower_bound: Some(Cost::ZERO),
                    optimal: Some(true),
                },
                _ => timed_out(object),
            });
        }
        self.derive(&scene, budget)
    }

    /// A derivation with its bound, stated as an answer without places.
    fn derive(&mut self, scene: &Scene, budget: &Budget<'_>) -> Result<SurveyEntry, PlanError> {
        let object = scene.target();
        let (SearchOutcome::Least(set) | SearchOutcome::Interrupted(Some(set))) =
            least(self.base, object, &Restriction::default(), budget)
        else {
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

    fn deadlock(&mut self, scene: &Scene, budget: &Budget<'_>) -> Result<SurveyEntry, PlanError> {
        let object = scene.target();
        let holds = |lock: &Vec<ObjectIndex>| lock.binary_search(&object).is_ok();
        // An object that follows from nothing and is in no confirmed lock gets a check of its own.
        let lock = match self.locked.take() {
            Some(lock) if lock.is_empty() || holds(&lock) => lock,
            _ => self.confirmed_lock(scene, budget)?,
        };
        let lock = self.locked.insert(lock);
        Ok(if holds(lock) {
            SurveyEntry { object, verdict: SurveyVerdict::Deadlock, lower_bound: None, optimal: None }
        } else {
            timed_out(object)
        })
    }

    /// In index order.
    fn confirmed_lock(&mut self, scene: &Scene, budget: &Budget<'_>) -> Result<Vec<ObjectIndex>, PlanError> {
        let Ok(locks) = greatest_lock(scene, self.base, self.derivable, budget) else { return Ok(Vec::new()) };
        let confirmed = confirm(&mut self.checker, scene, Statement::deadlock(scene, &locks), budget)?;
        Ok(if confirmed.verdict == Some(Verdict::Deadlock) { locks.blocked } else { Vec::new() })
    }
}

fn timed_out(object: ObjectIndex) -> SurveyEntry {
    SurveyEntry { object, verdict: SurveyVerdict::TimedOut, lower_bound: Some(Cost::ZERO), optimal: Some(false) }
}
