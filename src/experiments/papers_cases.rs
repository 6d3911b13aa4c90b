//! The cases of the paper's section V, with the figures of its Tables I and II.

use super::recipe::Recipe;
use super::sample::ConfidenceInterval;

/// The episodes in each column of Table I.
pub const TABLE1_EPISODES: usize = 20;

/// The episodes in each column of Table II.
pub const TABLE2_EPISODES: usize = 10;

/// One column of the tables.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PapersCase {
    /// N, the target included.
    pub objects: usize,
    /// Width and height of the table, m.
    pub table: (f64, f64),
    /// The baseline's figures in Table I.
    pub base: Printed,
    /// The figures of LOBS in Table I, "Ours" there.
    pub lobs: Printed,
    /// The figures of Table II, which has Case I only.
    pub reposition: Option<PrintedReposition>,
}

/// One method's figures in Table I.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Printed {
    /// Episodes of [`TABLE1_EPISODES`] called a deadlock: there a rate in steps of 5 %.
    pub deadlocks: usize,
    /// Episodes of [`TABLE1_EPISODES`] decided within a minute.
    pub successes: usize,
    /// Mean search time, s.
    pub search_s: f64,
    /// Mean length of the sequences, 0 if there is none. Algorithm 1 as printed counts the target too.
    pub relocations: f64,
}

/// The figures of one column of Table II.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrintedReposition {
    /// Episodes of [`TABLE2_EPISODES`] with a place for every object: there a rate in steps of 10 %.
    pub successes: usize,
    /// Mean time to find the places of one episode, s.
    pub reposition_s: f64,
}

/// Case I (three objects more or fewer on one table), then Case II (one density).
pub const PAPERS_CASES: [PapersCase; 6] = [
    case(16, (1.2, 0.7), printed(0, 19, 3.58, 2.00), printed(4, 20, 0.14, 2.00), reposition(2.67)),
    case(18, (1.2, 0.7), printed(0, 16, 12.88, 2.00), printed(5, 20, 0.17, 2.07), reposition(2.93)),
    case(20, (1.2, 0.7), printed(0, 14, 19.08, 2.07), printed(11, 20, 0.21, 2.44), reposition(2.76)),
    case(25, (1.4, 0.7), printed(0, 11, 6.13, 2.09), printed(7, 20, 0.26, 2.23), None),
    case(37, (1.4, 1.04), printed(0, 7, 25.96, 2.00), printed(11, 20, 0.53, 2.33), None),
    case(50, (1.4, 1.4), printed(0, 0, 60.00, 0.00), printed(7, 20, 0.93, 2.54), None),
];

const fn case(
    objects: usize,
    table: (f64, f64),
    base: Printed,
    lobs: Printed,
    reposition: Option<PrintedReposition>,
) -> PapersCase {
    PapersCase { objects, table, base, lobs, reposition }
}

const fn printed(deadlocks: usize, successes: usize, search_s: f64, relocations: f64) -> Printed {
    Printed { deadlocks, successes, search_s, relocations }
}

/// Every column of Table II has the success rate 100 %.
const fn reposition(reposition_s: f64) -> Option<PrintedReposition> {
    Some(PrintedReposition { successes: TABLE2_EPISODES, reposition_s })
}

impl PapersCase {
    /// The paper's gripper and plates.
    pub(super) fn recipe(&self) -> Recipe {
        Recipe { objects: self.objects, table: self.table, ..Recipe::default() }
    }
}

impl Printed {
    /// The deadlock rate, 0 to 1.
    pub fn deadlock_rate(&self) -> f64 {
        self.deadlocks as f64 / TABLE1_EPISODES as f64
    }

    /// The 95 % interval of the deadlock rate.
    pub fn deadlock_interval(&self) -> ConfidenceInterval {
        ConfidenceInterval::wilson(self.deadlocks, TABLE1_EPISODES)
    }

    /// The success rate, 0 to 1.
    pub fn success_rate(&self) -> f64 {
        self.successes as f64 / TABLE1_EPISODES as f64
    }
}

impl PrintedReposition {
    /// The success rate, 0 to 1.
    pub fn success_rate(&self) -> f64 {
        self.successes as f64 / TABLE2_EPISODES as f64
    }
}
