//! Table I: deadlocks, successes and times of the searches.

use super::ExperimentSettings;
use super::episode::{Episode, baseline, episode};
use super::error::ExperimentError;
use super::figures::{ModelFigures, PlanFigures};
use super::papers_cases::{PAPERS_CASES, PapersCase};
use super::papers_scene::seed_of;
use super::timed_search::SearchEnding;
use super::workers::{Patience, in_parallel};
use singulate_planner::paper::{GraspModelName, SearchMethod};
use singulate_planner::statement::Verdict;

/// One column of Table I.
#[derive(Debug, Clone, PartialEq)]
pub struct Table1Column {
    /// The case, with the paper's figures.
    pub case: PapersCase,
    /// By the paper's sector model.
    pub sector: ModelFigures,
    /// By the swept finger.
    pub swept_finger: ModelFigures,
    /// Our planner's verdicts on every scene, by the swept finger: planned with places, and checked.
    pub plans: PlanFigures,
    /// The same for the scenes that are a deadlock by the sector model but not by the swept finger.
    pub extra: PlanFigures,
}

/// Run Table I. `done` gets the number of finished steps and their total.
///
/// # Errors
/// [`ExperimentError`] if an episode fails: a bug of ours, or a table too full for the objects.
pub fn table1(
    settings: &ExperimentSettings,
    mut done: impl FnMut(usize, usize),
) -> Result<Vec<Table1Column>, ExperimentError> {
    let (episodes, baselines) = (settings.episodes, settings.base_episodes.min(settings.episodes));
    let (first, second) = (episodes * PAPERS_CASES.len(), baselines * PAPERS_CASES.len());
    let seed = |column, number| seed_of(settings.seed, column, number);
    let run = |at: usize, failed: &_| {
        let (column, number) = (at / episodes, at % episodes);
        episode(&PAPERS_CASES[column], seed(column, number), &Patience { limit: settings.time_limit, failed })
    };
    let mut all = in_parallel(first, settings.jobs, run, |count| done(count, first + second))?;
    // The baseline runs last, since filling and freeing its memory would slow down other searches.
    let run = |at: usize, failed: &_| {
        let (column, number) = (at / baselines, at % baselines);
        baseline(&PAPERS_CASES[column], seed(column, number), &Patience { limit: settings.time_limit, failed })
    };
    let searches = in_parallel(second, settings.jobs, run, |count| done(first + count, first + second))?;
    for (at, searches) in searches.into_iter().enumerate() {
        let (column, number) = (at / baselines, at % baselines);
        all[column * episodes + number].add(searches).map_err(|cause| ExperimentError {
            objects: PAPERS_CASES[column].objects,
            seed: seed(column, number),
            cause,
        })?;
    }
    let columns = PAPERS_CASES.iter().zip(all.chunks(episodes));
    Ok(columns.map(|(case, episodes)| Table1Column::new(*case, episodes)).collect())
}

impl Table1Column {
    fn new(case: PapersCase, episodes: &[Episode]) -> Self {
        let extra = episodes.iter().filter(|episode| episode.sector.ours.ending == SearchEnding::Deadlock);
        let extra = extra.filter(|episode| episode.statement().verdict != Some(Verdict::Deadlock));
        Self {
            case,
            sector: ModelFigures::new(GraspModelName::Sector, episodes.iter().map(|episode| &episode.sector)),
            swept_finger: ModelFigures::new(
                GraspModelName::SweptFinger,
                episodes.iter().map(|episode| &episode.swept_finger),
            ),
            plans: PlanFigures::new(episodes.iter()),
            extra: PlanFigures::new(extra),
        }
    }

    /// True if the deadlock rate of LOBS by the sector model is unlikely to be the paper's: the 95 % intervals do not
    /// overlap.
    pub fn disagrees(&self) -> bool {
        !self.sector.method(SearchMethod::Lobs).deadlock_interval().overlaps(&self.case.lobs.deadlock_interval())
    }

    /// Our deadlocks by the swept finger over ours by the sector model; `None` if the latter are 0.
    pub fn deadlock_ratio(&self) -> Option<f64> {
        let deadlocks = |model: &ModelFigures| model.method(SearchMethod::Landmarks).deadlocks as f64;
        (deadlocks(&self.sector) > 0.0).then(|| deadlocks(&self.swept_finger) / deadlocks(&self.sector))
    }

