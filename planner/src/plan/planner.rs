//! The main loop: knowledge, search, placement, check. It knows only what is proven.

use super::answer::{Answer, Statistics, timed};
use super::confirm::{PlanError, confirm};
use super::couple::{Question, arrange_least, arrange_one};
use super::reasons::{graspable_now, prove_deadlock};
use super::settings::Settings;
use crate::budget::{Budget, Interrupted};
use crate::check::Checker;
use crate::knowledge::{NoBase, SweptFinger, relevant};
use crate::placement::Arrangement;
use crate::scene::{ObjectIndex, Scene};
use crate::search::{Derivation, Memory, Progress, Restriction, SearchOutcome, least_within};
use crate::statement::Statement;

/// The share of the time for knowledge and search.
pub(crate) const SEARCH_SHARE: f64 = 0.6;
/// The share of the rest for placement, or for the locks of a deadlock; the last part is the checker's.
pub(crate) const PLACEMENT_SHARE: f64 = 0.75;

/// Plan for the scene's target. All parts look at the budget; when it ends, the best known answer is returned. `progress` is
/// told of the search's incumbents and bounds; they are unchecked and ignore places.
///
/// # Errors
/// [`PlanError::TooDense`] if the knowledge base would be too large, [`PlanError::Refused`] if the answer fails its check.
pub fn plan(
    scene: &Scene,
    settings: &Settings,
    budget: &Budget<'_>,
    progress: Progress<'_>,
) -> Result<Answer, PlanError> {
    let mut statistics = Statistics::default();
    let stated = stated(scene, settings, budget, progress, &mut statistics)?;
    let checked = || confirm(&mut Checker::new(scene), scene, stated, budget);
    let statement = timed(&mut statistics.check, budget, checked)?;
    Ok(Answer { statement, statistics })
}

/// The statement to check.
fn stated(
    scene: &Scene,
    settings: &Settings,
    budget: &Budget<'_>,
    progress: Progress<'_>,
    times: &mut Statistics,
) -> Result<Statement, PlanError> {
    let (target, searching) = (scene.target(), budget.share(SEARCH_SHARE));
    let known = || relevant(scene, target, &SweptFinger, &searching);
    let base = match timed(&mut times.knowledge, budget, known) {
        Ok(base) => base,
        Err(NoBase::Interrupted) => return Ok(Statement::timed_out()),
        Err(NoBase::TooLarge) => return Err(PlanError::TooDense),
    };
    if base.free_now(target) {
        return graspable_now(scene, &SweptFinger).map(Statement::graspable);
    }
    let (memory, whole) = (Memory::default(), Restriction::default());
    let search = || least_within(&memory, &base, target, &whole, &searching, progress);
    let outcome = timed(&mut times.search, budget, search);
    let rest = budget.share(PLACEMENT_SHARE);
    let question = Question { scene, base: &base, model: &SweptFinger, objective: settings.objective };
    match outcome {
        SearchOutcome::Least(set) => {
            let place = || arrange_least(&question, set.derivation.clone(), &rest);
            let found = timed(&mut times.placement, budget, place);
            Ok(placed(scene, found, &set.derivation, Statement::no_space).bounded(scene, &set))
        }
        SearchOutcome::Interrupted(Some(set)) => {
            let place = || arrange_one(&question, &set.derivation, &rest);
            let found = timed(&mut times.placement, budget, place);
            Ok(placed(scene, found, &set.derivation, Statement::cut_off).bounded(scene, &set))
        }
        SearchOutcome::Interrupted(None) => Ok(Statement::timed_out()),
        SearchOutcome::Underivable => match timed(&mut times.knowledge, budget, || prove_deadlock(scene, &base, &rest))
        {
            Ok(locks) => Ok(Statement::deadlock(scene, &locks)),
            Err(NoBase::Interrupted) => Ok(Statement::timed_out()),
            Err(NoBase::TooLarge) => Err(PlanError::TooDense),
        },
    }
}

/// States the places found for a derivation; `without` states that there are none.
pub(crate) fn placed(
    scene: &Scene,
    found: Result<Option<Arrangement>, Interrupted>,
    derivation: &Derivation,
    without: fn(&Scene, &[ObjectIndex]) -> Statement,
) -> Statement {
    match found {
        Ok(Some(plan)) => Statement::relocate(scene, &plan),
        Ok(None) => without(scene, &derivation.order),
        Err(Interrupted) => Statement::cut_off(scene, &derivation.order),
    }
}
