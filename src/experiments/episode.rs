//! One scene, all methods, both grasp models.

use core::time::Duration;

use super::error::{Cause, ExperimentError};
use super::papers_cases::PapersCase;
use super::papers_scene::{PapersScene, complete_base, papers_scene};
use super::timed_search::{Ending, TimedSearch, timed_search};
use super::workers::Patience;
use crate::budget::{Budget, Clock};
use crate::knowledge::KnowledgeBase;
use crate::plan::{Answer, GraspModel, SearchMethod, Settings, Verdict, plan};
use crate::scene::{ObjectIndex, Scene};

/// Everything that happened in one episode of Table I.
#[derive(Debug)]
pub(super) struct Episode {
    pub(super) sector: OnBase,
    pub(super) swept_finger: OnBase,
    /// Our planner's answer with its default settings: places and check included.
    pub(super) answer: Answer,
    /// How long that took.
    pub(super) planning: Duration,
}

/// The searches on the base of one grasp model.
#[derive(Debug)]
pub(super) struct OnBase {
    /// How long the base took.
    pub(super) knowledge: Duration,
    /// The baseline only where it was asked for; ours last.
    pub(super) searches: Vec<TimedSearch>,
}

impl OnBase {
    fn new(
        knowledge: Duration,
        base: &KnowledgeBase,
        target: ObjectIndex,
        with_baseline: bool,
        patience: &Patience<'_>,
    ) -> Self {
        let baseline = with_baseline.then_some(SearchMethod::ForwardAstar);
        let methods = baseline.into_iter().chain([SearchMethod::Lobs, SearchMethod::Landmarks]);
        Self { knowledge, searches: methods.map(|method| timed_search(method, base, target, patience)).collect() }
    }

    /// How our own search ended; a proof unless it was late.
    pub(super) fn ours(&self) -> Ending {
        self.searches[self.searches.len() - 1].ending
    }
}

/// The episode of one seed.
pub(super) fn episode(
    case: &PapersCase,
    seed: u64,
    with_baseline: bool,
    patience: &Patience<'_>,
) -> Result<Episode, ExperimentError> {
    let failed = |cause| ExperimentError { objects: case.objects, seed, cause };
    let PapersScene { scene, sector, knowledge } = papers_scene(case, seed, patience)?;
    let sector = OnBase::new(knowledge, &sector, scene.target(), with_baseline, patience);

    let watch = patience.watch();
    let base = complete_base(case, seed, &scene, GraspModel::SweptFinger, &watch)?;
    let mut swept_finger = OnBase::new(watch.elapsed(), &base, scene.target(), with_baseline, patience);

    let (answer, planning) = planned(&scene, &Settings::default(), patience).map_err(failed)?;
    for on_base in [&sector, &swept_finger] {
        refutation(on_base).map_or(Ok(()), |cause| Err(failed(cause)))?;
    }
    if !agree(swept_finger.ours(), &answer.verdict) {
        return Err(failed(Cause::Contradicted(swept_finger.ours())));
    }
    // By the swept finger only what is planned and checked counts as ours.
    if matches!(answer.verdict, Verdict::TimedOut(_))
        && let Some(ours) = swept_finger.searches.last_mut()
    {
        (ours.ending, ours.time) = (Ending::Late, patience.limit);
    }
    Ok(Episode { sector, swept_finger, answer, planning })
}

/// The planner's answer, and how long it took.
pub(super) fn planned(
    scene: &Scene,
    settings: &Settings,
    patience: &Patience<'_>,
) -> Result<(Answer, Duration), Cause> {
    let watch = patience.watch();
    let answer = plan(scene, settings, &Budget::new(&watch, patience.limit)).map_err(Cause::Plan)?;
    Ok((answer, watch.elapsed()))
}

/// The first search that does better than ours proves possible. What the paper's searches find are derivations, so that
/// this would be a fault in our proof.
fn refutation(on_base: &OnBase) -> Option<Cause> {
    let proven = on_base.ours();
    let refutes = |ending: Ending| match (ending, proven) {
        (Ending::Sequence(found), Ending::Sequence(least)) => found < least,
        (Ending::Sequence(_), Ending::Deadlock) => true,
        _ => false,
    };
    let found = on_base.searches.iter().find(|search| refutes(search.ending))?;
    Some(Cause::Refuted { ending: found.ending, proven })
}

/// True if search and planner say the same, as far as each got.
fn agree(ours: Ending, verdict: &Verdict) -> bool {
    match (ours, verdict) {
        (Ending::Late | Ending::TooLarge, _) | (_, Verdict::TimedOut(_)) => true,
        (Ending::Deadlock, verdict) => matches!(verdict, Verdict::Deadlock(_)),
        (Ending::Sequence(least), Verdict::Graspable(_)) => least == 0,
        (Ending::Sequence(least), Verdict::Relocate(plan)) => {
            plan.cost() >= least && plan.bound.as_ref().is_some_and(|bound| bound.cost <= least)
        }
        (Ending::Sequence(least), Verdict::NoSpace(rest)) => {
            rest.bound.as_ref().is_some_and(|bound| bound.cost <= least)
        }
        (Ending::Sequence(_), Verdict::Deadlock(_)) => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Unplanned;

    fn on_base(endings: [Ending; 2]) -> OnBase {
        let search = |ending| TimedSearch { method: SearchMethod::Lobs, ending, time: Duration::ZERO };
        OnBase { knowledge: Duration::ZERO, searches: endings.map(search).to_vec() }
    }

    #[test]
    fn a_shorter_sequence_or_one_in_spite_of_a_deadlock_refutes_our_proof() {
        let check = |other, ours, refuted| assert_eq!(refutation(&on_base([other, ours])).is_some(), refuted);
        check(Ending::Sequence(2), Ending::Sequence(3), true);
        check(Ending::Sequence(2), Ending::Deadlock, true);
        check(Ending::Sequence(3), Ending::Sequence(3), false);
        check(Ending::Deadlock, Ending::Sequence(3), false);
        check(Ending::Sequence(2), Ending::Late, false);
    }

    #[test]
    fn a_planner_that_contradicts_the_search_is_noticed() {
        let late = Verdict::TimedOut(Unplanned::default());
        assert!(agree(Ending::Sequence(1), &late) && agree(Ending::Late, &Verdict::Deadlock(None)));
        assert!(!agree(Ending::Sequence(1), &Verdict::Deadlock(None)));
        assert!(agree(Ending::Deadlock, &Verdict::Deadlock(None)));
        assert!(!agree(Ending::Deadlock, &Verdict::NoSpace(Unplanned::default())));
    }
}
