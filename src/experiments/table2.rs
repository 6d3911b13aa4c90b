//! Table II: places for relocated objects.

use core::time::Duration;
use std::collections::BTreeMap;

use super::ExperimentSettings;
use super::episode::planned;
use super::error::{EpisodeError, ExperimentError};
use super::papers_cases::{PAPERS_CASES, PapersCase};
use super::papers_scene::{papers_scene, seed_of};
use super::sample::Spread;
use super::timed_search::{SearchEnding, timed_search};
use super::workers::{Patience, in_parallel};
use singulate_planner::check::FaultCode;
use singulate_planner::paper::{DEFAULT_RESOLUTION, Raster};
use singulate_planner::paper::{GraspModelName, Judged, Methods, PlacementMethod, SearchMethod, Warning};
use singulate_planner::scene::Scene;
use singulate_planner::statement::Verdict;

/// The compared placement methods.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Repositioning {
    /// The paper's, with [`DEFAULT_RESOLUTION`] to a pixel.
    Raster,
    /// Ours.
    Exact,
}

const REPOSITIONINGS: [Repositioning; 2] = [Repositioning::Raster, Repositioning::Exact];

impl Repositioning {
    fn method(self, scene: &Scene) -> PlacementMethod {
        match self {
            Self::Raster => {
                let raster = Raster::new(DEFAULT_RESOLUTION, scene.table());
                PlacementMethod::Raster(raster.expect("the paper's tables are small"))
            }
            Self::Exact => PlacementMethod::Exact,
        }
    }
}

/// The most scenes drawn per wanted episode. If the time limit is so short that LOBS never ends, there is no episode at
/// all.
const MAX_DRAWN: usize = 50;

/// One column of Table II.
#[derive(Debug, Clone, PartialEq)]
pub struct Table2Column {
    /// The case, with the paper's figures.
    pub case: PapersCase,
    /// The number of scenes drawn for the episodes.
    pub drawn: usize,
    /// Each placement method, on the same sequences.
    pub placements: [PlacementFigures; 2],
}

/// One placement method for the sequences of LOBS on the sector model's base.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacementFigures {
    /// The method.
    pub placement: Repositioning,
    /// The number of its sequences.
    pub episodes: usize,
    /// Episodes with a place for every object of the sequence.
    pub successes: usize,
    /// Of those, episodes that need none: the target is graspable at once.
    pub graspable: usize,
    /// Episodes without places.
    pub no_space: usize,
    /// Episodes that timed out.
    pub late: usize,
    /// Time to find the places of one episode, s, if any are needed; time-outs count as the time limit.
    pub reposition_s: Option<Spread>,
    /// Plans with any fault by the checker, which uses the swept finger.
    pub faulty: usize,
    /// Plans in which a finger meets an obstacle at release: a limitation that the paper itself states.
    pub release_blocked: usize,
    /// Plans with any other fault.
    pub otherwise_faulty: usize,
    /// The number of each fault in all plans, by code.
    pub faults: BTreeMap<&'static str, usize>,
}

/// One placement method's result for one sequence.
struct Placed {
    placement: Repositioning,
    judged: Judged,
    time: Duration,
}

/// Run Table II. `done` gets the number of finished steps and their total.
///
/// # Errors
/// [`ExperimentError`] if an episode fails: a bug of ours, or a table too full for the objects.
pub fn table2(
    settings: &ExperimentSettings,
    mut done: impl FnMut(usize, usize),
) -> Result<Vec<Table2Column>, ExperimentError> {
    let cases: Vec<&PapersCase> = PAPERS_CASES.iter().filter(|case| case.reposition.is_some()).collect();
    let total = settings.episodes * cases.len();
    let draw = |column: usize, failed: &_| {
        let patience = Patience { limit: settings.time_limit, failed };
        draw(cases[column], column, settings, &patience)
    };
    let drawn = in_parallel(cases.len(), settings.jobs, draw, |_| done(0, total))?;
    let episodes: Vec<(usize, u64)> = drawn
        .iter()
        .enumerate()
        .flat_map(|(column, drawn)| drawn.seeds.iter().map(move |&seed| (column, seed)))
        .collect();
    let place = |at: usize, failed: &_| {
        let (column, seed) = episodes[at];
        place(cases[column], seed, &Patience { limit: settings.time_limit, failed })
    };
    let mut placed = in_parallel(episodes.len(), settings.jobs, place, |count| done(count, total))?.into_iter();
    let columns = cases.iter().zip(&drawn).map(|(case, drawn)| {
        let placed: Vec<_> = placed.by_ref().take(drawn.seeds.len()).collect();
        let placements = REPOSITIONINGS.map(|placement| {
            PlacementFigures::new(placement, placed.iter().flatten().filter(|placed| placed.placement == placement))
        });
        Table2Column { case: **case, drawn: drawn.count, placements }
    });
    Ok(columns.collect())
}

