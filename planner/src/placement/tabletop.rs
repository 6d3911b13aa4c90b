//! A layout with a meter: each test of a grasp or a place costs effort.

use super::INSIDE;
use super::candidates::Candidates;
use super::effort::{BEAT, EffortMeter};
use super::layout::Layout;
use crate::budget::Stop;
use crate::geometry::Hold;
use crate::scene::{Footprint, ObjectIndex, Pose, distance};

/// The effort of one search for a free yaw, in tried places.
const GRASP_EFFORT: usize = 4;

/// Bisection steps of [`Tabletop::pull_back`]: to under 1 % of the move.
const HALVINGS: usize = 7;

/// A layout with the effort left for it.
pub(super) struct Tabletop<'a, 'e> {
    pub(super) layout: Layout<'a>,
    meter: EffortMeter<'e>,
}

impl<'a, 'e> Tabletop<'a, 'e> {
    pub(super) fn new(layout: Layout<'a>, meter: EffortMeter<'e>) -> Self {
        Self { layout, meter }
    }

    /// Spends effort on what is no test of a grasp or a place.
    pub(super) fn spend(&mut self, effort: usize) -> Result<(), Stop> {
        self.meter.spend(effort)
    }

    /// The free ways to hold an object where it stands.
    pub(super) fn hold(&mut self, object: ObjectIndex) -> Result<Option<Hold>, Stop> {
        self.meter.spend(GRASP_EFFORT)?;
        Ok(self.layout.hold(object))
    }

    /// The next best place, with the ways to release the object there: the lifted object fits there and can be released, and all later grasps
    /// stay possible.
    pub(super) fn next_place(
        &mut self,
        candidates: &mut Candidates,
        (object, hold): (ObjectIndex, Hold),
        rest: &[ObjectIndex],
        skip: impl Fn(Pose) -> bool,
    ) -> Result<Option<(Pose, Hold)>, Stop> {
        while let Some(at) = candidates.next(&self.layout, &mut self.meter)? {
            if !skip(at)
                && let Some(release) = self.release(candidates, (object, hold), at, rest)?
            {
                return Ok(Some((at, release)));
            }
        }
        Ok(None)
    }

    /// Moves `place` back towards the old place of the lifted object, by bisection between a free and a blocked point.
    pub(super) fn pull_back(
        &mut self,
        candidates: &Candidates,
        (object, hold): (ObjectIndex, Hold),
        rest: &[ObjectIndex],
        place: (Pose, Hold),
    ) -> Result<(Pose, Hold), Stop> {
        let (mut free, mut blocked) = (place, self.layout.footprint(object).at());
        for _ in 0..HALVINGS {
            let middle = Pose { at: nalgebra::center(&free.0.at, &blocked), ..free.0 };
            match self.release(candidates, (object, hold), middle, rest)? {
                Some(release) => free = (middle, release),
                None => blocked = middle.at,
            }
        }
        Ok(free)
    }

    /// The ways to release the lifted object at `at`, picked in one of the ways of `hold`, if it fits there and all later grasps stay
    /// possible. A listed grasp is kept, so it must be free at both places.
    fn release(
        &mut self,
        candidates: &Candidates,
        (object, hold): (ObjectIndex, Hold),
        at: Pose,
        rest: &[ObjectIndex],
    ) -> Result<Option<Hold>, Stop> {
        self.meter.spend(1 + self.layout.scene().table().keep_out().len() / BEAT)?;
        if !candidates.fits(&self.layout, at) {
            return Ok(None);
        }
        let place = self.layout.footprint(object).moved_to(at);
        let Some(clear) = self.layout.hold_at(object, &place, INSIDE).and_then(|clear| clear.and(hold)) else {
            return Ok(None);
        };
        let release = match clear {
            Hold::AtYaw(_) => self.layout.hold_at(object, &place, 0.0),
            Hold::Listed(_) => Some(clear),
        };
        self.meter.spend(GRASP_EFFORT)?;
        Ok(if release.is_some() && self.leaves_the_rest_free(object, &place, rest)? { release } else { None })
    }

    /// True if, with the object at `place`, the rest can still be lifted one after the other and the target, if there is one,
    /// grasped.
    fn leaves_the_rest_free(
        &mut self,
        object: ObjectIndex,
        place: &Footprint,
        rest: &[ObjectIndex],
    ) -> Result<bool, Stop> {
        let scene = self.layout.scene();
        let target = scene.target();
        let hinders = |layout: &Layout<'_>, other: ObjectIndex| {
            let grasped = layout.footprint(other);
            distance(grasped.at(), place.at()) < layout.reach(other) + place.circumradius()
        };
        if !rest.iter().chain(&target).any(|&other| hinders(&self.layout, other)) {
            return Ok(true);
        }
        self.layout.lift(object, false);
        let before = self.layout.put(object, place.pose());
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

    /// Lifts the objects of `rest` in any order that works. True if all can be lifted and the target can be grasped
    /// then.
    fn lift_all(&mut self, rest: &[ObjectIndex], lifted: &mut Vec<ObjectIndex>) -> Result<bool, Stop> {
        let mut standing = rest.to_vec();
        while !standing.is_empty() {
            let mut stuck = Vec::new();
            for &object in &standing {
                if self.hold(object)?.is_some() {
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
        match self.layout.scene().target() {
            Some(target) => Ok(self.hold(target)?.is_some()),
            None => Ok(true),
        }
    }
}
