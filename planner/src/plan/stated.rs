//! States what the planner found: from indices to ids.

use core::f64::consts::{PI, TAU};

use crate::cost::Cost;
use crate::geometry::Grasp;
use crate::knowledge::Locks;
use crate::placement::{Arrangement, Move, Relocation, Removal};
use crate::scene::{Goal, ObjectIndex, Pose, Scene};
use crate::search::LeastSet;
use crate::statement::{Deadlock, PickDrop, PickPlace, StatedGrasp, StatedPose, Statement, Step, Verdict};

impl Statement {
    /// The target can be grasped as the table stands: so every bound is met.
    pub(crate) fn graspable(grasp: Grasp) -> Self {
        Self {
            verdict: Some(Verdict::Graspable),
            target_grasp: Some(grasp.into()),
            cost: Some(Cost::ZERO),
            optimal: Some(true),
            ..Self::timed_out()
        }
    }

    /// A plan without a bound.
    pub(crate) fn relocate(scene: &Scene, plan: &Arrangement) -> Self {
        let steps: Vec<Step> = plan.moves.iter().map(|step| self::step(scene, step)).collect();
        let stated = Self {
            verdict: Some(Verdict::Relocate),
            cost: Some(steps.iter().map(Step::cost).sum()),
            relocations: Some(steps),
            target_grasp: plan.target_grasp.map(|(_, grasp)| grasp.into()),
            ..Self::default()
        };
        match plan.target_grasp {
            Some((target, _)) => stated.of(scene, target),
            None => stated,
        }
    }

    /// The same with the object that is grasped in the end, where the goal leaves the choice.
    #[must_use]
    pub(crate) fn of(self, scene: &Scene, target: ObjectIndex) -> Self {
        let chosen = matches!(scene.goal(), Goal::AnyOf(_)).then(|| scene.object(target).id().to_owned());
        Self { target: chosen, ..self }
    }

    /// A deadlock with its proof.
    pub(crate) fn deadlock(scene: &Scene, Locks { blocked, core }: &Locks) -> Self {
        Self { deadlock: Some(locked(scene, blocked, core)), ..Self::unproven_deadlock() }
    }

    /// A deadlock that nothing proves.
    pub(crate) fn unproven_deadlock() -> Self {
        Self { verdict: Some(Verdict::Deadlock), relocations: Some(Vec::new()), ..Self::default() }
    }

    /// No places for the objects that have to move, in this order; without a bound.
    pub(crate) fn no_space(scene: &Scene, needed: &[ObjectIndex]) -> Self {
        Self { verdict: Some(Verdict::NoSpace), ..Self::cut_off(scene, needed) }
    }

    /// Out of time with a derivation in hand, and without a bound.
    pub(crate) fn cut_off(scene: &Scene, needed: &[ObjectIndex]) -> Self {
        Self { lower_bound: None, landmarks: None, needed: Some(ids(scene, needed)), ..Self::timed_out() }
    }

    /// The same with the part of the search's bound that its landmarks prove.
    #[must_use]
    pub(crate) fn bounded(self, scene: &Scene, least: &LeastSet) -> Self {
        let landmarks = least.landmarks.iter().map(|landmark| ids(scene, landmark)).collect();
        // Only `true` is stated: a search that was cut off may have landmarks that prove more than it could compute.
        let optimal = self.cost.is_some_and(|cost| cost == least.proven).then_some(true);
        Self { lower_bound: Some(least.proven), landmarks: Some(landmarks), optimal, ..self }
    }
}

impl From<Grasp> for StatedGrasp {
    fn from(grasp: Grasp) -> Self {
        Self { at: Some(grasp.axis), yaw: grasp.yaw, slack: Some(grasp.slack) }
    }
}

/// A step of an arrangement.
pub(super) fn step(scene: &Scene, step: &Move) -> Step {
    match step {
        Move::Place(relocation) => Step::PickPlace(pick_place(scene, relocation)),
        Move::Drop(removal) => Step::PickDrop(pick_drop(scene, removal)),
    }
}

/// The locks by ids.
pub(super) fn locked(scene: &Scene, blocked: &[ObjectIndex], core: &[ObjectIndex]) -> Deadlock {
    Deadlock { blocked: ids(scene, blocked), core: ids(scene, core) }
}

fn pick_drop(scene: &Scene, step: &Removal) -> PickDrop {
    PickDrop {
        object: scene.object(step.object).id().to_owned(),
        from: Some(pose(scene, step.object, step.from)),
        grasp: step.grasp.into(),
        drop_off: scene.drop_offs()[step.drop_off].id().to_owned(),
    }
}

fn pick_place(scene: &Scene, step: &Relocation) -> PickPlace {
    PickPlace {
        object: scene.object(step.object).id().to_owned(),
        from: Some(pose(scene, step.object, step.from)),
        to: pose(scene, step.object, step.to),
        grasp: step.grasp.into(),
        release: step.release.into(),
        turn: turns(scene, step.object).then(|| turn(step.from, step.to)),
        gap: Some(step.gap),
    }
}

/// True unless the object may be grasped at every yaw: then nobody knows how far it turns, and nobody sees it.
fn turns(scene: &Scene, object: ObjectIndex) -> bool {
    scene.object(object).grasps().listed().is_some()
}

fn pose(scene: &Scene, object: ObjectIndex, pose: Pose) -> StatedPose {
    StatedPose { at: pose.at, yaw: turns(scene, object).then_some(pose.yaw) }
}

/// How far a frame turns, rad, in (−π, π].
fn turn(from: Pose, to: Pose) -> f64 {
    let turn = to.yaw - from.yaw;
    let turn = turn - TAU * (turn / TAU).round();
    if turn <= -PI { PI } else { turn }
}

/// The ids of objects, in the same order.
pub(crate) fn ids(scene: &Scene, objects: &[ObjectIndex]) -> Vec<String> {
    objects.iter().map(|&object| scene.object(object).id().to_owned()).collect()
}
