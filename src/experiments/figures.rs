//! Sums of episodes.

use super::episode::{Episode, OnBase};
use super::sample::{ConfidenceInterval, Spread};
use super::timed_search::{SearchEnding, TimedSearch};
use singulate_planner::paper::{GraspModelName, SearchMethod};
use singulate_planner::statement::Verdict;

/// All methods on the bases of one grasp model.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelFigures {
    /// The yaws that an obstacle blocks.
    pub grasp_model: GraspModelName,
    /// The time for a complete base, s.
    pub knowledge_s: Option<Spread>,
    /// The baseline, LOBS, ours.
    pub methods: [MethodFigures; 3],
}

/// One method on the bases of one grasp model.
#[derive(Debug, Clone, PartialEq)]
pub struct MethodFigures {
    /// The search.
    pub method: SearchMethod,
    /// The number of its scenes.
    pub episodes: usize,
    /// Episodes with a deadlock.
    pub deadlocks: usize,
    /// Episodes that ended with a sequence or a deadlock.
    pub successes: usize,
    /// Of the successes, sequences without any relocation: the target is graspable at once.
    pub graspable: usize,
    /// Episodes that timed out.
    pub late: usize,
    /// Episodes that reached the memory limit.
    pub too_large: usize,
    /// False deadlocks, by our proof on the same base.
    pub false_deadlocks: usize,
    /// Sequences longer than the least one, by our proof on the same base.
    pub not_optimal: usize,
    /// Search time, s, over all episodes; unfinished ones count as the time limit.
    pub search_s: Option<Spread>,
    /// Mean number of relocations over the episodes with a sequence, the target not counted.
    pub relocations_mean: Option<f64>,
}

/// Our planner's verdicts on some scenes.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanFigures {
    /// The number of scenes.
    pub episodes: usize,
    /// The target is graspable at once.
    pub graspable: usize,
    /// A checked plan.
    pub relocate: usize,
    /// Of those, plans proven to be optimal.
    pub optimal: usize,
    /// A proven deadlock.
    pub deadlock: usize,
    /// No places were found.
    pub no_space: usize,
    /// The time limit came first.
    pub timed_out: usize,
    /// Mean number of relocations of the plans.
    pub relocations_mean: Option<f64>,
    /// Time of a whole answer, s: knowledge, search, places and check.
    pub plan_s: Option<Spread>,
}

impl ModelFigures {
    pub(super) fn new<'e>(grasp_model: GraspModelName, episodes: impl Iterator<Item = &'e OnBase> + Clone) -> Self {
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
        let searches: Vec<(&TimedSearch, SearchEnding)> =
            episodes.filter_map(|on_base| Some((on_base.search(method)?, on_base.ours.ending))).collect();
        let count = |of: &dyn Fn(SearchEnding, SearchEnding) -> bool| {
            searches.iter().filter(|(search, ours)| of(search.ending, *ours)).count()
        };
        let lengths = searches.iter().filter_map(|(search, _)| match search.ending {
            SearchEnding::Sequence(length) => Some(length as f64),
            _ => None,
        });
        let deadlocks = count(&|ending, _| ending == SearchEnding::Deadlock);
        Self {
            method,
            episodes: searches.len(),
            deadlocks,
            successes: deadlocks + count(&|ending, _| matches!(ending, SearchEnding::Sequence(_))),
            graspable: count(&|ending, _| ending == SearchEnding::Sequence(0)),
            late: count(&|ending, _| ending == SearchEnding::Late),
            too_large: count(&|ending, _| ending == SearchEnding::TooLarge),
            false_deadlocks: count(&|ending, ours| {
                ending == SearchEnding::Deadlock && matches!(ours, SearchEnding::Sequence(_))
            }),
            not_optimal: count(&|ending, ours| match (ending, ours) {
                (SearchEnding::Sequence(found), SearchEnding::Sequence(least)) => found > least,
                _ => false,
            }),
            search_s: Spread::of_times(searches.iter().map(|(search, _)| search.time)),
            relocations_mean: Spread::of(lengths).map(|lengths| lengths.mean),
        }
    }

    /// The 95 % interval of the deadlock rate.
    pub fn deadlock_interval(&self) -> ConfidenceInterval {
        ConfidenceInterval::wilson(self.deadlocks, self.episodes)
    }
}

impl PlanFigures {
    pub(super) fn new<'e>(episodes: impl Iterator<Item = &'e Episode>) -> Self {
        let episodes: Vec<&Episode> = episodes.collect();
        let count = |verdict| episodes.iter().filter(|episode| episode.statement().verdict == Some(verdict)).count();
        let plans = episodes.iter().map(|episode| episode.statement());
        let plans = plans.filter(|statement| statement.verdict == Some(Verdict::Relocate));
        let costs = plans.clone().filter_map(|statement| statement.cost).map(|cost| cost.get() as f64);
        Self {
            episodes: episodes.len(),
            graspable: count(Verdict::Graspable),
            relocate: count(Verdict::Relocate),
            optimal: plans.filter(|statement| statement.optimal == Some(true)).count(),
            deadlock: count(Verdict::Deadlock),
            no_space: count(Verdict::NoSpace),
            timed_out: count(Verdict::TimedOut),
            relocations_mean: Spread::of(costs).map(|costs| costs.mean),
            plan_s: Spread::of_times(episodes.iter().map(|episode| episode.planning)),
        }
    }
}

#[cfg(test)]
mod tests {
    use core::time::Duration;

    use super::*;

    #[test]
    fn wrong_answers_are_counted_against_our_proof_and_only_there() {
        use SearchEnding::{Deadlock, Late, Sequence, TooLarge};
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
        let search = |ending| TimedSearch { ending, time: Duration::from_secs(1) };
        let episodes = endings.map(|[lobs, ours]| OnBase {
            knowledge: Duration::ZERO,
            baseline: None,
            lobs: search(lobs),
            ours: search(ours),
        });
        let figures = MethodFigures::new(SearchMethod::Lobs, episodes.iter());
        let counts = (figures.episodes, figures.deadlocks, figures.successes, figures.late, figures.too_large);
        assert_eq!(counts, (9, 3, 7, 1, 1));
        assert_eq!((figures.false_deadlocks, figures.not_optimal, figures.graspable), (1, 1, 1));
        assert_eq!(figures.relocations_mean, Some(4.0));
        assert_eq!(figures.search_s, Some(Spread { mean: 1.0, median: 1.0 }));
        let none = MethodFigures::new(SearchMethod::ForwardAstar, episodes.iter());
        assert_eq!((none.episodes, none.search_s, none.relocations_mean), (0, None, None));
    }
}
