//! One scene, all methods, both grasp models.

use core::time::Duration;

use super::error::{EpisodeError, ExperimentError};
use super::papers_cases::PapersCase;
use super::papers_scene::{PapersScene, complete_base, papers_scene};
use super::timed_search::{SearchEnding, TimedSearch, timed_search};
use super::workers::Patience;
use singulate_planner::budget::{Budget, Clock};
use singulate_planner::cost::Cost;
use singulate_planner::knowledge::KnowledgeBase;
use singulate_planner::paper::{GraspModelName, Judged, Methods, SearchMethod, plan_by};
use singulate_planner::plan::Settings;
use singulate_planner::scene::{ObjectIndex, Scene};
use singulate_planner::search::SILENT;
use singulate_planner::statement::{Statement, Verdict};

/// The results of one episode of Table I.
#[derive(Debug)]
pub(super) struct Episode {
    pub(super) sector: OnBase,
    pub(super) swept_finger: OnBase,
    /// Our planner's answer with its default settings: places and check included.
    pub(super) judged: Judged,
    /// Its time.
    pub(super) planning: Duration,
}

/// The searches on the base of one grasp model.
#[derive(Debug)]
pub(super) struct OnBase {
    /// The time for the base.
    pub(super) knowledge: Duration,
    /// Only if requested.
    pub(super) baseline: Option<TimedSearch>,
    pub(super) lobs: TimedSearch,
    /// Its ending is a proof unless it timed out.
    pub(super) ours: TimedSearch,
}

impl OnBase {
    fn new(knowledge: Duration, base: &KnowledgeBase, target: ObjectIndex, patience: &Patience<'_>) -> Self {
        let run = |method| timed_search(method, base, target, patience);
        Self { knowledge, baseline: None, lobs: run(SearchMethod::Lobs), ours: run(SearchMethod::Landmarks) }
    }

    /// The result of a method.
    pub(super) fn search(&self, method: SearchMethod) -> Option<&TimedSearch> {
        match method {
            SearchMethod::ForwardAstar => self.baseline.as_ref(),
            SearchMethod::Lobs => Some(&self.lobs),
            SearchMethod::Landmarks => Some(&self.ours),
        }
    }
}

/// The episode of one seed, without the baseline.
pub(super) fn episode(case: &PapersCase, seed: u64, patience: &Patience<'_>) -> Result<Episode, ExperimentError> {
    let failed = |cause| ExperimentError { objects: case.objects, seed, cause };
    let PapersScene { scene, target, sector, knowledge } = papers_scene(case, seed, patience)?;
    let sector = OnBase::new(knowledge, &sector, target, patience);

    let watch = patience.watch();
    let base = complete_base(case, seed, &scene, GraspModelName::SweptFinger, &watch)?;
    let mut swept_finger = OnBase::new(watch.elapsed(), &base, target, patience);

    let (judged, planning) = planned(&scene, &Methods::default(), patience).map_err(failed)?;
    for on_base in [&sector, &swept_finger] {
        not_refuted(on_base.lobs.ending, on_base.ours.ending).map_err(failed)?;
    }
    let statement = judged.statement();
    if !agree(swept_finger.ours.ending, statement) {
        return Err(failed(EpisodeError::Contradicted(swept_finger.ours.ending)));
    }
    // By the swept finger only checked plans count as ours.
    if statement.verdict == Some(Verdict::TimedOut) {
        (swept_finger.ours.ending, swept_finger.ours.time) = (SearchEnding::Late, patience.limit);
    }
    Ok(Episode { sector, swept_finger, judged, planning })
}

/// The baseline in the scene of one seed: by the sector model, then by the swept finger.
pub(super) fn baseline(
    case: &PapersCase,
    seed: u64,
    patience: &Patience<'_>,
) -> Result<[TimedSearch; 2], ExperimentError> {
    let PapersScene { scene, target, sector, .. } = papers_scene(case, seed, patience)?;
    let swept_finger = complete_base(case, seed, &scene, GraspModelName::SweptFinger, &patience.watch())?;
    Ok([sector, swept_finger].map(|base| timed_search(SearchMethod::ForwardAstar, &base, target, patience)))
}

