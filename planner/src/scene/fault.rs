//! Faults and warnings of a scene, as data: the place and the flaw.

use super::flaw::Flaw;

/// A place in the scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// The list of objects as a whole.
    Objects,
    /// The table as a whole.
    WholeTable,
    /// A field of the table top.
    Table(&'static str),
    /// A field of the n-th keep-out rectangle.
    KeepOut(usize, &'static str),
    /// A field of the gripper.
    Gripper(&'static str),
    /// A field of the n-th object.
    Object(usize, &'static str),
    /// The n-th object as a whole.
    WholeObject(usize),
    /// A field of the n-th object's shape.
    Shape(usize, &'static str),
    /// A coordinate of the m-th point of the n-th object's shape.
    Point(usize, usize, &'static str),
    /// A field of the m-th grasp of the n-th object.
    Grasp(usize, usize, &'static str),
    /// The target's id.
    Target,
    /// A field of the goal: its list of ids.
    Goal(&'static str),
    /// The n-th id of the goal's list.
    GoalMember(&'static str, usize),
    /// Where objects go that have to move.
    Destination,
    /// The list of drop-offs as a whole.
    DropOffs,
    /// A field of the n-th drop-off.
    DropOff(usize, &'static str),
    /// The m-th id that the n-th drop-off accepts.
    Accepts(usize, usize),
}

/// A flaw and its place.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// The place.
    pub place: Place,
    /// The flaw.
    pub flaw: Flaw,
}

/// A list of findings with at most [`MAX_FINDINGS`] entries.
#[derive(Debug, Default)]
pub(super) struct Findings {
    list: Vec<Finding>,
}

/// The most faults, and the most warnings, that one scene gets.
pub const MAX_FINDINGS: usize = 1000;

impl Findings {
    pub(super) fn add(&mut self, place: Place, flaw: Flaw) {
        if !self.full() {
            self.list.push(Finding { place, flaw });
        }
    }

    pub(super) fn extend(&mut self, place: Place, flaws: impl IntoIterator<Item = Flaw>) {
        flaws.into_iter().for_each(|flaw| self.add(place, flaw));
    }

    /// Those that came later, as far as there is room.
    pub(super) fn append(&mut self, later: Self) {
        later.list.into_iter().for_each(|finding| self.add(finding.place, finding.flaw));
    }

    pub(super) fn full(&self) -> bool {
        self.list.len() >= MAX_FINDINGS
    }

    pub(super) fn into_vec(self) -> Vec<Finding> {
        self.list
    }
}
