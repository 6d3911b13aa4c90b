//! Table II as JSON.

use std::collections::BTreeMap;

use serde::Serialize;

use super::settings::PlacementWord;
use super::table1::{mean, median, rate};
use crate::experiments::{ExperimentSettings, PlacementFigures, PrintedReposition, TABLE2_EPISODES, Table2Column};

/// Table II. Rates are from 0 to 1, times in seconds; null if there is nothing to measure.
#[derive(Debug, Serialize)]
pub struct Table2Body {
    /// `table2`.
    pub table: &'static str,
    /// The seed of the scenes.
    pub seed: u64,
    /// Episodes asked for in each column.
    pub episodes: usize,
    /// For each search and each plan.
    pub time_limit_ms: u64,
    /// The columns N = 16, 18, 20.
    pub columns: Vec<Table2ColumnBody>,
}

/// One column.
#[derive(Debug, Serialize)]
pub struct Table2ColumnBody {
    /// N, the target included.
    pub objects: usize,
    /// Width and height of the table, m.
    pub table: [f64; 2],
    /// The paper's figures.
    pub paper: PaperRepositionBody,
    /// The number of scenes drawn for the episodes.
    pub drawn: usize,
    /// The paper's placement method, then ours, for the same sequences.
    pub placements: [PlacementBody; 2],
}

/// The paper's figures of one column.
#[derive(Debug, Serialize)]
pub struct PaperRepositionBody {
    /// Episodes in each column.
    pub episodes: usize,
    /// Episodes with a place for every object over all episodes.
    pub success_rate: Option<f64>,
    /// Mean time to find the places of one episode, s.
    pub reposition_s_mean: Option<f64>,
}

/// One placement method for the sequences of LOBS on the sector model's base.
#[derive(Debug, Serialize)]
pub struct PlacementBody {
    /// The method.
    pub placement: PlacementWord,
    /// The number of its sequences.
    pub episodes: usize,
    /// Episodes with a place for every object of the sequence.
    pub successes: usize,
    /// Of those, episodes that need none: the target is graspable at once.
    pub graspable: usize,
    /// Successes over all episodes.
    pub success_rate: Option<f64>,
    /// Episodes without places.
    pub no_space: usize,
    /// Episodes that timed out.
    pub late: usize,
    /// Mean time to find the places of one episode, s, if any are needed; time-outs count as the time limit.
    pub reposition_s_mean: Option<f64>,
    /// Its median.
    pub reposition_s_median: Option<f64>,
    /// Plans with any fault by the checker, which uses the swept finger.
    pub faulty: usize,
    /// Plans in which a finger meets an obstacle at release.
    pub release_blocked: usize,
    /// Plans with any other fault.
    pub otherwise_faulty: usize,
    /// The number of each fault in all plans, by code.
    pub faults: BTreeMap<&'static str, usize>,
}

impl Table2Body {
    /// The table of these settings.
    pub fn new(settings: &ExperimentSettings, columns: &[Table2Column]) -> Self {
        Self {
            table: "table2",
            seed: settings.seed,
            episodes: settings.episodes,
            time_limit_ms: settings.time_limit_ms(),
            columns: columns.iter().map(Table2ColumnBody::new).collect(),
        }
    }
}

impl Table2ColumnBody {
    fn new(column: &Table2Column) -> Self {
        Self {
            objects: column.case.objects,
            table: column.case.table.into(),
            paper: PaperRepositionBody {
                episodes: TABLE2_EPISODES,
                success_rate: column.case.reposition.as_ref().map(PrintedReposition::success_rate),
                reposition_s_mean: column.case.reposition.map(|printed| printed.reposition_s),
            },
            drawn: column.drawn,
            placements: column.placements.each_ref().map(PlacementBody::new),
        }
    }
}

impl PlacementBody {
    fn new(figures: &PlacementFigures) -> Self {
        Self {
            placement: figures.placement.into(),
            episodes: figures.episodes,
            successes: figures.successes,
            graspable: figures.graspable,
            success_rate: rate(figures.successes, figures.episodes),
            no_space: figures.no_space,
            late: figures.late,
            reposition_s_mean: mean(figures.reposition_s),
            reposition_s_median: median(figures.reposition_s),
            faulty: figures.faulty,
            release_blocked: figures.release_blocked,
            otherwise_faulty: figures.otherwise_faulty,
            faults: figures.faults.clone(),
        }
    }
}