impl Episode {
    /// What our planner states.
    pub(super) fn statement(&self) -> &Statement {
        self.judged.statement()
    }

    /// Add the baseline's result for the same scene.
    pub(super) fn add(&mut self, baseline: [TimedSearch; 2]) -> Result<(), EpisodeError> {
        for (on_base, search) in [&mut self.sector, &mut self.swept_finger].into_iter().zip(baseline) {
            not_refuted(search.ending, on_base.ours.ending)?;
            on_base.baseline = Some(search);
        }
        Ok(())
    }
}

/// The planner's answer, and its time.
pub(super) fn planned(
    scene: &Scene,
    methods: &Methods,
    patience: &Patience<'_>,
) -> Result<(Judged, Duration), EpisodeError> {
    let watch = patience.watch();
    let budget = Budget::new(&watch, patience.limit);
    let judged = plan_by(methods, scene, &Settings::default(), &budget, SILENT).map_err(EpisodeError::Plan)?;
    Ok((judged, watch.elapsed()))
}

/// Fails if another search beats our proof: every search finds derivations, so the fault would be in our proof.
fn not_refuted(ending: SearchEnding, proven: SearchEnding) -> Result<(), EpisodeError> {
    let refuted = match (ending, proven) {
        (SearchEnding::Sequence(found), SearchEnding::Sequence(least)) => found < least,
        (SearchEnding::Sequence(_), SearchEnding::Deadlock) => true,
        _ => false,
    };
    if refuted { Err(EpisodeError::Refuted { ending, proven }) } else { Ok(()) }
}

/// True if search and planner agree, as far as each got.
fn agree(ours: SearchEnding, stated: &Statement) -> bool {
    let at_least = |cost: Option<Cost>, least| cost.is_some_and(|cost| cost.get() >= least);
    let at_most = |bound: Option<Cost>, least| bound.is_some_and(|bound| bound.get() <= least);
    let (cost, bound) = (stated.cost, stated.lower_bound);
    match (ours, stated.verdict) {
        (_, None | Some(Verdict::Cleared | Verdict::PartlyCleared)) => false,
        (SearchEnding::Late | SearchEnding::TooLarge, _) | (_, Some(Verdict::TimedOut)) => true,
        (SearchEnding::Deadlock, verdict) => verdict == Some(Verdict::Deadlock),
        (SearchEnding::Sequence(least), Some(Verdict::Graspable)) => least == 0,
        (SearchEnding::Sequence(least), Some(Verdict::Relocate)) => at_least(cost, least) && at_most(bound, least),
        (SearchEnding::Sequence(least), Some(Verdict::NoSpace)) => at_most(bound, least),
        (SearchEnding::Sequence(_), Some(Verdict::Deadlock)) => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shorter_sequence_or_one_in_spite_of_a_deadlock_refutes_our_proof() {
        let check = |other, ours, refuted| assert_eq!(not_refuted(other, ours).is_err(), refuted);
        check(SearchEnding::Sequence(2), SearchEnding::Sequence(3), true);
        check(SearchEnding::Sequence(2), SearchEnding::Deadlock, true);
        check(SearchEnding::Sequence(3), SearchEnding::Sequence(3), false);
        check(SearchEnding::Deadlock, SearchEnding::Sequence(3), false);
        check(SearchEnding::Sequence(2), SearchEnding::Late, false);
    }

    #[test]
    fn a_planner_that_contradicts_the_search_is_noticed() {
        let late = Statement::timed_out();
        let stated = |verdict| Statement { verdict: Some(verdict), ..Statement::default() };
        let deadlock = stated(Verdict::Deadlock);
        assert!(agree(SearchEnding::Sequence(1), &late) && agree(SearchEnding::Late, &deadlock));
        assert!(!agree(SearchEnding::Sequence(1), &deadlock));
        assert!(agree(SearchEnding::Deadlock, &deadlock));
        assert!(!agree(SearchEnding::Deadlock, &stated(Verdict::NoSpace)));
        // Without a bound there is nothing to agree with.
        assert!(!agree(SearchEnding::Sequence(1), &stated(Verdict::NoSpace)));
        assert!(!agree(SearchEnding::Sequence(1), &Statement::default()));
    }
}
