//! Plans by the methods that a request names: runs them, has them judged by our own, and checks what is left.

use super::dispatch::{SearchLimits, Sought, base, seek};
use super::judge::{Found, judge};
use super::methods::{GraspModelName, Methods, PlacementMethod};
use super::raster::reposition;
use super::warning::Warning;
use crate::budget::{Budget, Interrupted};
use crate::check::{Checker, Fault, FaultCode, MAX_FAULTS};
use crate::knowledge::{KnowledgeBase, NoBase};
use crate::placement::Arrangement;
use crate::plan::{
    Answer, PLACEMENT_SHARE, PlanError, Question, SEARCH_SHARE, Settings, Statistics, arrange_least, arrange_one,
    confirmed_part, graspable_now, placed, plan, timed,
};
use crate::scene::{ObjectIndex, Scene};
use crate::search::{Derivation, LeastSet, Progress};
use crate::statement::{Statement, Verdict};

/// An answer with the warnings of our own planner about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Judged {
    /// The answer.
    pub answer: Answer,
    /// Warnings about it; none about one that is proven.
    pub warnings: Vec<Warning>,
}

impl From<Answer> for Judged {
    fn from(answer: Answer) -> Self {
        Self { answer, warnings: Vec::new() }
    }
}

impl Judged {
    /// What is served.
    pub fn statement(&self) -> &Statement {
        &self.answer.statement
    }

    /// True if the checker refuses a part of it: only answers by the paper's methods are served then.
    pub fn faulty(&self) -> bool {
        faulty(&self.warnings)
    }
}

fn faulty(warnings: &[Warning]) -> bool {
    warnings.iter().any(|warning| matches!(warning, Warning::Faulty(_)))
}

/// Plan for the scene's goal by these methods. Where all are our own, or the goal is no target, this is [`plan`]: the paper knows
/// no other goal. Otherwise the answer is judged by
/// our own methods, within the same time: bounds and locks are those of the swept finger, and objections of the checker or of
/// our search become warnings.
///
/// # Errors
/// As [`plan`].
pub fn plan_by(
    methods: &Methods,
    scene: &Scene,
    settings: &Settings,
    budget: &Budget<'_>,
    progress: Progress<'_>,
) -> Result<Judged, PlanError> {
    let Some(target) = scene.target().filter(|_| !methods.proven()) else {
        return plan(scene, settings, budget, progress).map(Judged::from);
    };
    let (mut statistics, mut warnings) = (Statistics::default(), Vec::new());
    let run = Run { methods, scene, target, settings, budget, progress };
    let found = run.find(&mut statistics, &mut warnings)?;
    let checked = || {
        let judged = judge((scene, target), methods, found, &mut warnings, budget);
        confirm(scene, judged, methods.unproven_by(), &mut warnings, budget)
    };
    let statement = timed(&mut statistics.check, budget, checked)?;
    Ok(Judged { answer: Answer { statement, statistics }, warnings })
}

struct Run<'a> {
    methods: &'a Methods,
    scene: &'a Scene,
    target: ObjectIndex,
    settings: &'a Settings,
    budget: &'a Budget<'a>,
    progress: Progress<'a>,
}

