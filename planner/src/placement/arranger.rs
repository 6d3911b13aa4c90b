//! Depth-first search over the next object of a set and its place, or a drop-off.

use nalgebra::Point2;

use super::candidates::{Candidates, PlaceSpec};
use super::drop_offs::DropOffs;
use super::effort::EffortMeter;
use super::layout::Layout;
use super::orientations::orientations;
use super::tabletop::Tabletop;
use super::task::{Arrangement, Drops, Task};
use super::{Move, Objective, Relocation, Removal};
use crate::budget::Stop;
use crate::geometry::{Grasp, Hold};
use crate::scene::{ObjectIndex, Pose, distance};

pub(super) struct Arranger<'a, 'e> {
    task: &'a Task<'a>,
    gaps: &'a [f64],
    /// See [`PlaceSpec::focus`].
    focus: Point2<f64>,
    table: Tabletop<'a, 'e>,
    /// The number of objects, and of places of each, that are tried at each step.
    width: usize,
    /// True if the width left something untried.
    truncated: bool,
    moves: Vec<Move>,
    /// What is at the drop-offs: what leaves the table in any case, and one object more for each of the others so far.
    drop_offs: Vec<DropOffs<'a>>,
}

impl<'a, 'e> Arranger<'a, 'e> {
    /// `drop_offs` hold what leaves the table in any case.
    pub(super) fn new(
        task: &'a Task<'a>,
        gaps: &'a [f64],
        width: usize,
        drop_offs: DropOffs<'a>,
        meter: EffortMeter<'e>,
    ) -> Self {
        let table = Tabletop::new(Layout::new(task.scene, task.model), meter);
        let (focus, drop_offs) = (task.focus(), vec![drop_offs]);
        Self { task, gaps, focus, table, width, truncated: false, moves: Vec::new(), drop_offs }
    }

    /// True if the width left something untried.
    pub(super) fn truncated(&self) -> bool {
        self.truncated
    }

    /// Takes away what leaves the table and can be grasped, moves one of the other objects, then the rest.
    pub(super) fn step(&mut self, remaining: &[ObjectIndex], extra: usize) -> Result<Option<Arrangement>, Stop> {
        if !remaining.iter().any(|&object| self.task.leaves(object)) {
            return self.relocate_one(remaining, extra);
        }
        let before = self.moves.len();
        let rest = self.take_all_away(remaining)?;
        let done = self.relocate_one(&rest, extra)?;
        if done.is_none() {
            for gone in self.moves.split_off(before) {
                self.table.layout.lift(gone.object(), false);
            }
        }
        Ok(done)
    }

    /// Takes away what leaves the table, each object as soon as it can be grasped: that hinders nothing. Returns the others.
    fn take_all_away(&mut self, remaining: &[ObjectIndex]) -> Result<Vec<ObjectIndex>, Stop> {
        let mut rest = remaining.to_vec();
        loop {
            let before = rest.len();
            let mut staying = Vec::with_capacity(before);
            for object in rest {
                let hold = if self.task.leaves(object) { self.table.hold(object)? } else { None };
                match hold.and_then(|hold| self.grasp(object, hold)) {
                    Some(grasp) => self.take_away(object, grasp),
                    None => staying.push(object),
                }
            }
            rest = staying;
            if rest.len() == before {
                return Ok(rest);
            }
        }
    }

    /// Moves one of the remaining objects to another place, then the rest.
    fn relocate_one(&mut self, remaining: &[ObjectIndex], extra: usize) -> Result<Option<Arrangement>, Stop> {
        if remaining.is_empty() {
            return Ok(self.done());
        }
        let graspable = self.graspable(remaining)?;
        self.truncated |= graspable.len() > self.width;
        for &(object, hold) in graspable.iter().take(self.width) {
            let rest: Vec<ObjectIndex> = remaining.iter().copied().filter(|&other| other != object).collect();
            if let Some(done) = self.relocate((object, hold), &rest, extra)? {
                return Ok(Some(done));
            }
        }
        if extra > 0
            && let Some(&stuck) = graspable.first()
            && self.task.drops != Drops::All
        {
            return self.make_room(stuck, remaining, extra - 1);
        }
        Ok(None)
    }

