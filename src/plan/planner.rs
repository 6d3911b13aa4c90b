//! Couples knowledge, search and placement, and lets nothing leave unchecked.

use core::time::Duration;

use super::answer::{Answer, Deadlock, LowerBound, Plan, Statistics, Unplanned, Verdict};
use super::check::{Fault, FaultCode, Report};
use super::confirm::{PlanError, confirm};
use super::couple::{Question, arrange_least, arrange_one};
use super::settings::Settings;
use crate::budget::{Budget, Interrupted};
use crate::knowledge::{Closure, KnowledgeBase, Lock, NoBase, close, completed, fixed_blockers, lock, relevant};
use crate::placement::{Arrangement, grasp_in_place};
use crate::scene::Scene;
use crate::search::{LeastSet, Outcome, Restriction, least};

/// The share of the time after which knowledge and search hand over what they have.
const SEARCH_SHARE: f64 = 0.6;
/// The share of the rest after which placement does; the last part is the checker's.
const PLACEMENT_SHARE: f64 = 0.75;

/// Plan for the scene's target. Every part looks at the budget; where it ends first, the best that is known is served.
///
/// # Errors
/// [`PlanError::TooDense`] if the knowledge base would be too large, [`PlanError::Refused`] if the answer fails its check.
pub fn plan(scene: &Scene, settings: &Settings, budget: &Budget<'_>) -> Result<Answer, PlanError> {
    let mut statistics = Statistics::default();
    let verdict = Planner { scene, settings, budget, statistics: &mut statistics }.verdict()?;
    let before = budget.elapsed();
    let verdict = confirm(scene, verdict, budget)?;
    statistics.check = budget.elapsed().saturating_sub(before);
    Ok(Answer { verdict, statistics })
}

struct Planner<'a> {
    scene: &'a Scene,
    settings: &'a Settings,
    budget: &'a Budget<'a>,
    statistics: &'a mut Statistics,
}

impl Planner<'_> {
    fn verdict(&mut self) -> Result<Verdict, PlanError> {
        let started = self.budget.elapsed();
        let search_budget = self.budget.share(SEARCH_SHARE);
        let target = self.scene.target();
        let base = relevant(self.scene, target, &search_budget);
        self.statistics.knowledge = self.since(started);
        let base = match base {
            Ok(base) => base,
            Err(NoBase::Interrupted) => return Ok(Verdict::TimedOut(Unplanned::default())),
            Err(NoBase::TooLarge) => return Err(PlanError::TooDense),
        };
        if base.options(target).any(<[_]>::is_empty) {
            return graspable_now(self.scene);
        }
        let started = self.budget.elapsed();
        let outcome = least(&base, target, &Restriction::default(), &search_budget);
        self.statistics.search = self.since(started);
        match outcome {
            Outcome::Underivable => self.deadlock(&base),
            Outcome::Interrupted(None) => Ok(Verdict::TimedOut(Unplanned::default())),
            Outcome::Interrupted(Some(known)) => Ok(self.place(&base, known, false)),
            Outcome::Least(known) => Ok(self.place(&base, known, true)),
        }
    }

    fn since(&self, started: Duration) -> Duration {
        self.budget.elapsed().saturating_sub(started)
    }

    fn deadlock(&mut self, relevant: &KnowledgeBase) -> Result<Verdict, PlanError> {
        let started = self.budget.elapsed();
        let budget = self.budget.share(PLACEMENT_SHARE);
        // The relevant part of the base would show a lock, but not the greatest.
        let found = completed(self.scene, relevant, &budget).and_then(|base| {
            let closure = close(&base, |_| false, &budget)?;
            Ok(greatest_lock(self.scene, &base, &closure, &budget)?)
        });
        self.statistics.knowledge += self.since(started);
        match found {
            Ok(lock) => Ok(Verdict::Deadlock(lock)),
            Err(NoBase::Interrupted) => Ok(Verdict::TimedOut(Unplanned::default())),
            Err(NoBase::TooLarge) => Err(PlanError::TooDense),
        }
    }

    fn place(&mut self, base: &KnowledgeBase, known: LeastSet, exact: bool) -> Verdict {
        let started = self.budget.elapsed();
        let budget = self.budget.share(PLACEMENT_SHARE);
        let question = Question { scene: self.scene, base, objective: self.settings.objective };
        let found = if exact {
            arrange_least(&question, known.derivation.clone(), &budget)
        } else {
            arrange_one(&question, &known.derivation.order, &budget)
        };
        self.statistics.placement = self.since(started);
        let bound = LowerBound { cost: known.bound, landmarks: known.landmarks };
        match found {
            Ok(Some(Arrangement { relocations, target_grasp })) => {
                Verdict::Relocate(Plan { relocations, target_grasp, bound })
            }
            Ok(None) if exact => Verdict::NoSpace(Unplanned { bound, needed: Some(known.derivation.order) }),
            Ok(None) | Err(Interrupted) => Verdict::TimedOut(Unplanned { bound, needed: Some(known.derivation.order) }),
        }
    }
}

/// The grasp of a target that knowledge says is graspable as the table stands.
///
/// # Errors
/// [`PlanError::Refused`] if no yaw is free: then knowledge and geometry contradict each other, a bug.
pub(super) fn graspable_now(scene: &Scene) -> Result<Verdict, PlanError> {
    grasp_in_place(scene, scene.target()).map(Verdict::Graspable).ok_or_else(|| {
        let fault = Fault {
            code: FaultCode::TargetBlocked,
            step: None,
            object: Some(scene.object(scene.target()).id().to_owned()),
            detail: "said to be graspable as the table stands, but no yaw is free".to_owned(),
        };
        PlanError::Refused(Report { faults: vec![fault], ..Report::default() })
    })
}

/// Why the target, which does not follow, does not: from the complete base and its closure.
pub(super) fn greatest_lock(
    scene: &Scene,
    base: &KnowledgeBase,
    closure: &Closure,
    budget: &Budget<'_>,
) -> Result<Deadlock, Interrupted> {
    let Lock { mut blocked, core } = lock(base, closure, scene.target(), budget)?;
    blocked.extend(fixed_blockers(scene, &blocked, budget)?);
    blocked.sort_unstable();
    Ok(Deadlock { blocked, core })
}
