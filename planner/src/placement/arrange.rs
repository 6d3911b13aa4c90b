//! An order and places for one set of objects to relocate.
//!
//! Depth-first search over the next object and its place, with iterative broadening (Ginsberg & Harvey 1992): the width
//! doubles each round, from the first order and the best places only to more of both.

use super::candidates::{Candidates, PlaceSpec};
use super::effort::{Effort, EffortMeter};
use super::layout::Layout;
use super::tabletop::Tabletop;
use super::{GAPS, Objective, ROOMIER_GAPS, Relocation};
use crate::budget::{Budget, Interrupted, Stop};
use crate::geometry::Grasp;
use crate::knowledge::GraspModel;
use crate::scene::{ObjectIndex, Pose, Scene, distance};

/// The task: a set of objects to relocate, with its limits.
#[derive(Clone, Copy)]
pub struct Task<'a> {
    /// The scene at the start.
    pub scene: &'a Scene,
    /// Which yaws an obstacle blocks.
    pub model: &'a dyn GraspModel,
    /// The objects to relocate, in an order in which each becomes graspable.
    pub set: &'a [ObjectIndex],
    /// The most extra relocations beyond those of the set: of objects that only stand in the way of a place, or of
    /// objects that were moved before.
    pub extra: usize,
    /// Which places are best.
    pub objective: Objective,
}

/// A physical plan.
#[derive(Debug, Clone, PartialEq)]
pub struct Arrangement {
    /// In order.
    pub relocations: Vec<Relocation>,
    /// The grasp of the target at the end.
    pub target_grasp: Grasp,
}

/// The width of the last round. Past that, other sets and extra moves promise more than further places of the same
/// kind.
const MAX_WIDTH: usize = 16;

/// An arrangement of the task. `None` if none was found among the candidates within the effort.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub fn arrange(task: &Task<'_>, effort: &mut Effort, budget: &Budget<'_>) -> Result<Option<Arrangement>, Interrupted> {
    let Some(found) = arrange_with(task, &GAPS, effort, budget)? else { return Ok(None) };
    if found.least_gap() >= task.scene.gripper().margin() + GAPS[0] {
        return Ok(Some(found));
    }
    // By a copy of the effort, and whatever the budget says: more room must not cost a plan.
    let roomier = arrange_with(task, &ROOMIER_GAPS, &mut { *effort }, budget).ok().flatten();
    Ok(Some(roomier.filter(|other| other.least_gap() > found.least_gap()).unwrap_or(found)))
}

impl Arrangement {
    fn least_gap(&self) -> f64 {
        self.relocations.iter().map(|relocation| relocation.gap).fold(f64::INFINITY, f64::min)
    }
}

fn arrange_with(
    task: &Task<'_>,
    gaps: &[f64],
    effort: &mut Effort,
    budget: &Budget<'_>,
) -> Result<Option<Arrangement>, Interrupted> {
    let mut width = 1;
    loop {
        let mut arranger = Arranger {
            task,
            gaps,
            table: Tabletop::new(Layout::new(task.scene, task.model), EffortMeter::new(effort, budget)),
            width,
            truncated: false,
            relocations: Vec::new(),
        };
        match arranger.step(task.set, task.extra) {
            Ok(Some(arrangement)) => return Ok(Some(arrangement)),
            Ok(None) if arranger.truncated && width < MAX_WIDTH => width *= 2,
            Ok(None) | Err(Stop::Spent) => return Ok(None),
            Err(Stop::Interrupted) => return Err(Interrupted),
        }
    }
}

struct Arranger<'a, 'e> {
    task: &'a Task<'a>,
    gaps: &'a [f64],
    table: Tabletop<'a, 'e>,
    /// The number of objects, and of places of each, that are tried at each step.
    width: usize,
    /// True if the width left something untried.
    truncated: bool,
    relocations: Vec<Relocation>,
}

impl Arranger<'_, '_> {
    /// Relocates one of the remaining objects, then the rest.
    fn step(&mut self, remaining: &[ObjectIndex], extra: usize) -> Result<Option<Arrangement>, Stop> {
        let target = self.task.scene.target();
        if remaining.is_empty() {
            let relocations = || self.relocations.clone();
            let done = self.table.layout.grasp(target);
            return Ok(done.map(|target_grasp| Arrangement { relocations: relocations(), target_grasp }));
        }
        let graspable = self.graspable(remaining)?;
        self.truncated |= graspable.len() > self.width;
        for &(object, grasp) in graspable.iter().take(self.width) {
            let rest: Vec<ObjectIndex> = remaining.iter().copied().filter(|&other| other != object).collect();
            if let Some(done) = self.relocate(object, grasp, &rest, extra)? {
                return Ok(Some(done));
            }
        }
        if extra > 0
            && let Some(&(stuck, _)) = graspable.first()
        {
            return self.make_room(stuck, remaining, extra - 1);
        }
        Ok(None)
    }

