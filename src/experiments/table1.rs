//! Table I: who finds what, and how fast.

use super::ExperimentSettings;
use super::episode::{Episode, OnBase, episode};
use super::error::ExperimentError;
use super::interval::Interval;
use super::papers_cases::{PAPERS_CASES, PapersCase};
use super::papers_scene::seed_of;
use super::spread::Spread;
use super::timed_search::{Ending, TimedSearch};
use super::workers::{Patience, in_parallel};
use crate::plan::{GraspModel, SearchMethod, Verdict};

/// One column of Table I.
#[derive(Debug, Clone, PartialEq)]
pub struct Table1Column {
    /// What was asked, with what the paper prints.
    pub case: PapersCase,
    /// By the paper's sector model.
    pub sector: ModelFigures,
    /// By the swept finger.
    pub swept_finger: ModelFigures,
    /// Our planner's verdicts on every scene, by the swept finger: planned with places, and checked.
    pub plans: PlanFigures,
    /// The same for those scenes alone that are a deadlock by the sector model and none by the swept finger.
    pub extra: PlanFigures,
}

/// All methods on the bases of one grasp model.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelFigures {
    /// Which yaws an obstacle blocks.
    pub grasp_model: GraspModel,
    /// How long a complete base took, s.
    pub knowledge_s: Option<Spread>,
    /// The baseline, LOBS, ours.
    pub methods: [MethodFigures; 3],
}

/// One method on the bases of one grasp model.
#[derive(Debug, Clone, PartialEq)]
pub struct MethodFigures {
    /// The search.
    pub method: SearchMethod,
    /// How many scenes it was given.
    pub episodes: usize,
    /// Episodes that it calls a deadlock.
    pub deadlocks: usize,
    /// Episodes that ended with a sequence or a deadlock.
    pub successes: usize,
    /// Of the successes, sequences without any relocation: the target is graspable at once.
    pub graspable: usize,
    /// Episodes that the time limit ended.
    pub late: usize,
    /// Episodes that the limit of memory ended.
    pub too_large: usize,
    /// Deadlocks that are none, by our proof on the same base.
    pub false_deadlocks: usize,
    /// Sequences longer than the least one, by our proof on the same base.
    pub not_optimal: usize,
    /// Search time, s, over all episodes; those that did not end by themselves count as the time limit.
    pub search_s: Option<Spread>,
    /// Mean number of relocations over the episodes with a sequence, the target not counted.
    pub relocations_mean: Option<f64>,
}

/// What became of some scenes in our planner.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanFigures {
    /// How many scenes.
    pub episodes: usize,
    /// The target is graspable at once.
    pub graspable: usize,
    /// A plan, checked.
    pub relocate: usize,
    /// Of those, plans that are proven to be as short as any.
    pub optimal: usize,
    /// A proven deadlock.
    pub deadlock: usize,
    /// No place was found for what has to move.
    pub no_space: usize,
    /// The time limit came first.
    pub timed_out: usize,
    /// Mean number of relocations of the plans.
    pub relocations_mean: Option<f64>,
    /// Time of a whole answer, s: knowledge, search, places and check.
    pub plan_s: Option<Spread>,
}

/// Run Table I. `done` hears how many of how many episodes are done.
///
/// # Errors
/// [`ExperimentError`] if an episode fails: a bug of ours, or a table too full for the objects.
pub fn table1(
    settings: &ExperimentSettings,
    mut done: impl FnMut(usize, usize),
) -> Result<Vec<Table1Column>, ExperimentError> {
    let (episodes, total) = (settings.episodes, settings.episodes * PAPERS_CASES.len());
    let work = |at: usize, failed: &_| {
        let (column, number) = (at / episodes, at % episodes);
        let patience = Patience { limit: settings.time_limit, failed };
        let seed = seed_of(settings.seed, column, number);
        episode(&PAPERS_CASES[column], seed, number < settings.base_episodes, &patience)
    };
    let all = in_parallel(total, settings.jobs, work, |count| done(count, total))?;
    Ok(PAPERS_CASES
        .iter()
        .zip(all.chunks(episodes))
        .map(|(case, episodes)| Table1Column::new(*case, episodes))
        .collect())
}

impl Table1Column {
    fn new(case: PapersCase, episodes: &[Episode]) -> Self {
        let extra = episodes.iter().filter(|episode| episode.sector.ours() == Ending::Deadlock);
        let extra = extra.filter(|episode| !matches!(episode.answer.verdict, Verdict::Deadlock(_)));
        Self {
            case,
            sector: ModelFigures::new(GraspModel::Sector, episodes.iter().map(|episode| &episode.sector)),
            swept_finger: ModelFigures::new(
                GraspModel::SweptFinger,
                episodes.iter().map(|episode| &episode.swept_finger),
            ),
            plans: PlanFigures::new(episodes.iter()),
            extra: PlanFigures::new(extra),
        }
    }

