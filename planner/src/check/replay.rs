//! Replays the steps in order and checks every grasp, every release and every new place.

use core::f64::consts::PI;

use nalgebra::Point2;

use crate::budget::{Interrupted, Ticker};
use crate::scene::{Footprint, Goal, ObjectIndex, Scene};
use crate::statement::{PickDrop, PickPlace, StatedGrasp, StatedPose, Statement, Step, Verdict};

use super::TOLERANCE;
use super::allowed::{Allowed, may_drop, only_drops};
use super::drops::Drops;
use super::fault::{FaultCode, Faults, figure};
use super::finger::Finger;
use super::measure::apart;
use super::names::ObjectNames;
use super::near::{Places, Standing, resolvable};
use super::place::Landing;
use super::terms::Terms;

/// The largest yaw whose digits still resolve 1e-9 rad after reduction modulo whole turns.
const MAX_YAW: f64 = 1e6;

struct Replay<'a> {
    scene: &'a Scene,
    places: &'a Places,
    names: &'a ObjectNames<'a>,
    allowed: &'a Allowed<'a>,
    standing: Standing,
    drops: Drops,
    terms: &'a Terms,
    faults: &'a mut Faults,
    first_failing_step: Option<usize>,
    ticker: Ticker<'a>,
}

/// How far a replay came.
pub(super) struct Replayed {
    /// The first step with a fault; the number of steps if it is the final grasp, or what should have gone.
    pub(super) first_failing_step: Option<usize>,
    /// The number of steps that were replayed.
    pub(super) steps: usize,
    /// True if time ran out before the end.
    pub(super) interrupted: bool,
    /// What the steps leave on the table.
    pub(super) standing: Standing,
    /// What they took to the drop-offs.
    pub(super) drops: Drops,
}

/// Replay the stated steps, then reach the goal. A step that can't be carried out (unknown object, no such place) is
/// a fault and is skipped. Any other faulty step is carried out, so that one fault does not cause more.
pub(super) fn replay<'a>(
    scene: &'a Scene,
    places: &'a Places,
    (names, allowed): (&'a ObjectNames<'a>, &'a Allowed<'a>),
    statement: &Statement,
    terms: &'a Terms,
    faults: &'a mut Faults,
    ticker: Ticker<'a>,
) -> Replayed {
    let (standing, drops) = (Standing::default(), Drops::new(scene));
    let first_failing_step = None;
    let mut replay =
        Replay { scene, places, names, allowed, standing, drops, terms, faults, first_failing_step, ticker };
    let mut steps = 0;
    let interrupted = replay.run(statement, &mut steps).is_err();
    if interrupted {
        replay.faults.of_answer(FaultCode::ReplayUnconfirmed, || "time ran out before all steps were replayed".into());
    }
    let Replay { first_failing_step, standing, drops, .. } = replay;
    Replayed { first_failing_step, steps, interrupted, standing, drops }
}

/// True for an answer that says that its steps reach the goal, a clearing apart.
fn reaches_goal(statement: &Statement) -> bool {
    match statement.verdict {
        Some(Verdict::Graspable | Verdict::Relocate) => true,
        Some(_) => false,
        None => statement.relocations.is_some() && statement.deadlock.is_none(),
    }
}

