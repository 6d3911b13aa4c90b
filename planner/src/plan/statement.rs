//! Answer → Claim, for the checker.

use super::answer::{Answer, LowerBound, Unplanned, Verdict};
use super::claim::{Claim, ClaimedDeadlock, ClaimedGrasp, ClaimedRelocation, VerdictName};
use crate::geometry::Grasp;
use crate::placement::Relocation;
use crate::scene::{ObjectIndex, Scene};

impl From<Grasp> for ClaimedGrasp {
    fn from(grasp: Grasp) -> Self {
        Self { yaw: grasp.yaw, slack: Some(grasp.slack) }
    }
}

impl Claim {
    /// The claim that an answer makes.
    pub fn of(scene: &Scene, answer: &Answer) -> Self {
        let ids =
            |objects: &[ObjectIndex]| objects.iter().map(|&o| scene.object(o).id().to_owned()).collect::<Vec<_>>();
        let bounded = |bound: Option<&LowerBound>| Self {
            lower_bound: bound.map(|bound| bound.cost as u64),
            landmarks: bound.map(|bound| bound.landmarks.iter().map(|landmark| ids(landmark)).collect()),
            ..Self::default()
        };
        let unplanned = |verdict, unplanned: &Unplanned| Self {
            verdict: Some(verdict),
            relocations: Some(Vec::new()),
            needed: unplanned.needed.as_deref().map(ids),
            ..bounded(unplanned.bound.as_ref())
        };
        match &answer.verdict {
            Verdict::Graspable(grasp) => Self {
                verdict: Some(VerdictName::Graspable),
                relocations: Some(Vec::new()),
                target_grasp: Some((*grasp).into()),
                cost: Some(0),
                optimal: answer.optimal(),
                ..bounded(Some(&LowerBound::default()))
            },
            Verdict::Relocate(plan) => Self {
                verdict: Some(VerdictName::Relocate),
                relocations: Some(plan.relocations.iter().map(|step| ClaimedRelocation::of(scene, step)).collect()),
                target_grasp: Some(plan.target_grasp.into()),
                cost: Some(plan.cost() as u64),
                optimal: answer.optimal(),
                ..bounded(plan.bound.as_ref())
            },
            Verdict::Deadlock(deadlock) => Self {
                verdict: Some(VerdictName::Deadlock),
                relocations: Some(Vec::new()),
                deadlock: deadlock
                    .as_ref()
                    .map(|proof| ClaimedDeadlock { blocked: ids(&proof.blocked), core: ids(&proof.core) }),
                ..Self::default()
            },
            Verdict::NoSpace(rest) => unplanned(VerdictName::NoSpace, rest),
            Verdict::TimedOut(rest) => unplanned(VerdictName::TimedOut, rest),
        }
    }
}

impl ClaimedRelocation {
    fn of(scene: &Scene, step: &Relocation) -> Self {
        Self {
            object: scene.object(step.object).id().to_owned(),
            from: Some(step.from),
            to: step.to,
            grasp: step.grasp.into(),
            release: step.release.into(),
            gap: Some(step.gap),
        }
    }
}
