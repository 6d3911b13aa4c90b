//! What `singulate experiment table1|table2 --format json` writes: rates from 0 to 1, times in seconds.

use serde::Deserialize;

/// Table I.
#[derive(Deserialize)]
pub(crate) struct Table1 {
    pub(crate) seed: u64,
    pub(crate) episodes: u32,
    /// Those of them that the baseline was given.
    pub(crate) base_episodes: u32,
    pub(crate) time_limit_ms: u32,
    pub(crate) columns: Vec<Column1>,
}

/// A column of Table I.
#[derive(Deserialize)]
pub(crate) struct Column1 {
    /// N, the target included.
    pub(crate) objects: u32,
    /// Width and height, m.
    pub(crate) table: [f64; 2],
    pub(crate) paper: Paper1,
    pub(crate) models: Vec<Model>,
    /// Our planner's verdicts on all scenes, by the swept finger.
    pub(crate) plans: Plans,
    /// The same for the scenes that only the sector model calls a deadlock.
    pub(crate) extra: Plans,
    /// The 95 % intervals of LOBS, ours by the sector model and the paper's, don't overlap.
    pub(crate) disagrees: bool,
    /// Deadlocks by the swept finger over those by the sector model.
    pub(crate) deadlock_ratio: Option<f64>,
    pub(crate) at_most_half: bool,
}

/// What the paper prints.
#[derive(Deserialize)]
pub(crate) struct Paper1 {
    pub(crate) episodes: u32,
    pub(crate) methods: Vec<Printed>,
}

/// One method as the paper prints it.
#[derive(Deserialize)]
pub(crate) struct Printed {
    pub(crate) method: String,
    pub(crate) deadlock_rate: f64,
    pub(crate) deadlock_interval: [f64; 2],
    pub(crate) success_rate: f64,
    pub(crate) search_s_mean: f64,
    pub(crate) relocations_mean: f64,
}

/// All methods on the bases of one grasp model.
#[derive(Deserialize)]
pub(crate) struct Model {
    pub(crate) grasp_model: String,
    pub(crate) methods: Vec<Method>,
}

/// One method.
#[derive(Deserialize)]
pub(crate) struct Method {
    pub(crate) method: String,
    pub(crate) episodes: u32,
    /// Searches that the time limit, or the limit of memory, ended.
    pub(crate) late: u32,
    pub(crate) too_large: u32,
    pub(crate) deadlock_rate: Option<f64>,
    pub(crate) deadlock_interval: [f64; 2],
    pub(crate) success_rate: Option<f64>,
    pub(crate) false_deadlocks: u32,
    pub(crate) not_optimal: u32,
    pub(crate) search_s_mean: Option<f64>,
    pub(crate) relocations_mean: Option<f64>,
}

/// What became of some scenes.
#[derive(Deserialize)]
pub(crate) struct Plans {
    pub(crate) episodes: u32,
    pub(crate) graspable: u32,
    pub(crate) relocate: u32,
    pub(crate) optimal: u32,
    pub(crate) deadlock: u32,
    pub(crate) no_space: u32,
    pub(crate) timed_out: u32,
    /// Of a whole answer.
    pub(crate) plan_s_mean: Option<f64>,
}

/// Table II.
#[derive(Deserialize)]
pub(crate) struct Table2 {
    pub(crate) seed: u64,
    pub(crate) episodes: u32,
    pub(crate) time_limit_ms: u32,
    pub(crate) columns: Vec<Column2>,
}

/// A column of Table II.
#[derive(Deserialize)]
pub(crate) struct Column2 {
    pub(crate) objects: u32,
    pub(crate) paper: Paper2,
    pub(crate) placements: Vec<Placement>,
}

/// What the paper prints.
#[derive(Deserialize)]
pub(crate) struct Paper2 {
    pub(crate) episodes: u32,
    pub(crate) success_rate: f64,
    pub(crate) reposition_s_mean: f64,
}

/// One way to find places.
#[derive(Deserialize)]
pub(crate) struct Placement {
    pub(crate) placement: String,
    pub(crate) episodes: u32,
    pub(crate) successes: u32,
    /// Episodes in which no place is needed.
    pub(crate) graspable: u32,
    pub(crate) no_space: u32,
    pub(crate) late: u32,
    pub(crate) reposition_s_mean: Option<f64>,
    /// Plans in which the checker finds any fault.
    pub(crate) faulty: u32,
    pub(crate) release_blocked: u32,
}

impl Table1 {
    /// The command that writes it.
    pub(crate) fn command(&self) -> String {
        format!(
            "singulate experiment table1 --episodes {} --base-episodes {} --seed {} --time-limit-ms {} --format json",
            self.episodes, self.base_episodes, self.seed, self.time_limit_ms
        )
    }
}

impl Table2 {
    /// The command that writes it.
    pub(crate) fn command(&self) -> String {
        format!(
            "singulate experiment table2 --episodes {} --seed {} --time-limit-ms {} --format json",
            self.episodes, self.seed, self.time_limit_ms
        )
    }
}

impl Method {
    /// Searches that did not end by themselves: their time counts as the limit.
    pub(crate) fn capped(&self) -> u32 {
        self.late + self.too_large
    }
}

impl Column1 {
    /// A method on a grasp model's bases.
    pub(crate) fn method(&self, grasp_model: &str, method: &str) -> &Method {
        let model = self.models.iter().find(|model| model.grasp_model == grasp_model).expect("both models");
        model.methods.iter().find(|found| found.method == method).expect("all methods")
    }

    /// A method as the paper prints it.
    pub(crate) fn printed(&self, method: &str) -> &Printed {
        self.paper.methods.iter().find(|found| found.method == method).expect("both of the paper's methods")
    }
}