    /// True if the deadlock rate of LOBS by the sector model can't well be the paper's: the 95 % intervals do not overlap.
    pub fn disagrees(&self) -> bool {
        !self.sector.method(SearchMethod::Lobs).deadlock_interval().overlaps(&self.case.lobs.deadlock_interval())
    }

    /// Our deadlocks by the swept finger over ours by the sector model; `None` where there are none of those.
    pub fn deadlock_ratio(&self) -> Option<f64> {
        let deadlocks = |model: &ModelFigures| model.method(SearchMethod::Landmarks).deadlocks as f64;
        (deadlocks(&self.sector) > 0.0).then(|| deadlocks(&self.swept_finger) / deadlocks(&self.sector))
    }

    /// True if the swept finger has at most half as many deadlocks as the sector model.
    pub fn at_most_half(&self) -> bool {
        self.deadlock_ratio().is_none_or(|ratio| ratio <= 0.5)
    }
}

impl ModelFigures {
    fn new<'e>(grasp_model: GraspModel, episodes: impl Iterator<Item = &'e OnBase> + Clone) -> Self {
        let methods = [SearchMethod::ForwardAstar, SearchMethod::Lobs, SearchMethod::Landmarks];
        Self {
            grasp_model,
            knowledge_s: Spread::of_times(episodes.clone().map(|on_base| on_base.knowledge)),
            methods: methods.map(|method| MethodFigures::new(method, episodes.clone())),
        }
    }

    /// The figures of one method.
    pub fn method(&self, method: SearchMethod) -> &MethodFigures {
        self.methods.iter().find(|figures| figures.method == method).expect("all methods are run")
    }
}

impl MethodFigures {
    fn new<'e>(method: SearchMethod, episodes: impl Iterator<Item = &'e OnBase>) -> Self {
        let searches: Vec<(&TimedSearch, Ending)> = episodes
            .filter_map(|on_base| {
                let search = on_base.searches.iter().find(|search| search.method == method)?;
                Some((search, on_base.ours()))
            })
            .collect();
        let count = |of: &dyn Fn(Ending, Ending) -> bool| {
            searches.iter().filter(|(search, ours)| of(search.ending, *ours)).count()
        };
        let lengths = searches.iter().filter_map(|(search, _)| match search.ending {
            Ending::Sequence(length) => Some(length as f64),
            _ => None,
        });
        let deadlocks = count(&|ending, _| ending == Ending::Deadlock);
        Self {
            method,
            episodes: searches.len(),
            deadlocks,
            successes: deadlocks + count(&|ending, _| matches!(ending, Ending::Sequence(_))),
            graspable: count(&|ending, _| ending == Ending::Sequence(0)),
            late: count(&|ending, _| ending == Ending::Late),
            too_large: count(&|ending, _| ending == Ending::TooLarge),
            false_deadlocks: count(&|ending, ours| ending == Ending::Deadlock && matches!(ours, Ending::Sequence(_))),
            not_optimal: count(&|ending, ours| match (ending, ours) {
                (Ending::Sequence(found), Ending::Sequence(least)) => found > least,
                _ => false,
            }),
            search_s: Spread::of_times(searches.iter().map(|(search, _)| search.time)),
            relocations_mean: Spread::of(lengths).map(|lengths| lengths.mean),
        }
    }

    /// How sure the deadlock rate is (95 %).
    pub fn deadlock_interval(&self) -> Interval {
        Interval::wilson(self.deadlocks, self.episodes)
    }
}

impl PlanFigures {
    fn new<'e>(episodes: impl Iterator<Item = &'e Episode>) -> Self {
        let episodes: Vec<&Episode> = episodes.collect();
        let count = |of: fn(&Verdict) -> bool| episodes.iter().filter(|episode| of(&episode.answer.verdict)).count();
        let costs = episodes.iter().filter_map(|episode| match &episode.answer.verdict {
            Verdict::Relocate(plan) => Some(plan.cost() as f64),
            _ => None,
        });
        Self {
            episodes: episodes.len(),
            graspable: count(|verdict| matches!(verdict, Verdict::Graspable(_))),
            relocate: count(|verdict| matches!(verdict, Verdict::Relocate(_))),
            optimal: count(|verdict| matches!(verdict, Verdict::Relocate(plan) if plan.optimal())),
            deadlock: count(|verdict| matches!(verdict, Verdict::Deadlock(_))),
            no_space: count(|verdict| matches!(verdict, Verdict::NoSpace(_))),
            timed_out: count(|verdict| matches!(verdict, Verdict::TimedOut(_))),
            relocations_mean: Spread::of(costs).map(|costs| costs.mean),
            plan_s: Spread::of_times(episodes.iter().map(|episode| episode.planning)),
        }
    }
}

#[cfg(test)]
mod tests {
    use core::sync::atomic::AtomicBool;
    use core::time::Duration;

    use super::*;
    use crate::plan::{Answer, Statistics, Unplanned};

