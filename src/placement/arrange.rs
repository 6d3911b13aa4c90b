//! Orders and places for one set of objects to relocate.
//!
//! Depth-first over which object goes next and where, with a width that doubles each round: first the best place and the
//! first order only, later more of both. The effort is counted in tried places and in the grasps looked for, not in time, so
//! that the same question always ends at the same point.

use nalgebra::Point2;

use super::candidates::{Candidates, Wish};
use super::layout::Layout;
use super::{INSIDE, Objective, PREFERRED_GAP, Relocation};
use crate::budget::{Budget, Interrupted};
use crate::geometry::{Grasp, widest_grasp};
use crate::scene::{Disc, ObjectIndex, Scene, distance};

/// What to arrange.
#[derive(Debug, Clone, Copy)]
pub struct Task<'a> {
    /// The scene at the start.
    pub scene: &'a Scene,
    /// The objects to relocate, in an order in which each becomes graspable.
    pub set: &'a [ObjectIndex],
    /// How many relocations more than the set's there may be: of an object that only stands in the way of a place, or of
    /// one that was moved before.
    pub extra: usize,
    /// Which places are best.
    pub objective: Objective,
}

/// A physical plan.
#[derive(Debug, Clone, PartialEq)]
pub struct Arrangement {
    /// In order.
    pub relocations: Vec<Relocation>,
    /// How the target is grasped at the end.
    pub target_grasp: Grasp,
}

/// How much more may be tried, in places: about half a microsecond each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Effort {
    left: u32,
}

impl Effort {
    /// So many places.
    pub fn new(places: u32) -> Self {
        Self { left: places }
    }

    /// Places left.
    pub fn left(&self) -> u32 {
        self.left
    }

    /// Split off at most `places`.
    pub fn split(&mut self, places: u32) -> Self {
        let part = places.min(self.left);
        self.left -= part;
        Self { left: part }
    }

    /// Give back what is left of a part.
    pub fn join(&mut self, part: Self) {
        self.left += part.left;
    }
}

/// What looking for a free yaw costs, in tried places.
const GRASP_EFFORT: usize = 4;
/// Units of effort between two looks at the budget: some 30 µs.
const BEAT: usize = 64;

/// The widest round. Past that, variety is in the sets and in extra moves rather than in more places of the same kind.
const MAX_WIDTH: usize = 16;

/// An arrangement of the task, `None` if none was found among the candidates or within the effort.
///
/// # Errors
/// [`Interrupted`] when the budget ends.
pub fn arrange(task: &Task<'_>, effort: &mut Effort, budget: &Budget<'_>) -> Result<Option<Arrangement>, Interrupted> {
    let mut width = 1;
    loop {
        let mut arranger = Arranger {
            task,
            effort,
            budget,
            width,
            truncated: false,
            layout: Layout::new(task.scene),
            relocations: Vec::new(),
            unwatched: 0,
        };
        match arranger.step(task.set, task.extra) {
            Ok(Some(arrangement)) => return Ok(Some(arrangement)),
            Ok(None) if arranger.truncated && width < MAX_WIDTH => width *= 2,
            Ok(None) | Err(Stop::Spent) => return Ok(None),
            Err(Stop::Interrupted) => return Err(Interrupted),
        }
    }
}

enum Stop {
    Spent,
    Interrupted,
}

impl From<Interrupted> for Stop {
    fn from(Interrupted: Interrupted) -> Self {
        Self::Interrupted
    }
}

struct Arranger<'a, 'e> {
    task: &'a Task<'a>,
    effort: &'e mut Effort,
    budget: &'e Budget<'e>,
    /// How many objects, and how many places of each, are tried at each step.
    width: usize,
    /// True if the width left something untried.
    truncated: bool,
    layout: Layout<'a>,
    relocations: Vec<Relocation>,
    /// Effort since the last look at the budget.
    unwatched: usize,
}

