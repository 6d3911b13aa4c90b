//! Table I as JSON.

use serde::Serialize;

use super::settings::{GraspModelWord, SearchWord};
use crate::experiments::{
    ConfidenceInterval, ExperimentSettings, MethodFigures, ModelFigures, PlanFigures, Printed, Spread, TABLE1_EPISODES,
    Table1Column,
};
use singulate_planner::paper::SearchMethod;

/// Table I. Rates are from 0 to 1, times in seconds; null if there is nothing to measure.
#[derive(Debug, Serialize)]
pub struct Table1Body {
    /// `table1`.
    pub table: &'static str,
    /// The seed of the scenes.
    pub seed: u64,
    /// Episodes in each column.
    pub episodes: usize,
    /// The first of them, which the baseline ran too.
    pub base_episodes: usize,
    /// For each search and each plan.
    pub time_limit_ms: u64,
    /// The columns N = 16, 18, 20, 25, 37, 50.
    pub columns: Vec<Table1ColumnBody>,
}

/// One column.
#[derive(Debug, Serialize)]
pub struct Table1ColumnBody {
    /// N, the target included.
    pub objects: usize,
    /// Width and height of the table, m.
    pub table: [f64; 2],
    /// The paper's figures.
    pub paper: PaperBody,
    /// By the sector model, then by the swept finger.
    pub models: [ModelBody; 2],
    /// Our planner's verdicts on every scene, by the swept finger: planned with places, and checked.
    pub plans: PlansBody,
    /// The same for the scenes that are a deadlock by the sector model but not by the swept finger.
    pub extra: PlansBody,
    /// True if the 95 % intervals of the deadlock rates of LOBS, ours by the sector model and the paper's, don't overlap.
    pub disagrees: bool,
    /// Our deadlocks by the swept finger over ours by the sector model; null if the latter are 0.
    pub deadlock_ratio: Option<f64>,
    /// True if that ratio is at most one half, or null.
    pub at_most_half: bool,
}

/// The paper's figures of one column.
#[derive(Debug, Serialize)]
pub struct PaperBody {
    /// Episodes in each column.
    pub episodes: usize,
    /// The baseline and LOBS.
    pub methods: [PaperMethodBody; 2],
}

/// The paper's figures of one method in one column.
#[derive(Debug, Serialize)]
pub struct PaperMethodBody {
    /// `forward_astar`, "Base" there, or `lobs`, "Ours" there.
    pub method: SearchWord,
    /// Episodes called a deadlock over all episodes.
    pub deadlock_rate: f64,
    /// Its 95 % interval (Wilson), not given in the paper.
    pub deadlock_interval: [f64; 2],
    /// Episodes decided within a minute over all episodes.
    pub success_rate: f64,
    /// Mean search time, s.
    pub search_s_mean: f64,
    /// Mean length of the sequences; 0 if there is none.
    pub relocations_mean: f64,
}

/// All methods on the bases of one grasp model.
#[derive(Debug, Serialize)]
pub struct ModelBody {
    /// `sector` or `swept_finger`.
    pub grasp_model: GraspModelWord,
    /// Mean time of a complete base, s.
    pub knowledge_s_mean: Option<f64>,
    /// Its median.
    pub knowledge_s_median: Option<f64>,
    /// The baseline, LOBS, ours.
    pub methods: [MethodBody; 3],
}

/// One method on the bases of one grasp model.
#[derive(Debug, Serialize)]
pub struct MethodBody {
    /// `forward_astar`, `lobs` or `landmarks`.
    pub method: SearchWord,
    /// The number of its scenes, the first ones.
    pub episodes: usize,
    /// Episodes with a deadlock.
    pub deadlocks: usize,
    /// Deadlocks over all episodes.
    pub deadlock_rate: Option<f64>,
    /// The rate's 95 % interval (Wilson).
    pub deadlock_interval: [f64; 2],
    /// Episodes that ended with a sequence or a deadlock.
    pub successes: usize,
    /// Successes over all episodes.
    pub success_rate: Option<f64>,
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
    /// Mean search time over all episodes, s; unfinished ones count as the time limit.
    pub search_s_mean: Option<f64>,
    /// Its median.
    pub search_s_median: Option<f64>,
    /// Mean number of relocations over the episodes with a sequence, the target not counted.
    pub relocations_mean: Option<f64>,
}