    /// True if the swept finger has at most half as many deadlocks as the sector model.
    pub fn at_most_half(&self) -> bool {
        self.deadlock_ratio().is_none_or(|ratio| ratio <= 0.5)
    }
}

#[cfg(test)]
mod tests {
    use core::sync::atomic::AtomicBool;
    use core::time::Duration;

    use super::*;
    use crate::experiments::episode::OnBase;
    use crate::experiments::timed_search::TimedSearch;
    use singulate_planner::plan::{Answer, Statistics};
    use singulate_planner::statement::Statement;

    const SECOND: Duration = Duration::from_secs(1);

    fn on_base(ending: SearchEnding) -> OnBase {
        let search = TimedSearch { ending, time: SECOND };
        OnBase { knowledge: SECOND, baseline: None, lobs: search, ours: search }
    }

    /// LOBS and ours agree on both bases.
    fn agreed(sector: SearchEnding, swept_finger: SearchEnding, verdict: Verdict) -> Episode {
        let statement = Statement { verdict: Some(verdict), ..Statement::default() };
        let judged = Answer { statement, statistics: Statistics::default() }.into();
        let [sector, swept_finger] = [sector, swept_finger].map(on_base);
        Episode { sector, swept_finger, judged, planning: SECOND }
    }

    #[test]
    fn an_extra_plan_is_one_where_only_the_sector_model_says_deadlock() {
        use SearchEnding::{Deadlock, Sequence};
        let mut episodes = vec![
            agreed(Deadlock, Deadlock, Verdict::Deadlock),
            agreed(Deadlock, Sequence(2), Verdict::NoSpace),
            agreed(Sequence(2), Sequence(1), Verdict::NoSpace),
        ];
        let column = Table1Column::new(PAPERS_CASES[0], &episodes);
        assert_eq!((column.plans.episodes, column.plans.deadlock, column.plans.no_space), (3, 1, 2));
        assert_eq!((column.extra.episodes, column.extra.no_space), (1, 1));
        assert_eq!((column.deadlock_ratio(), column.at_most_half()), (Some(0.5), true));
        episodes.push(agreed(Deadlock, Deadlock, Verdict::Deadlock));
        assert!(!Table1Column::new(PAPERS_CASES[0], &episodes).at_most_half());
        let column = Table1Column::new(PAPERS_CASES[0], &episodes[2..3]);
        assert_eq!((column.deadlock_ratio(), column.at_most_half()), (None, true));
    }

    #[test]
    fn a_column_disagrees_where_the_intervals_do_not_overlap() {
        let disagrees = |deadlocks: usize| {
            let ending = |at| if at < deadlocks { SearchEnding::Deadlock } else { SearchEnding::Sequence(1) };
            let episode = |at| agreed(ending(at), ending(at), Verdict::Deadlock);
            Table1Column::new(PAPERS_CASES[0], &(0..400).map(episode).collect::<Vec<_>>()).disagrees()
        };
        // The paper's 4 in 20: 8.1 to 41.6 %. 5 % of 400 are 3.3 to 7.6 %.
        assert!(disagrees(20) && !disagrees(40) && !disagrees(160) && disagrees(200));
    }

    #[test]
    fn in_one_of_the_papers_own_scenes_lobs_moves_one_more_than_is_needed() {
        let patience = Patience { limit: Duration::MAX, failed: &AtomicBool::new(false) };
        let seed = seed_of(149, 3, 0);
        let mut episode = episode(&PAPERS_CASES[3], seed, &patience).unwrap();
        episode.add(baseline(&PAPERS_CASES[3], seed, &patience).unwrap()).unwrap();
        let ending = |method| episode.sector.search(method).unwrap().ending;
        assert_eq!(ending(SearchMethod::ForwardAstar), SearchEnding::Sequence(7));
        assert_eq!(ending(SearchMethod::Lobs), SearchEnding::Sequence(8));
        assert_eq!(ending(SearchMethod::Landmarks), SearchEnding::Sequence(7));
        let column = Table1Column::new(PAPERS_CASES[3], &[episode]);
        let not_optimal = |method| column.sector.method(method).not_optimal;
        assert_eq!((not_optimal(SearchMethod::Lobs), not_optimal(SearchMethod::ForwardAstar)), (1, 0));
    }
}
