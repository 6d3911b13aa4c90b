//! The task of arranging one set of objects to move, and its result.

use nalgebra::{Point2, Vector2};

use super::{Move, Objective};
use crate::geometry::Grasp;
use crate::knowledge::GraspModel;
use crate::scene::{ObjectIndex, Scene};

/// Which objects are taken to drop-offs. What the goal wants away always is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Drops {
    /// No others.
    Wanted,
    /// So many others at most, where they find no place on the table.
    UpTo(usize),
    /// All.
    All,
}

/// The task: a set of objects to move, with its limits.
#[derive(Clone, Copy)]
pub struct Task<'a> {
    /// The scene at the start.
    pub scene: &'a Scene,
    /// Which yaws an obstacle blocks.
    pub model: &'a dyn GraspModel,
    /// The objects to move, in an order in which each becomes graspable.
    pub set: &'a [ObjectIndex],
    /// Objects that are never moved, in index order: all that may be grasped in the end.
    pub kept: &'a [ObjectIndex],
    /// The most extra relocations beyond those of the set: of objects that only stand in the way of a place, or of
    /// objects that were moved before.
    pub extra: usize,
    /// Which places are best.
    pub objective: Objective,
    /// Which objects leave the table.
    pub drops: Drops,
}

/// A physical plan.
#[derive(Debug, Clone, PartialEq)]
pub struct Arrangement {
    /// In order.
    pub moves: Vec<Move>,
    /// The target and its grasp at the end; `None` if the scene has none.
    pub target_grasp: Option<(ObjectIndex, Grasp)>,
}

impl Arrangement {
    /// The number of objects that leave the table.
    pub(super) fn drops(&self) -> usize {
        self.moves.iter().filter(|step| matches!(step, Move::Drop(_))).count()
    }

    /// The least gap at a new place, m; infinite if there is none.
    pub(super) fn least_gap(&self) -> f64 {
        let gap = |step: &Move| if let Move::Place(relocation) = step { relocation.gap } else { f64::INFINITY };
        self.moves.iter().map(gap).fold(f64::INFINITY, f64::min)
    }
}

impl Task<'_> {
    /// True if the object leaves the table in any case.
    pub(super) fn leaves(&self, object: ObjectIndex) -> bool {
        self.drops == Drops::All || self.scene.goal().wants_away(object)
    }

    /// The target's origin, or the middle of all that is wanted away.
    pub(super) fn focus(&self) -> Point2<f64> {
        let named = self.scene.goal().named();
        let at = |object: &ObjectIndex| self.scene.object(*object).footprint().at().coords;
        let sum: Vector2<f64> = named.iter().map(at).sum();
        Point2::from(sum / named.len().max(1) as f64)
    }
}