/// Our planner's verdicts on some scenes.
#[derive(Debug, Serialize)]
pub struct PlansBody {
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
    /// Mean time of a whole answer, s: knowledge, search, places and check.
    pub plan_s_mean: Option<f64>,
    /// Its median.
    pub plan_s_median: Option<f64>,
}

impl Table1Body {
    /// The table of these settings.
    pub fn new(settings: &ExperimentSettings, columns: &[Table1Column]) -> Self {
        Self {
            table: "table1",
            seed: settings.seed,
            episodes: settings.episodes,
            base_episodes: settings.base_episodes,
            time_limit_ms: settings.time_limit_ms(),
            columns: columns.iter().map(Table1ColumnBody::new).collect(),
        }
    }
}

impl Table1ColumnBody {
    fn new(column: &Table1Column) -> Self {
        let (base, lobs) = (&column.case.base, &column.case.lobs);
        let paper =
            [PaperMethodBody::new(SearchMethod::ForwardAstar, base), PaperMethodBody::new(SearchMethod::Lobs, lobs)];
        Self {
            objects: column.case.objects,
            table: column.case.table.into(),
            paper: PaperBody { episodes: TABLE1_EPISODES, methods: paper },
            models: [&column.sector, &column.swept_finger].map(ModelBody::new),
            plans: PlansBody::new(&column.plans),
            extra: PlansBody::new(&column.extra),
            disagrees: column.disagrees(),
            deadlock_ratio: column.deadlock_ratio(),
            at_most_half: column.at_most_half(),
        }
    }
}

impl PaperMethodBody {
    fn new(method: SearchMethod, printed: &Printed) -> Self {
        Self {
            method: method.into(),
            deadlock_rate: printed.deadlock_rate(),
            deadlock_interval: ends(printed.deadlock_interval()),
            success_rate: printed.success_rate(),
            search_s_mean: printed.search_s,
            relocations_mean: printed.relocations,
        }
    }
}

impl ModelBody {
    fn new(figures: &ModelFigures) -> Self {
        Self {
            grasp_model: figures.grasp_model.into(),
            knowledge_s_mean: mean(figures.knowledge_s),
            knowledge_s_median: median(figures.knowledge_s),
            methods: figures.methods.each_ref().map(MethodBody::new),
        }
    }
}

impl MethodBody {
    fn new(figures: &MethodFigures) -> Self {
        Self {
            method: figures.method.into(),
            episodes: figures.episodes,
            deadlocks: figures.deadlocks,
            deadlock_rate: rate(figures.deadlocks, figures.episodes),
            deadlock_interval: ends(figures.deadlock_interval()),
            successes: figures.successes,
            success_rate: rate(figures.successes, figures.episodes),
            graspable: figures.graspable,
            late: figures.late,
            too_large: figures.too_large,
            false_deadlocks: figures.false_deadlocks,
            not_optimal: figures.not_optimal,
            search_s_mean: mean(figures.search_s),
            search_s_median: median(figures.search_s),
            relocations_mean: figures.relocations_mean,
        }
    }
}

impl PlansBody {
    fn new(figures: &PlanFigures) -> Self {
        Self {
            episodes: figures.episodes,
            graspable: figures.graspable,
            relocate: figures.relocate,
            optimal: figures.optimal,
            deadlock: figures.deadlock,
            no_space: figures.no_space,
            timed_out: figures.timed_out,
            relocations_mean: figures.relocations_mean,
            plan_s_mean: mean(figures.plan_s),
            plan_s_median: median(figures.plan_s),
        }
    }
}

/// A rate from 0 to 1; `None` if `whole` is 0.
pub(super) fn rate(part: usize, whole: usize) -> Option<f64> {
    (whole > 0).then(|| part as f64 / whole as f64)
}

pub(super) fn mean(spread: Option<Spread>) -> Option<f64> {
    spread.map(|spread| spread.mean)
}

pub(super) fn median(spread: Option<Spread>) -> Option<f64> {
    spread.map(|spread| spread.median)
}

fn ends(interval: ConfidenceInterval) -> [f64; 2] {
    [interval.low, interval.high]
}