    /// The first of the remaining objects that can be grasped, at most one more than the width. The extra one shows that
    /// the width left something out.
    fn graspable(&mut self, remaining: &[ObjectIndex]) -> Result<Vec<(ObjectIndex, Grasp)>, Stop> {
        let mut graspable = Vec::new();
        for &object in remaining {
            graspable.extend(self.table.grasp(object)?.map(|grasp| (object, grasp)));
            if graspable.len() > self.width {
                break;
            }
        }
        Ok(graspable)
    }

    /// Moves some other object whose absence gives `stuck` a place.
    fn make_room(
        &mut self,
        stuck: ObjectIndex,
        remaining: &[ObjectIndex],
        extra: usize,
    ) -> Result<Option<Arrangement>, Stop> {
        let scene = self.task.scene;
        let other = |object: &ObjectIndex| {
            !scene.object(*object).fixed() && *object != scene.target() && !remaining.contains(object)
        };
        for object in scene.indices().filter(other) {
            let Some(grasp) = self.table.grasp(object)? else { continue };
            if self.frees_a_place(object, stuck, remaining)?
                && let Some(done) = self.relocate(object, grasp, remaining, extra)?
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
        stuck: ObjectIndex,
        remaining: &[ObjectIndex],
    ) -> Result<bool, Stop> {
        let rest: Vec<ObjectIndex> = remaining.iter().copied().filter(|&other| other != stuck).collect();
        self.table.layout.lift(object, true);
        self.table.layout.lift(stuck, true);
        let mut candidates = Candidates::new(&self.table.layout, self.spec(stuck, 0.0));
        let found = self.table.next_place(&mut candidates, stuck, &rest, |_| false)?;
        self.table.layout.lift(stuck, false);
        self.table.layout.lift(object, false);
        Ok(found.is_some())
    }

    /// Tries places for `object`, best first, and goes on with `rest` from each.
    fn relocate(
        &mut self,
        object: ObjectIndex,
        grasp: Grasp,
        rest: &[ObjectIndex],
        extra: usize,
    ) -> Result<Option<Arrangement>, Stop> {
        for (at, release) in self.places(object, rest)? {
            if let Some(done) = self.go_on(object, grasp, at, release, rest, extra)? {
                return Ok(Some(done));
            }
        }
        Ok(None)
    }

    /// The best places for `object`, as many as the width admits. They are found before any is tried: candidates take
    /// memory by the size of the scene, and a plan may be hundreds of steps deep.
    fn places(&mut self, object: ObjectIndex, rest: &[ObjectIndex]) -> Result<Vec<(Pose, Grasp)>, Stop> {
        let radius = self.table.layout.footprint(object).circumradius();
        let mut places: Vec<(Pose, Grasp)> = Vec::new();
        self.table.layout.lift(object, true);
        let passes = self.gaps.iter().map(|&preferred| (preferred, false)).chain([(0.0, true)]);
        for (preferred, spread) in passes {
            if places.len() >= self.width {
                break;
            }
            let spec = self.spec(object, preferred);
            let mut candidates = if spread {
                Candidates::spread(&self.table.layout, spec)
            } else {
                Candidates::new(&self.table.layout, spec)
            };
            // Where one place fails, its neighbours usually fail too.
            let near =
                |places: &[(Pose, Grasp)], at: Pose| places.iter().any(|(other, _)| distance(other.at, at.at) < radius);
            while places.len() < self.width
                && let Some(place) = self.table.next_place(&mut candidates, object, rest, |at| near(&places, at))?
            {
                places.push(match self.task.objective {
                    Objective::FarFromTarget => place,
                    Objective::ShortMoves => self.table.pull_back(&candidates, object, rest, place)?,
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
        object: ObjectIndex,
        grasp: Grasp,
        to: Pose,
        release: Grasp,
        rest: &[ObjectIndex],
        extra: usize,
    ) -> Result<Option<Arrangement>, Stop> {
        let footprint = self.table.layout.footprint(object);
        let gap = self.table.layout.gap(object, &footprint.moved_to(to));
        let before = self.table.layout.put(object, to);
        self.relocations.push(Relocation { object, from: footprint.pose, to, grasp, release, gap });
        let done = self.step(rest, extra)?;
        if done.is_none() {
            self.relocations.pop();
            self.table.layout.take_back(object, before);
        }
        Ok(done)
    }

    fn spec(&self, object: ObjectIndex, preferred: f64) -> PlaceSpec {
        PlaceSpec {
            object,
            gap: self.task.scene.gripper().margin() + preferred,
            edge_gap: preferred,
            objective: self.task.objective,
        }
    }
}