/// The first scenes for which LOBS finds a sequence.
struct Drawn {
    seeds: Vec<u64>,
    /// The number of scenes examined.
    count: usize,
}

fn draw(
    case: &PapersCase,
    column: usize,
    settings: &ExperimentSettings,
    patience: &Patience<'_>,
) -> Result<Drawn, ExperimentError> {
    let mut drawn = Drawn { seeds: Vec::new(), count: 0 };
    while drawn.seeds.len() < settings.episodes && drawn.count < MAX_DRAWN * settings.episodes {
        let seed = seed_of(settings.seed, column, drawn.count);
        let papers = papers_scene(case, seed, patience)?;
        let search = timed_search(SearchMethod::Lobs, &papers.sector, papers.target, patience);
        if matches!(search.ending, SearchEnding::Sequence(_)) {
            drawn.seeds.push(seed);
        }
        drawn.count += 1;
    }
    Ok(drawn)
}

/// One sequence with every placement method.
fn place(case: &PapersCase, seed: u64, patience: &Patience<'_>) -> Result<Vec<Placed>, ExperimentError> {
    let scene = papers_scene(case, seed, patience)?.scene;
    let placed = |placement| place_by(&scene, placement, patience);
    let placed: Result<_, _> = REPOSITIONINGS.into_iter().map(placed).collect();
    placed.map_err(|cause| ExperimentError { objects: case.objects, seed, cause })
}

fn place_by(scene: &Scene, placement: Repositioning, patience: &Patience<'_>) -> Result<Placed, EpisodeError> {
    let method = placement.method(scene);
    let methods = Methods { grasp_model: GraspModelName::Sector, search: SearchMethod::Lobs, placement: method };
    let (judged, _) = planned(scene, &methods, patience)?;
    let time = match judged.statement().verdict {
        Some(Verdict::TimedOut) => patience.limit,
        _ => judged.answer.statistics.placement,
    };
    Ok(Placed { placement, judged, time })
}

impl PlacementFigures {
    fn new<'e>(placement: Repositioning, episodes: impl Iterator<Item = &'e Placed> + Clone) -> Self {
        let count = |of: &dyn Fn(&Judged) -> bool| episodes.clone().filter(|placed| of(&placed.judged)).count();
        let ended = |verdict| count(&|judged| judged.statement().verdict == Some(verdict));
        let sought = episodes.clone().filter(|placed| !is_graspable(&placed.judged));
        let mut by_code = BTreeMap::new();
        for code in episodes.clone().flat_map(|placed| faults(&placed.judged)) {
            *by_code.entry(code.name()).or_default() += 1;
        }
        Self {
            placement,
            episodes: episodes.clone().count(),
            successes: ended(Verdict::Relocate) + ended(Verdict::Graspable),
            graspable: ended(Verdict::Graspable),
            no_space: ended(Verdict::NoSpace),
            late: ended(Verdict::TimedOut),
            reposition_s: Spread::of_times(sought.map(|placed| placed.time)),
            faulty: count(&Judged::faulty),
            release_blocked: count(&|judged| faults(judged).any(|code| code == FaultCode::ReleaseBlocked)),
            otherwise_faulty: count(&|judged| faults(judged).any(|code| code != FaultCode::ReleaseBlocked)),
            faults: by_code,
        }
    }
}

fn is_graspable(judged: &Judged) -> bool {
    judged.statement().verdict == Some(Verdict::Graspable)
}

/// The checker's faults in an answer.
fn faults(judged: &Judged) -> impl Iterator<Item = FaultCode> {
    judged.warnings.iter().filter_map(|warning| match warning {
        Warning::Faulty(fault) => Some(fault.code),
        _ => None,
    })
}
