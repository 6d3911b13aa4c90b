//! Couples knowledge, search and placement, and lets nothing leave unchecked.

use core::time::Duration;

use super::answer::{Answer, Deadlock, LowerBound, Plan, Statistics, Unplanned, Verdict};
use super::check::{Fault, FaultCode, Report, check};
use super::claim::Claim;
use super::couple::{Question, arrange_least, arrange_one};
use super::settings::Settings;
use crate::budget::{Budget, Interrupted};
use crate::knowledge::{KnowledgeBase, close, complete, fixed_blockers, lock, relevant};
use crate::placement::Arrangement;
use crate::scene::{ObjectIndex, Scene};
use crate::search::{LeastSet, Outcome, Restriction, least};

/// The planner failed.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// The checker refused the planner's own answer: a bug. The answer is not served.
    #[error("the answer did not pass its check")]
    Refused(Report),
}

/// The share of the time after which knowledge and search hand over what they have.
const SEARCH_SHARE: f64 = 0.6;
/// The share of the rest after which placement does; the last part is the checker's.
const PLACEMENT_SHARE: f64 = 0.75;

/// Plan for the scene's target. Every part looks at the budget; where it ends first, the best that is known is served.
///
/// # Errors
/// [`PlanError::Refused`] if the answer fails its check.
pub fn plan(scene: &Scene, settings: &Settings, budget: &Budget<'_>) -> Result<Answer, PlanError> {
    let mut statistics = Statistics::default();
    let verdict = Planner { scene, settings, budget, statistics: &mut statistics }.verdict();
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
    fn verdict(&mut self) -> Verdict {
        let started = self.budget.elapsed();
        let search_budget = self.budget.share(SEARCH_SHARE);
        let target = self.scene.target();
        let base = relevant(self.scene, target, &search_budget);
        self.statistics.knowledge = self.since(started);
        let Ok(base) = base else { return Verdict::TimedOut(Unplanned::default()) };
        if base.options(target).any(<[_]>::is_empty) {
            return self.graspable();
        }
        let started = self.budget.elapsed();
        let outcome = least(&base, target, &Restriction::default(), &search_budget);
        self.statistics.search = self.since(started);
        match outcome {
            Outcome::Underivable => self.deadlock(),
            Outcome::Interrupted(None) => Verdict::TimedOut(Unplanned::default()),
            Outcome::Interrupted(Some(known)) => self.place(&base, known, false),
            Outcome::Least(known) => self.place(&base, known, true),
        }
    }

    fn since(&self, started: Duration) -> Duration {
        self.budget.elapsed().saturating_sub(started)
    }

    fn graspable(&self) -> Verdict {
        let task = Question { scene: self.scene, base: &KnowledgeBase::new(), objective: self.settings.objective };
        match arrange_one(&task, &[], self.budget) {
            Ok(Some(arrangement)) => Verdict::Graspable(arrangement.target_grasp),
            _ => Verdict::TimedOut(Unplanned::default()),
        }
    }

    fn deadlock(&mut self) -> Verdict {
        let started = self.budget.elapsed();
        let found = greatest_lock(self.scene, &self.budget.share(PLACEMENT_SHARE));
        self.statistics.knowledge += self.since(started);
        found.map_or_else(|Interrupted| Verdict::TimedOut(Unplanned::default()), Verdict::Deadlock)
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

/// Why the target, which must not follow, does not.
fn greatest_lock(scene: &Scene, budget: &Budget<'_>) -> Result<Deadlock, Interrupted> {
    let base = complete(scene, budget)?;
    let closure = close(&base, |_| false, budget)?;
    let lock = lock(&base, &closure, scene.target(), budget);
    // A movable object without options is held by fixed ones alone.
    let stuck = |object: &ObjectIndex| !closure.derives(*object) && !scene.object(*object).fixed();
    let mut blocked: Vec<ObjectIndex> = scene.indices().filter(stuck).collect();
    blocked.extend(fixed_blockers(scene, &blocked));
    blocked.sort_unstable();
    Ok(Deadlock { blocked, core: lock.core })
}

/// The verdict as far as the checker confirms it. What it could not confirm in time is not claimed.
fn confirm(scene: &Scene, verdict: Verdict, budget: &Budget<'_>) -> Result<Verdict, PlanError> {
    let answer = Answer { verdict, statistics: Statistics::default() };
    let report = check(scene, &Claim::of(scene, &answer), budget);
    let late = |fault: &Fault| is_late(fault.code);
    if report.faults.iter().any(|fault| !late(fault)) {
        return Err(PlanError::Refused(report));
    }
    let unconfirmed = |code| report.faults.iter().any(|fault| fault.code == code);
    let mut verdict = answer.verdict;
    if let Some(bound) = verdict.bound_mut()
        && unconfirmed(FaultCode::BoundUnconfirmed)
    {
        bound.cost = report.proven_bound;
    }
    if unconfirmed(FaultCode::LockUnconfirmed) || unconfirmed(FaultCode::ReplayUnconfirmed) {
        let bound = verdict.bound_mut().map(core::mem::take).unwrap_or_default();
        verdict = Verdict::TimedOut(Unplanned { bound, needed: None });
    }
    if unconfirmed(FaultCode::NeededUnconfirmed)
        && let Verdict::NoSpace(unplanned) | Verdict::TimedOut(unplanned) = &mut verdict
    {
        unplanned.needed = None;
    }
    Ok(verdict)
}

/// True if the code says that time ran out, not that anything is wrong.
fn is_late(code: FaultCode) -> bool {
    matches!(
        code,
        FaultCode::BoundUnconfirmed
            | FaultCode::LockUnconfirmed
            | FaultCode::NeededUnconfirmed
            | FaultCode::ReplayUnconfirmed
    )
}