impl Arranger<'_, '_> {
    /// Relocate one of the remaining objects, then the rest.
    fn step(&mut self, remaining: &[ObjectIndex], extra: usize) -> Result<Option<Arrangement>, Stop> {
        let target = self.task.scene.target();
        if remaining.is_empty() {
            let relocations = || self.relocations.clone();
            let done = self.layout.grasp(target);
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

    fn graspable(&mut self, remaining: &[ObjectIndex]) -> Result<Vec<(ObjectIndex, Grasp)>, Stop> {
        let mut graspable = Vec::new();
        for &object in remaining {
            graspable.extend(self.grasp(object)?.map(|grasp| (object, grasp)));
        }
        Ok(graspable)
    }

    fn grasp(&mut self, object: ObjectIndex) -> Result<Option<Grasp>, Stop> {
        self.spend(GRASP_EFFORT)?;
        Ok(self.layout.grasp(object))
    }

    /// Move some other object of whose absence `stuck` could make use.
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
            let Some(grasp) = self.grasp(object)? else { continue };
            if self.frees_a_place(object, stuck, remaining)?
                && let Some(done) = self.relocate(object, grasp, remaining, extra)?
            {
                return Ok(Some(done));
            }
        }
        Ok(None)
    }

    /// Would `stuck` find a place if `object` were gone?
    fn frees_a_place(
        &mut self,
        object: ObjectIndex,
        stuck: ObjectIndex,
        remaining: &[ObjectIndex],
    ) -> Result<bool, Stop> {
        let rest: Vec<ObjectIndex> = remaining.iter().copied().filter(|&other| other != stuck).collect();
        self.layout.lift(object, true);
        self.layout.lift(stuck, true);
        let mut candidates = Candidates::new(&self.layout, self.wish(stuck, 0.0));
        let found = loop {
            match candidates.next(&self.layout, self.budget) {
                Ok(Some(at)) => match self.is_place(&candidates, stuck, at, &rest) {
                    Ok(None) => {}
                    Ok(Some(_)) => break Ok(true),
                    Err(stop) => break Err(stop),
                },
                Ok(None) => break Ok(false),
                Err(interrupted) => break Err(interrupted.into()),
            }
        };
        self.layout.lift(stuck, false);
        self.layout.lift(object, false);
        found
    }

    /// Try places for `object`, best first, and go on with `rest` from each.
    fn relocate(
        &mut self,
        object: ObjectIndex,
        grasp: Grasp,
        rest: &[ObjectIndex],
        extra: usize,
    ) -> Result<Option<Arrangement>, Stop> {
        let disc = self.layout.disc(object);
        let mut taken: Vec<Point2<f64>> = Vec::new();
        self.layout.lift(object, true);
        for (preferred, spread) in [(PREFERRED_GAP, false), (0.0, false), (0.0, true)] {
            let wish = self.wish(object, preferred);
            let mut candidates =
                if spread { Candidates::spread(&self.layout, wish) } else { Candidates::new(&self.layout, wish) };
            while let Some(at) = candidates.next(&self.layout, self.budget)? {
                // A place next to one that led nowhere leads nowhere either.
                if taken.iter().any(|&other| distance(other, at) < disc.radius) {
                    continue;
                }
                let Some(release) = self.is_place(&candidates, object, at, rest)? else { continue };
                if taken.len() >= self.width {
                    self.truncated = true;
                    self.layout.lift(object, false);
                    return Ok(None);
                }
                taken.push(at);
                if let Some(done) = self.go_on(object, grasp, at, release, rest, extra)? {
                    return Ok(Some(done));
                }
                self.layout.lift(object, true);
            }
        }
        self.layout.lift(object, false);
        Ok(None)
    }