    const SECOND: Duration = Duration::from_secs(1);

    fn on_base(endings: [Ending; 2]) -> OnBase {
        let search = |(method, ending)| TimedSearch { method, ending, time: SECOND };
        let methods = [SearchMethod::Lobs, SearchMethod::Landmarks];
        OnBase { knowledge: SECOND, searches: methods.into_iter().zip(endings).map(search).collect() }
    }

    /// LOBS and ours agree on both bases.
    fn agreed(sector: Ending, swept_finger: Ending, verdict: Verdict) -> Episode {
        let answer = Answer { verdict, warnings: Vec::new(), statistics: Statistics::default() };
        let [sector, swept_finger] = [sector, swept_finger].map(|ending| on_base([ending; 2]));
        Episode { sector, swept_finger, answer, planning: SECOND }
    }

    #[test]
    fn wrong_answers_are_counted_against_our_proof_and_only_there() {
        use Ending::{Deadlock, Late, Sequence, TooLarge};
        let endings = [
            [Sequence(3), Sequence(3)],
            [Sequence(4), Sequence(3)],
            [Sequence(0), Sequence(0)],
            [Sequence(9), Late],
            [Deadlock, Sequence(1)],
            [Deadlock, Deadlock],
            [Deadlock, Late],
            [Late, Deadlock],
            [TooLarge, Sequence(1)],
        ];
        let episodes = endings.map(on_base);
        let figures = MethodFigures::new(SearchMethod::Lobs, episodes.iter());
        let counts = (figures.episodes, figures.deadlocks, figures.successes, figures.late, figures.too_large);
        assert_eq!(counts, (9, 3, 7, 1, 1));
        assert_eq!((figures.false_deadlocks, figures.not_optimal, figures.graspable), (1, 1, 1));
        assert_eq!(figures.relocations_mean, Some(4.0));
        assert_eq!(figures.search_s, Some(Spread { mean: 1.0, median: 1.0 }));
        let none = MethodFigures::new(SearchMethod::ForwardAstar, episodes.iter());
        assert_eq!((none.episodes, none.search_s, none.relocations_mean), (0, None, None));
    }

    #[test]
    fn an_extra_plan_is_one_where_only_the_sector_model_says_deadlock() {
        use Ending::{Deadlock, Sequence};
        let no_space = || Verdict::NoSpace(Unplanned::default());
        let mut episodes = vec![
            agreed(Deadlock, Deadlock, Verdict::Deadlock(None)),
            agreed(Deadlock, Sequence(2), no_space()),
            agreed(Sequence(2), Sequence(1), no_space()),
        ];
        let column = Table1Column::new(PAPERS_CASES[0], &episodes);
        assert_eq!((column.plans.episodes, column.plans.deadlock, column.plans.no_space), (3, 1, 2));
        assert_eq!((column.extra.episodes, column.extra.no_space), (1, 1));
        assert_eq!((column.deadlock_ratio(), column.at_most_half()), (Some(0.5), true));
        episodes.push(agreed(Deadlock, Deadlock, Verdict::Deadlock(None)));
        assert!(!Table1Column::new(PAPERS_CASES[0], &episodes).at_most_half());
        let column = Table1Column::new(PAPERS_CASES[0], &episodes[2..3]);
        assert_eq!((column.deadlock_ratio(), column.at_most_half()), (None, true));
    }

    #[test]
    fn a_column_disagrees_where_the_intervals_do_not_overlap() {
        let disagrees = |deadlocks: usize| {
            let ending = |at| if at < deadlocks { Ending::Deadlock } else { Ending::Sequence(1) };
            let episode = |at| agreed(ending(at), ending(at), Verdict::Deadlock(None));
            Table1Column::new(PAPERS_CASES[0], &(0..400).map(episode).collect::<Vec<_>>()).disagrees()
        };
        // The paper's 4 in 20: 8.1 to 41.6 %. 5 % of 400 are 3.3 to 7.6 %.
        assert!(disagrees(20) && !disagrees(40) && !disagrees(160) && disagrees(200));
    }

    #[test]
    fn in_one_of_the_papers_own_scenes_lobs_moves_one_more_than_is_needed() {
        let patience = Patience { limit: Duration::MAX, failed: &AtomicBool::new(false) };
        let episode = episode(&PAPERS_CASES[3], seed_of(149, 3, 0), true, &patience).unwrap();
        let found: Vec<Ending> = episode.sector.searches.iter().map(|search| search.ending).collect();
        assert_eq!(found, [Ending::Sequence(7), Ending::Sequence(8), Ending::Sequence(7)]);
        let column = Table1Column::new(PAPERS_CASES[3], &[episode]);
        let not_optimal = |method| column.sector.method(method).not_optimal;
        assert_eq!((not_optimal(SearchMethod::Lobs), not_optimal(SearchMethod::ForwardAstar)), (1, 0));
    }
}
