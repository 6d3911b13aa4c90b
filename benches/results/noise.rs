//! What `client-examples/robot-cell/run noise --out` writes, and what its cells come to together.

use serde::Deserialize;

use crate::markdown::ratio;
use crate::robot::{Tallied, Tally};

/// A margin is enough from here on.
pub(crate) const ENOUGH: f64 = 0.99;

/// The camera's errors against the margin that is planned with.
#[derive(Deserialize)]
pub(crate) struct Noise {
    pub(crate) command: String,
    pub(crate) objects: u32,
    /// Of each cell.
    pub(crate) episodes: u32,
    pub(crate) cells: Vec<Tallied<Cell>>,
}

/// What a cell's episodes have in common.
#[derive(Deserialize)]
pub(crate) struct Cell {
    /// Of the camera along x and along y, m.
    pub(crate) sigma: f64,
    /// m.
    pub(crate) margin: f64,
    /// rad.
    pub(crate) yaw_tolerance: f64,
}

/// Cells taken together.
pub(crate) struct Pool<'a>(Vec<&'a Tally>);

impl Noise {
    /// The values that cells have of something, ascending.
    pub(crate) fn values(&self, of: impl Fn(&Cell) -> f64) -> Vec<f64> {
        let mut values: Vec<f64> = self.cells.iter().map(|cell| of(&cell.of)).collect();
        values.sort_unstable_by(f64::total_cmp);
        values.dedup();
        values
    }

    /// The cells that are chosen.
    pub(crate) fn pool(&self, chosen: impl Fn(&Cell) -> bool) -> Pool<'_> {
        Pool(self.cells.iter().filter(|cell| chosen(&cell.of)).map(|cell| &cell.tally).collect())
    }

    /// Each sigma with each yaw tolerance.
    pub(crate) fn series(&self) -> Vec<(f64, f64)> {
        let tolerances = self.values(|cell| cell.yaw_tolerance);
        let with = |sigma: f64| tolerances.iter().map(move |&tolerance| (sigma, tolerance));
        self.values(|cell| cell.sigma).into_iter().flat_map(with).collect()
    }

    /// The least margin that is enough for this sigma with this yaw tolerance, as is every larger one.
    pub(crate) fn least_margin(&self, sigma: f64, yaw_tolerance: f64) -> Option<f64> {
        let enough = |margin: &f64| {
            let (unharmed, judged) = self.pool(|cell| cell.is(sigma, yaw_tolerance, *margin)).unharmed();
            ratio(unharmed, judged).is_some_and(|rate| rate >= ENOUGH)
        };
        self.values(|cell| cell.margin).into_iter().rev().take_while(enough).last()
    }
}

impl Cell {
    /// True for the cell with these.
    pub(crate) fn is(&self, sigma: f64, yaw_tolerance: f64, margin: f64) -> bool {
        (self.sigma, self.yaw_tolerance, self.margin) == (sigma, yaw_tolerance, margin)
    }
}

impl Pool<'_> {
    /// A count over all cells.
    pub(crate) fn sum(&self, count: impl Fn(&Tally) -> u32) -> u32 {
        self.0.iter().map(|tally| count(tally)).sum()
    }

    /// Successes, and the episodes that were judged.
    pub(crate) fn success(&self) -> (u32, u32) {
        (self.sum(|tally| tally.success), self.sum(|tally| tally.judged))
    }

    /// Judged episodes in which nothing was hit or dropped, and all that were judged.
    pub(crate) fn unharmed(&self) -> (u32, u32) {
        let judged = self.sum(|tally| tally.judged);
        (judged - self.sum(|tally| tally.harmed), judged)
    }

    /// `None` where no episode was judged.
    pub(crate) fn success_rate(&self) -> Option<f64> {
        let (success, judged) = self.success();
        ratio(success, judged)
    }

    /// Episodes that ended at a deadlock or without space, and all.
    pub(crate) fn without_plan(&self) -> (u32, u32) {
        (self.sum(|tally| tally.end("deadlock") + tally.end("no_space")), self.sum(|tally| tally.episodes))
    }

    /// Relocations over episodes.
    pub(crate) fn relocations(&self) -> Option<f64> {
        ratio(self.sum(|tally| tally.relocations), self.sum(|tally| tally.episodes))
    }
}
