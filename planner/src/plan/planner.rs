//! Runs knowledge, search, placement and check.

use core::time::Duration;

use super::answer::{Answer, LowerBound, Plan, Statistics, Unplanned, Verdict};
use super::check::Checker;
use super::confirm::{PlanError, confirm, confirm_unproven};
use super::couple::{Question, arrange_least, arrange_one};
use super::judge::{judge, unproven_by};
use super::settings::{GraspModel, PlacementMethod, Settings};
use super::sought::{Sought, seek};
use super::verdicts::{graspable_now, prove_deadlock};
use super::warning::Warning;
use crate::budget::{Budget, Interrupted};
use crate::knowledge::{KnowledgeBase, NoBase};
use crate::paper::reposition;
use crate::placement::Arrangement;
use crate::scene::Scene;
use crate::search::{Derivation, Progress, SILENT};

/// The share of the time for knowledge and search.
const SEARCH_SHARE: f64 = 0.6;
/// The share of the rest for placement; the last part is the checker's.
const PLACEMENT_SHARE: f64 = 0.75;

/// Plan for the scene's target. All parts look at the budget; when it ends, the best known answer is returned.
///
/// An answer by the paper's methods is then judged by our own, within the same time. Bounds and locks are those of the
/// swept finger; objections of the checker or the exact search become warnings.
///
/// # Errors
/// [`PlanError::TooDense`] if the knowledge base would be too large, [`PlanError::Refused`] if the answer fails its check.
pub fn plan(scene: &Scene, settings: &Settings, budget: &Budget<'_>) -> Result<Answer, PlanError> {
    plan_reporting(scene, settings, budget, SILENT)
}

/// [`plan`], reporting incumbents and bounds of the search. They are unchecked and ignore places.
///
/// # Errors
/// As [`plan`].
pub fn plan_reporting(
    scene: &Scene,
    settings: &Settings,
    budget: &Budget<'_>,
    progress: Progress<'_>,
) -> Result<Answer, PlanError> {
    let statistics = Statistics::default();
    let mut planner = Planner { scene, settings, budget, progress, statistics, warnings: Vec::new(), sought: None };
    let verdict = planner.verdict()?;
    let Planner { mut statistics, mut warnings, sought, .. } = planner;
    let before = budget.elapsed();
    let verdict = if settings.proven() {
        confirm(&mut Checker::new(scene), scene, verdict, budget)?
    } else {
        let judged = judge(scene, settings, verdict, sought, &mut warnings, budget);
        confirm_unproven(scene, judged, unproven_by(settings), &mut warnings, budget)?
    };
    statistics.check = budget.elapsed().saturating_sub(before);
    Ok(Answer { verdict, warnings, statistics })
}

struct Planner<'a> {
    scene: &'a Scene,
    settings: &'a Settings,
    budget: &'a Budget<'a>,
    progress: Progress<'a>,
    statistics: Statistics,
    warnings: Vec<Warning>,
    /// The search's result and its base, for the judge.
    sought: Option<(KnowledgeBase, Sought)>,
}

impl Planner<'_> {
    fn verdict(&mut self) -> Result<Verdict, PlanError> {
        let started = self.budget.elapsed();
        let search_budget = self.budget.share(SEARCH_SHARE);
        let base = self.settings.search.base(self.scene, self.settings.grasp_model, &search_budget);
        self.statistics.knowledge = self.since(started);
        let base = match base {
            Ok(base) => base,
            Err(NoBase::Interrupted) => return Ok(Verdict::TimedOut(Unplanned::default())),
            Err(NoBase::TooLarge) => return Err(PlanError::TooDense),
        };
        if base.options(self.scene.target()).any(<[_]>::is_empty) {
            return graspable_now(self.scene, self.settings.grasp_model.shadow());
        }
        let started = self.budget.elapsed();
        let sought = seek(self.settings.search, &base, self.scene.target(), &search_budget, self.progress);
        self.statistics.search = self.since(started);
        let verdict = match &sought {
            Sought::Nothing if self.settings.proven() => self.deadlock(&base),
            Sought::Nothing => Ok(Verdict::Deadlock(None)),
            Sought::TooLate => Ok(Verdict::TimedOut(Unplanned::default())),
            Sought::TooLarge => {
                self.warnings.push(Warning::SearchTooLarge);
                Ok(Verdict::TimedOut(Unplanned::default()))
            }
            Sought::Least(known) => Ok(self.place(&base, &known.derivation, Some(known.into()), Placing::Least)),
            Sought::Best(known) => Ok(self.place(&base, &known.derivation, Some(known.into()), Placing::Cut)),
            Sought::Sequence(derivation) => Ok(self.place(&base, derivation, None, Placing::Sequence)),
        };
        self.sought = Some((base, sought));
        verdict
    }

    fn since(&self, started: Duration) -> Duration {
        self.budget.elapsed().saturating_sub(started)
    }

    fn deadlock(&mut self, relevant: &KnowledgeBase) -> Result<Verdict, PlanError> {
        let started = self.budget.elapsed();
        let found = prove_deadlock(self.scene, relevant, &self.budget.share(PLACEMENT_SHARE));
        self.statistics.knowledge += self.since(started);
        match found {
            Ok(lock) => Ok(Verdict::Deadlock(Some(lock))),
            Err(NoBase::Interrupted) => Ok(Verdict::TimedOut(Unplanned::default())),
            Err(NoBase::TooLarge) => Err(PlanError::TooDense),
        }
    }

    fn place(
        &mut self,
        base: &KnowledgeBase,
        derivation: &Derivation,
        bound: Option<LowerBound>,
        placing: Placing,
    ) -> Verdict {
        let started = self.budget.elapsed();
        let budget = self.budget.share(PLACEMENT_SHARE);
        let model = self.settings.grasp_model.shadow();
        let question = Question { scene: self.scene, base, model, objective: self.settings.objective };
        let found = match (self.settings.placement, placing) {
            (PlacementMethod::Exact, Placing::Least) => arrange_least(&question, derivation.clone(), &budget),
            (PlacementMethod::Exact, _) => arrange_one(&question, &derivation.order, &budget),
            (PlacementMethod::Raster(raster), _) => reposition(self.scene, &derivation.order, &raster, model, &budget),
        };
        self.statistics.placement = self.since(started);
        // Knowledge by another grasp model proves nothing for the swept finger.
        let bound = bound.filter(|_| self.settings.grasp_model == GraspModel::SweptFinger);
        match found {
            Ok(Some(Arrangement { relocations, target_grasp })) => {
                Verdict::Relocate(Plan { relocations, target_grasp, bound })
            }
            Ok(None) if placing != Placing::Cut => {
                Verdict::NoSpace(Unplanned { bound, needed: Some(derivation.order.clone()) })
            }
            Ok(None) | Err(Interrupted) => {
                Verdict::TimedOut(Unplanned { bound, needed: Some(derivation.order.clone()) })
            }
        }
    }
}

/// The sets to place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Placing {
    /// A least set, and further sets after it.
    Least,
    /// The best set of a search that was cut off.
    Cut,
    /// The one sequence of a search of the paper.
    Sequence,
}