    /// The arrangement, once all of the set was moved.
    fn done(&self) -> Option<Arrangement> {
        let target_grasp = match self.task.scene.target() {
            Some(target) => Some((target, self.table.layout.grasp(target)?)),
            None => None,
        };
        let places = self.drop_offs.last()?.places();
        let moves = self.moves.iter().map(|&step| match step {
            Move::Drop(removal) => {
                places[removal.object.get()].map(|drop_off| Move::Drop(Removal { drop_off, ..removal }))
            }
            Move::Place(_) => Some(step),
        });
        Some(Arrangement { moves: moves.collect::<Option<_>>()?, target_grasp })
    }

    /// The first of the remaining objects that can be grasped, at most one more than the width. The extra one shows that
    /// the width left something out.
    fn graspable(&mut self, remaining: &[ObjectIndex]) -> Result<Vec<(ObjectIndex, Hold)>, Stop> {
        let mut graspable = Vec::new();
        for &object in remaining {
            graspable.extend(self.table.hold(object)?.map(|hold| (object, hold)));
            if graspable.len() > self.width {
                break;
            }
        }
        Ok(graspable)
    }

    /// Moves some other object whose absence gives `stuck` a place.
    fn make_room(
        &mut self,
        stuck: (ObjectIndex, Hold),
        remaining: &[ObjectIndex],
        extra: usize,
    ) -> Result<Option<Arrangement>, Stop> {
        let scene = self.task.scene;
        let other = |object: &ObjectIndex| {
            scene.movable(*object)
                && self.task.kept.binary_search(object).is_err()
                && !remaining.contains(object)
                && !self.table.layout.is_lifted(*object)
        };
        let others: Vec<ObjectIndex> = scene.indices().filter(other).collect();
        for object in others {
            let Some(hold) = self.table.hold(object)? else { continue };
            if self.frees_a_place(object, stuck, remaining)?
                && let Some(done) = self.relocate((object, hold), remaining, extra)?
            {
                return Ok(Some(done));
            }
        }
        Ok(None)
    }

    /// True if `stuck` has a place once `object` is gone.
    fn frees_a_place(
        &mut self,
        object: ObjectIndex,
        (stuck, hold): (ObjectIndex, Hold),
        remaining: &[ObjectIndex],
    ) -> Result<bool, Stop> {
        let rest: Vec<ObjectIndex> = remaining.iter().copied().filter(|&other| other != stuck).collect();
        self.table.layout.lift(object, true);
        self.table.layout.lift(stuck, true);
        let mut found = false;
        for yaw in orientations(&self.table.layout, stuck) {
            let mut candidates = Candidates::new(&self.table.layout, self.spec(stuck, yaw, 0.0));
            found = self.table.next_place(&mut candidates, (stuck, hold), &rest, |_| false)?.is_some();
            if found {
                break;
            }
        }
        self.table.layout.lift(stuck, false);
        self.table.layout.lift(object, false);
        Ok(found)
    }

    /// Tries places for `object`, best first, then the drop-offs, and goes on with `rest` from each.
    fn relocate(
        &mut self,
        (object, hold): (ObjectIndex, Hold),
        rest: &[ObjectIndex],
        extra: usize,
    ) -> Result<Option<Arrangement>, Stop> {
        for place in self.places((object, hold), rest)? {
            if let Some(done) = self.go_on((object, hold), place, rest, extra)? {
                return Ok(Some(done));
            }
        }
        let Drops::UpTo(most) = self.task.drops else { return Ok(None) };
        let Some(held) = self.drop_offs.last().filter(|_| self.drop_offs.len() <= most) else { return Ok(None) };
        let mut held = held.clone();
        if !held.take(object, |looks| self.table.spend(looks))? {
            return Ok(None);
        }
        let Some(grasp) = self.grasp(object, hold) else { return Ok(None) };
        self.drop_offs.push(held);
        self.take_away(object, grasp);
        let done = self.step(rest, extra)?;
        if done.is_none() {
            self.moves.pop();
            self.table.layout.lift(object, false);
            self.drop_offs.pop();
        }
        Ok(done)
    }