impl Replay<'_> {
    fn run(&mut self, statement: &Statement, done: &mut usize) -> Result<(), Interrupted> {
        for (at, step) in statement.steps().iter().enumerate() {
            self.noting(at, |replay| match step {
                Step::PickPlace(step) => replay.pick_place(at, step),
                Step::PickDrop(step) => replay.pick_drop(at, step),
            })?;
            *done = at + 1;
        }
        self.noting(statement.steps().len(), |replay| replay.goal(statement))
    }

    /// Replays the step at this position. Notes it if it is the first with a fault.
    fn noting(
        &mut self,
        at: usize,
        step: impl FnOnce(&mut Self) -> Result<(), Interrupted>,
    ) -> Result<(), Interrupted> {
        let before = self.faults.count();
        let replayed = step(self);
        if self.faults.count() > before {
            self.first_failing_step.get_or_insert(at);
        }
        replayed
    }

    /// What is wanted after the steps: the final grasp, or that objects are gone.
    fn goal(&mut self, statement: &Statement) -> Result<(), Interrupted> {
        let ends = !self.terms.partial && reaches_goal(statement);
        match self.scene.goal() {
            Goal::Target(target) => self.target_grasp(Some(*target), statement, ends),
            Goal::AnyOf(_) => {
                let known = statement.target.as_deref().and_then(|id| self.names.known(id, None, self.faults));
                let chosen = known.filter(|object| self.scene.goal().is_candidate(*object));
                if let Some(other) = known.filter(|_| chosen.is_none()) {
                    let detail = || "is no candidate of the goal".to_owned();
                    self.faults.of_object(FaultCode::WrongTarget, self.scene.object(other).id(), detail);
                }
                self.target_grasp(chosen, statement, ends)
            }
            Goal::AllOf(wanted) => {
                for &object in wanted.iter().filter(|object| ends && !self.standing.gone(**object)) {
                    let detail = || "is to be taken away and still stands on the table".to_owned();
                    self.faults.of_object(FaultCode::WantedLeft, self.scene.object(object).id(), detail);
                }
                Ok(())
            }
            Goal::Clear => Ok(()),
        }
    }

    fn target_grasp(
        &mut self,
        target: Option<ObjectIndex>,
        statement: &Statement,
        ends: bool,
    ) -> Result<(), Interrupted> {
        match (target, statement.target_grasp) {
            (Some(target), Some(grasp)) => {
                self.grasp(FaultCode::TargetBlocked, None, target, &self.footprint(target).clone(), grasp)?;
            }
            (None, Some(_)) if statement.target.is_none() => {
                self.faults.of_answer(FaultCode::MissingPart, || "a target_grasp needs its target".into());
            }
            (_, None) if ends => {
                self.faults.of_answer(FaultCode::MissingPart, || "a plan needs its target_grasp".into());
            }
            _ => {}
        }
        Ok(())
    }

    fn pick_place(&mut self, at: usize, step: &PickPlace) -> Result<(), Interrupted> {
        self.ticker.step(1)?;
        let Some(object) = self.names.known(&step.object, Some(at), self.faults) else { return Ok(()) };
        let liftable = self.liftable(at, object);
        let Some(to) = self.places.of_step(at) else {
            if !resolvable(step.to.at) {
                let detail = || "the new place is no place on a table".to_owned();
                self.faults.of_step(FaultCode::NumberOutOfRange, at, &step.object, detail);
            }
            return Ok(());
        };
        if !liftable {
            return Ok(());
        }
        if only_drops(self.scene) {
            self.misplaced(at, object, "is put aside on the table, and may only be taken away");
        }
        if let Some(from) = step.from {
            self.stands_as_stated(at, object, from);
        }
        self.grasp(FaultCode::GraspBlocked, Some(at), object, &self.footprint(object).clone(), step.grasp)?;
        let place = self.places.footprint(to).clone();
        let (scene, places, standing) = (self.scene, self.places, &self.standing);
        let landing = Landing { scene, places, standing, step: at, object, to: &place };
        let gap = step.gap.filter(|_| self.terms.exact());
        landing.check(gap, self.faults, &mut self.ticker)?;
        self.grasp(FaultCode::ReleaseBlocked, Some(at), object, &place, step.release)?;
        self.standing.put(object, to);
        Ok(())
    }

    fn pick_drop(&mut self, at: usize, step: &PickDrop) -> Result<(), Interrupted> {
        self.ticker.step(1)?;
        let Some(object) = self.names.known(&step.object, Some(at), self.faults) else { return Ok(()) };
        if !self.liftable(at, object) {
            return Ok(());
        }
        if !may_drop(self.scene, object) {
            self.misplaced(at, object, "is taken away, and may only be put aside on the table");
        }
        if let Some(from) = step.from {
            self.stands_as_stated(at, object, from);
        }
        self.grasp(FaultCode::GraspBlocked, Some(at), object, &self.footprint(object).clone(), step.grasp)?;
        self.drops.take(self.scene, self.allowed, at, object, &step.drop_off, self.faults);
        self.standing.take_away(object);
        Ok(())
    }

    fn misplaced(&mut self, at: usize, object: ObjectIndex, why: &str) {
        self.faults.of_step(FaultCode::WrongDestination, at, self.scene.object(object).id(), || why.to_owned());
    }

    /// True if the object can be lifted off the table at all; reports why it can't.
    fn liftable(&mut self, at: usize, object: ObjectIndex) -> bool {
        let stated = self.scene.object(object);
        let (code, why) = if self.scene.goal().is_candidate(object) {
            (FaultCode::TargetMoved, "the target is not relocated")
        } else if stated.fixed() {
            (FaultCode::FixedObjectMoved, "a fixed object can't be moved")
        } else if !self.allowed.graspable(object) {
            (FaultCode::TooWide, "is wider than the greatest opening")
        } else if self.standing.gone(object) {
            (FaultCode::AlreadyGone, "was taken away before")
        } else {
            return true;
        };
        self.faults.of_step(code, at, stated.id(), || why.to_owned());
        false
    }

    fn footprint(&self, object: ObjectIndex) -> &Footprint {
        self.places.footprint(self.standing.place(object))
    }

    fn stands_as_stated(&mut self, at: usize, object: ObjectIndex, stated: StatedPose) {
        let real = self.footprint(object).pose();
        // NaN agrees with nothing.
        let agrees = apart(real, stated) <= TOLERANCE + self.terms.position_tolerance;
        if !agrees {
            let detail = || format!("stands at {}, not at {}", point(real.at), point(stated.at));
            self.faults.of_step(FaultCode::WrongFrom, at, self.scene.object(object).id(), detail);
        }
    }

    /// The band of yaws (rad, on each side) that must be free, if the figures are valid.
    fn band(&mut self, step: Option<usize>, object: ObjectIndex, grasp: StatedGrasp) -> Option<f64> {
        let (id, gripper) = (self.scene.object(object).id(), self.scene.gripper());
        let stated = grasp.slack.filter(|_| self.terms.exact());
        let slack = stated.unwrap_or(0.0);
        if !(grasp.yaw.abs() <= MAX_YAW && slack.is_finite()) {
            let detail = || format!("yaw {:e} with slack {slack:e} can't be resolved", grasp.yaw);
            self.faults.add(FaultCode::NumberOutOfRange, step, Some(id), detail);
            return None;
        }
        let (least, most) = (gripper.yaw_tolerance(), PI / f64::from(gripper.fingers()));
        // Without obstacles the slack is π/k even if the tolerance is more.
        let in_range = (least.min(most) - TOLERANCE..=most + TOLERANCE).contains(&slack);
        if stated.is_some() && !in_range {
            let detail = || format!("slack {} is not between {least:.9} and {most:.9} rad", figure(slack));
            self.faults.add(FaultCode::WrongSlack, step, Some(id), detail);
        }
        Some(slack.clamp(least, most.max(least)))
    }

    /// The fingers round `grasped` meet no other object at any yaw of the band. Names the obstacle that they go deepest into.
    fn grasp(
        &mut self,
        code: FaultCode,
        step: Option<usize>,
        object: ObjectIndex,
        grasped: &Footprint,
        grasp: StatedGrasp,
    ) -> Result<(), Interrupted> {
        let Some(band) = self.band(step, object, grasp) else { return Ok(()) };
        let gripper = self.scene.gripper();
        let finger = Finger::new(gripper, grasped);
        let (mut near, mut visited) = (Vec::new(), 0);
        self.places.within(grasped.pose().at, finger.corner_distance() + gripper.margin(), |place| {
            visited += 1;
            let owner = self.places.owner(place);
            if owner != object && self.standing.place(owner) == place {
                near.push(owner);
            }
        });
        self.ticker.step(visited / 16)?;
        let mut worst: Option<(f64, ObjectIndex)> = None;
        for owner in near {
            self.ticker.step(1)?;
            let depth = finger.depth(gripper, grasped, self.footprint(owner), (grasp.yaw, band));
            if depth > TOLERANCE && worst.is_none_or(|(deepest, _)| depth > deepest) {
                worst = Some((depth, owner));
            }
        }
        if let Some((depth, by)) = worst {
            let (id, by) = (self.scene.object(object).id(), self.scene.object(by).id());
            let detail = || {
                format!("a finger comes {depth:.9} m too near to '{by}' at yaw {} ± {band:.9} rad", figure(grasp.yaw))
            };
            self.faults.add(code, step, Some(id), detail);
        }
        Ok(())
    }
}

fn point(at: Point2<f64>) -> String {
    format!("({}, {})", figure(at.x), figure(at.y))
}
