//! Replays the steps in order and checks every grasp, every release and every new place.

use crate::budget::{Interrupted, Ticker};
use crate::scene::{Goal, Grasps, ObjectIndex, Pose, Scene};
use crate::statement::{PickDrop, PickPlace, StatedPose, Statement, Step, Verdict};

use super::TOLERANCE;
use super::allowed::{Allowed, may_drop, only_drops};
use super::body::Body;
use super::drops::Drops;
use super::fault::{FaultCode, Faults, figure, point};
use super::finger::wrap;
use super::grasping::Grasping;
use super::grip::band_of;
use super::names::ObjectNames;
use super::near::{Places, Standing};
use super::place::Landing;
use super::poses::{MAX_YAW, apart, resolvable};
use super::terms::Terms;

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

impl<'a> Replay<'a> {
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
                let body = self.body(target);
                self.grasping(None, target).grasp(FaultCode::TargetBlocked, body, grasp)?;
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
            if liftable {
                let (code, why) = match resolvable(step.to) {
                    true => (FaultCode::MissingPart, "the new place needs a yaw"),
                    false => (FaultCode::NumberOutOfRange, "the new place is no place on a table"),
                };
                self.faults.of_step(code, at, &step.object, || why.to_owned());
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
        let (from, place) = (self.body(object), self.places.body(to));
        let held = self.grasping(Some(at), object).grasp(FaultCode::GraspBlocked, from, step.grasp)?;
        let (scene, places, standing) = (self.scene, self.places, &self.standing);
        let landing = Landing { scene, places, standing, step: at, object, to: place };
        let gap = step.gap.filter(|_| self.terms.exact());
        landing.check(gap, self.faults, &mut self.ticker)?;
        if let Some(askew) = self.set_down_askew(object, step, (from, place)) {
            let (scene, places, standing) = (self.scene, self.places, &self.standing);
            let landing = Landing { scene, places, standing, step: at, object, to: &askew };
            landing.check(None, self.faults, &mut self.ticker)?;
        }
        self.grasping(Some(at), object).release((held, step), (from, place))?;
        self.standing.put(object, to);
        Ok(())
    }

    /// Where the object comes to stand if the hand turns as planned and the object was turned a little beside the plan when it was
    /// picked; `None` if it was not, or if nobody sees how it is turned.
    fn set_down_askew(&self, object: ObjectIndex, step: &PickPlace, (from, to): (&Body, &Body)) -> Option<Body> {
        let stated = self.scene.object(object);
        let yaw = step.from?.yaw.filter(|_| matches!(stated.grasps(), Grasps::Listed(_)))?;
        let off = wrap(from.pose.yaw - yaw);
        let axis = step.release.at.unwrap_or(to.pose.at);
        let at = axis + nalgebra::Rotation2::new(off) * (to.pose.at - axis);
        let pose = Pose { at, yaw: to.pose.yaw + off };
        (off.abs() > TOLERANCE).then(|| Body::new(stated.footprint().shape(), pose))
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
        let body = self.body(object);
        self.grasping(Some(at), object).grasp(FaultCode::GraspBlocked, body, step.grasp)?;
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
            (
                FaultCode::TooWide,
                "can't be grasped: it is too wide for the hand, has no grasp, or is as low as the fingertips",
            )
        } else if self.standing.gone(object) {
            (FaultCode::AlreadyGone, "was taken away before")
        } else {
            return true;
        };
        self.faults.of_step(code, at, stated.id(), || why.to_owned());
        false
    }

    /// The object where it stands now.
    fn body(&self, object: ObjectIndex) -> &'a Body {
        self.places.body(self.standing.place(object))
    }

    fn grasping(&mut self, step: Option<usize>, object: ObjectIndex) -> Grasping<'_, 'a> {
        let Self { scene, places, standing, terms, faults, ticker, .. } = self;
        Grasping { scene, places, standing, terms, step, object, faults, ticker }
    }

    fn stands_as_stated(&mut self, at: usize, object: ObjectIndex, stated: StatedPose) {
        let real = self.body(object).pose;
        let mut wrong = |detail: String| {
            self.faults.of_step(FaultCode::WrongFrom, at, self.scene.object(object).id(), || detail);
        };
        // NaN agrees with nothing.
        let agrees = apart(real, stated) <= TOLERANCE + self.terms.position_tolerance;
        if !agrees {
            wrong(format!("stands at {}, not at {}", point(real.at), point(stated.at)));
        }
        let (Grasps::Listed(list), Some(yaw)) = (self.scene.object(object).grasps(), stated.yaw) else { return };
        // What is seen a little beside its place may be turned a little too: as far as its grasps forgive.
        let forgiven = list.iter().map(|grasp| band_of(grasp, self.scene.gripper())).fold(0.0, f64::max);
        let tolerance = if self.terms.position_tolerance == 0.0 { TOLERANCE } else { forgiven.max(TOLERANCE) };
        let agrees = yaw.abs() <= MAX_YAW && wrap(yaw - real.yaw).abs() <= tolerance;
        if !agrees {
            wrong(format!("stands at yaw {}, not at yaw {}", figure(real.yaw), figure(yaw)));
        }
    }
}
