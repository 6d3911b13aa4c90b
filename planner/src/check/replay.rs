//! Replays the steps in order and checks every grasp, every release and every new place.

use core::f64::consts::PI;

use nalgebra::Point2;

use crate::budget::{Interrupted, Ticker};
use crate::scene::{Footprint, ObjectIndex, Pose, Scene};
use crate::statement::{PickPlace, StatedGrasp, Statement, Step, Verdict};

use super::TOLERANCE;
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
    standing: Standing,
    terms: &'a Terms,
    faults: &'a mut Faults,
    first_failing_step: Option<usize>,
    ticker: Ticker<'a>,
}

/// How far a replay came.
pub(super) struct Replayed {
    /// The first step with a fault; the number of steps if it is the final grasp.
    pub(super) first_failing_step: Option<usize>,
    /// True if time ran out before the end.
    pub(super) interrupted: bool,
}

/// Replay the stated steps, then grasp the target. A step that can't be carried out (unknown object, no such place) is
/// a fault and is skipped. Any other faulty step is carried out, so that one fault does not cause more.
pub(super) fn replay<'a>(
    scene: &'a Scene,
    places: &'a Places,
    names: &'a ObjectNames<'a>,
    statement: &Statement,
    terms: &'a Terms,
    faults: &'a mut Faults,
    ticker: Ticker<'a>,
) -> Replayed {
    let standing = Standing::default();
    let mut replay = Replay { scene, places, names, standing, terms, faults, first_failing_step: None, ticker };
    let interrupted = replay.run(statement).is_err();
    if interrupted {
        replay.faults.of_answer(FaultCode::ReplayUnconfirmed, || "time ran out before all steps were replayed".into());
    }
    Replayed { first_failing_step: replay.first_failing_step, interrupted }
}

/// True for an answer with a final grasp of the target.
pub(super) fn ends_in_grasp(statement: &Statement) -> bool {
    match statement.verdict {
        Some(Verdict::Graspable | Verdict::Relocate) => true,
        Some(_) => false,
        None => statement.relocations.is_some() && statement.deadlock.is_none(),
    }
}

impl Replay<'_> {
    fn run(&mut self, statement: &Statement) -> Result<(), Interrupted> {
        for (at, step) in statement.steps().iter().enumerate() {
            self.noting(at, |replay| match step {
                Step::PickPlace(step) => replay.pick_place(at, step),
            })?;
        }
        self.noting(statement.steps().len(), |replay| replay.target_grasp(statement))
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

    fn target_grasp(&mut self, statement: &Statement) -> Result<(), Interrupted> {
        if let Some(grasp) = statement.target_grasp {
            let target = self.scene.target();
            return self.grasp(FaultCode::TargetBlocked, None, target, self.footprint(target), grasp);
        }
        if !self.terms.partial && ends_in_grasp(statement) {
            self.faults.of_answer(FaultCode::MissingPart, || "a plan needs its target_grasp".into());
        }
        Ok(())
    }

    fn pick_place(&mut self, at: usize, step: &PickPlace) -> Result<(), Interrupted> {
        self.ticker.step(1)?;
        let Some(object) = self.names.known(&step.object, Some(at), self.faults) else { return Ok(()) };
        let Some(to) = self.places.of_step(at) else {
            self.refuse(at, object, step.to.at);
            return Ok(());
        };
        if let Some(from) = step.from {
            self.stands_as_stated(at, object, from);
        }
        self.grasp(FaultCode::GraspBlocked, Some(at), object, self.footprint(object), step.grasp)?;
        let place = self.places.footprint(to);
        let (scene, places, standing) = (self.scene, self.places, &self.standing);
        let landing = Landing { scene, places, standing, step: at, object, to: place };
        let gap = step.gap.filter(|_| self.terms.exact());
        landing.check(gap, self.faults, &mut self.ticker)?;
        self.grasp(FaultCode::ReleaseBlocked, Some(at), object, place, step.release)?;
        self.standing.put(object, to);
        Ok(())
    }

    /// Reports why a step has no place.
    fn refuse(&mut self, at: usize, object: ObjectIndex, to: Point2<f64>) {
        let stated = self.scene.object(object);
        let mut refuse = |code, why: &str| self.faults.of_step(code, at, stated.id(), || why.to_owned());
        if object == self.scene.target() {
            refuse(FaultCode::TargetMoved, "the target is not relocated");
        } else if stated.fixed() {
            refuse(FaultCode::FixedObjectMoved, "a fixed object can't be moved");
        }
        if !resolvable(to) {
            refuse(FaultCode::NumberOutOfRange, "the new place is no place on a table");
        }
    }

    fn footprint(&self, object: ObjectIndex) -> Footprint {
        self.places.footprint(self.standing.place(object))
    }

    fn stands_as_stated(&mut self, at: usize, object: ObjectIndex, stated: Pose) {
        let real = self.footprint(object).pose;
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
        grasped: Footprint,
        grasp: StatedGrasp,
    ) -> Result<(), Interrupted> {
        let Some(band) = self.band(step, object, grasp) else { return Ok(()) };
        let gripper = self.scene.gripper();
        let finger = Finger::new(gripper, &grasped);
        let (mut near, mut visited) = (Vec::new(), 0);
        self.places.within(grasped.pose.at, finger.corner_distance() + gripper.margin(), |place| {
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
            let depth = finger.depth(gripper, &grasped, &self.footprint(owner), (grasp.yaw, band));
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
