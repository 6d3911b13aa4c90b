//! The main loop: knowledge, search, placement, check. It knows only what is proven.

use super::answer::{Answer, Statistics, timed};
use super::attempt::{Question, free_candidates};
use super::clearing;
use super::confirm::{PlanError, confirm};
use super::couple::{arrange_least, arrange_one};
use super::reasons::{graspable_now, prove_deadlock};
use super::settings::Settings;
use super::shares::{PLACEMENT_SHARE, SEARCH_SHARE};
use crate::budget::{Budget, Interrupted};
use crate::check::Checker;
use crate::knowledge::{NoBase, SweptFinger, of_goal};
use crate::placement::Arrangement;
use crate::scene::{Goal, ObjectIndex, Scene};
use crate::search::{Derivation, Memory, Progress, Restriction, SearchOutcome, least_within};
use crate::statement::{Statement, Verdict};

/// Plan for the scene's goal. All parts look at the budget; when it ends, the best known answer is returned. `progress` is
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

/// The statement where time ended before anything was known: of a clearing no steps, of any other goal the trivial bound.
pub fn nothing_in_time(scene: &Scene) -> Statement {
    match scene.goal() {
        Goal::Clear => {
            let stated = Statement::uncleared(scene);
            // Where there is nothing to take away, nothing is open.
            Statement { proven: Some(stated.verdict == Some(Verdict::Cleared)), ..stated }
        }
        _ => Statement::timed_out(),
    }
}

/// The statement to check.
fn stated(
    scene: &Scene,
    settings: &Settings,
    budget: &Budget<'_>,
    progress: Progress<'_>,
    times: &mut Statistics,
) -> Result<Statement, PlanError> {
    if *scene.goal() == Goal::Clear {
        return clearing::stated(scene, budget, times);
    }
    let searching = budget.share(SEARCH_SHARE);
    let known = || of_goal(scene, &SweptFinger, &searching);
    let (base, goal) = match timed(&mut times.knowledge, budget, known) {
        Ok(known) => known,
        Err(NoBase::Interrupted) => return Ok(Statement::timed_out()),
        Err(NoBase::TooLarge) => return Err(PlanError::TooDense),
    };
    if base.free_now(goal) {
        let free = free_candidates(scene, &SweptFinger, &[]);
        let target = free.first().or(scene.goal().candidates().first()).copied().unwrap_or(goal);
        return graspable_now(scene, target, &SweptFinger).map(|grasp| Statement::graspable(grasp).of(scene, target));
    }
    // That each of these moves is no news to the search, which finds landmarks one by one.
    let wanted = Restriction { required: scene.goal().wanted_away().to_vec(), ..Restriction::default() };
    let memory = Memory::default();
    let search = || least_within(&memory, &base, goal, &wanted, &searching, progress);
    let outcome = timed(&mut times.search, budget, search);
    let rest = budget.share(PLACEMENT_SHARE);
    let question = Question { scene, base: &base, goal, model: &SweptFinger, objective: settings.objective };
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
    let stated = match found {
        Ok(Some(plan)) => return Statement::relocate(scene, &plan),
        Ok(None) => without(scene, &derivation.order),
        Err(Interrupted) => Statement::cut_off(scene, &derivation.order),
    };
    match free_candidates(scene, &SweptFinger, &derivation.order).first() {
        Some(&target) => stated.of(scene, target),
        None => stated,
    }
}