    /// The grasp of an object where it stands, in the first of some ways to hold it.
    fn grasp(&self, object: ObjectIndex, hold: Hold) -> Option<Grasp> {
        hold.grasp(self.table.layout.placed(object))
    }

    /// Takes `object` away. The drop-off is known in the end, since objects may move on to others.
    fn take_away(&mut self, object: ObjectIndex, grasp: Grasp) {
        let from = self.table.layout.footprint(object).pose();
        self.table.layout.lift(object, true);
        self.moves.push(Move::Drop(Removal { object, from, grasp, drop_off: 0 }));
    }

    /// The best places for `object`, as many as the width admits. They are found before any is tried: candidates take
    /// memory by the size of the scene, and a plan may be hundreds of steps deep.
    fn places(&mut self, (object, hold): (ObjectIndex, Hold), rest: &[ObjectIndex]) -> Result<Vec<(Pose, Hold)>, Stop> {
        let radius = self.table.layout.footprint(object).circumradius();
        let mut places: Vec<(Pose, Hold)> = Vec::new();
        self.table.layout.lift(object, true);
        let yaws = orientations(&self.table.layout, object);
        let passes = self.gaps.iter().map(|&preferred| (preferred, false)).chain([(0.0, true)]);
        for ((preferred, spread), &yaw) in passes.flat_map(|pass| yaws.iter().map(move |yaw| (pass, yaw))) {
            if places.len() >= self.width {
                break;
            }
            let spec = self.spec(object, yaw, preferred);
            let mut candidates = if spread {
                Candidates::spread(&self.table.layout, spec)
            } else {
                Candidates::new(&self.table.layout, spec)
            };
            // Where one place fails, its neighbours usually fail too.
            let near = |places: &[(Pose, Hold)], at: Pose| {
                places.iter().any(|(other, _)| other.yaw == at.yaw && distance(other.at, at.at) < radius)
            };
            while places.len() < self.width
                && let Some(place) =
                    self.table.next_place(&mut candidates, (object, hold), rest, |at| near(&places, at))?
            {
                places.push(match self.task.objective {
                    Objective::FarFromTarget => place,
                    Objective::ShortMoves => self.table.pull_back(&candidates, (object, hold), rest, place)?,
                });
            }
        }
        self.table.layout.lift(object, false);
        // There may be more places than were looked for.
        self.truncated |= places.len() >= self.width;
        Ok(places)
    }

    fn go_on(
        &mut self,
        (object, hold): (ObjectIndex, Hold),
        (to, release): (Pose, Hold),
        rest: &[ObjectIndex],
        extra: usize,
    ) -> Result<Option<Arrangement>, Stop> {
        let from = self.table.layout.footprint(object).pose();
        let kept = hold.and(release);
        let Some(grasp) = kept.and_then(|kept| self.grasp(object, kept)) else { return Ok(None) };
        let gap = self.table.layout.gap(object, &self.table.layout.footprint(object).moved_to(to));
        let before = self.table.layout.put(object, to);
        let Some(release) = release.grasp(self.table.layout.placed(object)) else {
            self.table.layout.take_back(object, before);
            return Ok(None);
        };
        self.moves.push(Move::Place(Relocation { object, from, to, grasp, release, gap }));
        let done = self.step(rest, extra)?;
        if done.is_none() {
            self.moves.pop();
            self.table.layout.take_back(object, before);
        }
        Ok(done)
    }

    fn spec(&self, object: ObjectIndex, yaw: f64, preferred: f64) -> PlaceSpec {
        PlaceSpec {
            object,
            yaw,
            gap: self.task.scene.gripper().margin() + preferred,
            edge_gap: preferred,
            objective: self.task.objective,
            focus: self.focus,
        }
    }
}