impl Run<'_> {
    fn find(&self, times: &mut Statistics, warnings: &mut Vec<Warning>) -> Result<Found, PlanError> {
        let Self { methods, scene, target, budget, .. } = *self;
        let searching = budget.share(SEARCH_SHARE);
        let base = match timed(&mut times.knowledge, budget, || base(methods, scene, target, &searching)) {
            Ok(base) => base,
            Err(NoBase::Interrupted) => return Ok(Statement::timed_out().into()),
            Err(NoBase::TooLarge) => return Err(PlanError::TooDense),
        };
        if base.free_now(target) {
            return graspable_now(scene, target, methods.grasp_model.model())
                .map(|grasp| Statement::graspable(grasp).into());
        }
        let search = || seek(methods.search, &base, target, &SearchLimits::default(), &searching, self.progress);
        let sought = timed(&mut times.search, budget, search);
        let stated = timed(&mut times.placement, budget, || match &sought {
            Sought::Nothing => Statement::unproven_deadlock(),
            Sought::TooLate => Statement::timed_out(),
            Sought::TooLarge => {
                warnings.push(Warning::SearchTooLarge);
                Statement::timed_out()
            }
            Sought::Least(set) => self.bounded(self.place(&base, &set.derivation, Placing::Least), set),
            Sought::Best(set) => self.bounded(self.place(&base, &set.derivation, Placing::Cut), set),
            Sought::Sequence(derivation) => self.place(&base, derivation, Placing::Sequence),
        });
        Ok(Found { stated, sought: Some((base, sought)) })
    }

    /// Knowledge by another grasp model proves nothing for the swept finger.
    fn bounded(&self, stated: Statement, set: &LeastSet) -> Statement {
        let proves = self.methods.grasp_model == GraspModelName::SweptFinger;
        if proves { stated.bounded(self.scene, set) } else { stated }
    }

    fn place(&self, base: &KnowledgeBase, derivation: &Derivation, placing: Placing) -> Statement {
        let without: fn(&Scene, &[ObjectIndex]) -> Statement = match placing {
            Placing::Least | Placing::Sequence => Statement::no_space,
            Placing::Cut => Statement::cut_off,
        };
        placed(self.scene, self.places(base, derivation, placing), derivation, without)
    }

    fn places(
        &self,
        base: &KnowledgeBase,
        derivation: &Derivation,
        placing: Placing,
    ) -> Result<Option<Arrangement>, Interrupted> {
        let (scene, model) = (self.scene, self.methods.grasp_model.model());
        let budget = self.budget.share(PLACEMENT_SHARE);
        let question = Question { scene, base, goal: self.target, model, objective: self.settings.objective };
        match (self.methods.placement, placing) {
            (PlacementMethod::Exact, Placing::Least) => arrange_least(&question, derivation.clone(), &budget),
            (PlacementMethod::Exact, _) => arrange_one(&question, derivation, &budget),
            (PlacementMethod::Raster(raster), _) => {
                reposition(scene, self.target, &derivation.order, &raster, model, &budget)
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

/// Checks the statement. A step that does not hold becomes a warning. A proof that does not hold is refused, since proofs are
/// our own. `setting` is named by a deadlock that can't be confirmed.
///
/// # Errors
/// [`PlanError::Refused`] if a landmark or a lock does not hold.
fn confirm(
    scene: &Scene,
    stated: Statement,
    setting: &'static str,
    warnings: &mut Vec<Warning>,
    budget: &Budget<'_>,
) -> Result<Statement, PlanError> {
    if stated.verdict == Some(Verdict::Deadlock) && stated.deadlock.is_none() {
        return Ok(stated);
    }
    let report = Checker::new(scene).check(&stated, budget);
    if report.faults.iter().any(|fault| fault.code.is_a_bug_of_ours()) {
        return Err(PlanError::Refused(report));
    }
    let mut confirmed = confirmed_part(scene, stated, &report);
    // A list of faults that was cut off may lack those of the proofs.
    let cut = report.faults.len() >= MAX_FAULTS;
    if confirmed.verdict == Some(Verdict::Relocate) && cut {
        confirmed = Statement { lower_bound: None, landmarks: None, optimal: None, ..confirmed };
    }
    if confirmed.deadlock.is_some() && (cut || report.has(FaultCode::LockUnconfirmed)) {
        confirmed.deadlock = None;
        warnings.push(Warning::UnprovenDeadlock { enough: None, setting });
    }
    if report.has(FaultCode::WrongNeeded) {
        confirmed.needed = None;
    }
    let told = |fault: &Fault| !fault.code.means_late() || fault.code == FaultCode::ReplayUnconfirmed;
    warnings.extend(report.faults.into_iter().filter(told).map(Warning::Faulty));
    if faulty(warnings) {
        confirmed.optimal = None;
    }
    Ok(confirmed)
}