    fn go_on(
        &mut self,
        object: ObjectIndex,
        grasp: Grasp,
        to: Point2<f64>,
        release: Grasp,
        rest: &[ObjectIndex],
        extra: usize,
    ) -> Result<Option<Arrangement>, Stop> {
        let disc = self.layout.disc(object);
        let gap = self.layout.gap(object, &disc.at(to));
        self.layout.lift(object, false);
        let before = self.layout.put(object, to);
        self.relocations.push(Relocation { object, from: disc.centre, to, grasp, release, gap });
        let done = self.step(rest, extra)?;
        if done.is_none() {
            self.relocations.pop();
            self.layout.take_back(object, before);
        }
        Ok(done)
    }

    fn wish(&self, object: ObjectIndex, preferred: f64) -> Wish {
        Wish {
            object,
            gap: self.task.scene.gripper().margin() + preferred,
            edge_gap: preferred,
            objective: self.task.objective,
        }
    }

    fn spend(&mut self, effort: usize) -> Result<(), Stop> {
        self.effort.left =
            u32::try_from(effort).ok().and_then(|effort| self.effort.left.checked_sub(effort)).ok_or(Stop::Spent)?;
        self.unwatched += effort;
        if self.unwatched >= BEAT {
            self.unwatched = 0;
            self.budget.check()?;
        }
        Ok(())
    }

    /// How the lifted object can be released there, if it fits and every grasp still to come stays possible.
    fn is_place(
        &mut self,
        candidates: &Candidates,
        object: ObjectIndex,
        at: Point2<f64>,
        rest: &[ObjectIndex],
    ) -> Result<Option<Grasp>, Stop> {
        self.spend(1 + self.task.scene.table().keep_out().len() / BEAT)?;
        if !candidates.fits(&self.layout, at) {
            return Ok(None);
        }
        let disc = self.layout.disc(object).at(at);
        let gripper = self.task.scene.gripper();
        if widest_grasp(gripper, &self.layout.blocked(object, &disc, INSIDE)).is_none() {
            return Ok(None);
        }
        let release = widest_grasp(gripper, &self.layout.blocked(object, &disc, 0.0));
        self.spend(GRASP_EFFORT)?;
        Ok(if release.is_some() && self.leaves_the_rest_free(object, &disc, rest)? { release } else { None })
    }

    /// With the object there, can the rest still be lifted one after the other, and the target grasped?
    fn leaves_the_rest_free(&mut self, object: ObjectIndex, disc: &Disc, rest: &[ObjectIndex]) -> Result<bool, Stop> {
        let target = self.task.scene.target();
        let gripper = self.task.scene.gripper();
        let hinders = |layout: &Layout<'_>, other: ObjectIndex| {
            let grasped = layout.disc(other);
            let reach = gripper.corner_distance(grasped.radius) + gripper.margin() + disc.radius;
            distance(grasped.centre, disc.centre) < reach
        };
        if !rest.iter().chain([&target]).any(|&other| hinders(&self.layout, other)) {
            return Ok(true);
        }
        self.layout.lift(object, false);
        let before = self.layout.put(object, disc.centre);
        let free = self.rest_can_be_lifted(rest);
        self.layout.take_back(object, before);
        self.layout.lift(object, true);
        free
    }

    fn rest_can_be_lifted(&mut self, rest: &[ObjectIndex]) -> Result<bool, Stop> {
        let mut lifted = Vec::new();
        let free = self.lift_all(rest, &mut lifted);
        lifted.into_iter().for_each(|object| self.layout.lift(object, false));
        free
    }

    /// Lift whatever can be lifted. True if that is all of them, and the target can be grasped then.
    fn lift_all(&mut self, rest: &[ObjectIndex], lifted: &mut Vec<ObjectIndex>) -> Result<bool, Stop> {
        let mut standing = rest.to_vec();
        while !standing.is_empty() {
            let mut stuck = Vec::new();
            for &object in &standing {
                if self.grasp(object)?.is_some() {
                    self.layout.lift(object, true);
                    lifted.push(object);
                } else {
                    stuck.push(object);
                }
            }
            if stuck.len() == standing.len() {
                return Ok(false);
            }
            standing = stuck;
        }
        Ok(self.grasp(self.task.scene.target())?.is_some())
    }
}
