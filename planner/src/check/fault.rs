//! The faults of a stated answer, as data.

use nalgebra::Point2;

use crate::cost::Cost;
use crate::scene::ObjectIndex;

/// One fault of a stated answer.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    /// The kind of fault.
    pub code: FaultCode,
    /// The position of the relocation, from 0; `None` for the answer as a whole.
    pub step: Option<usize>,
    /// The id of the object concerned.
    pub object: Option<String>,
    /// One sentence with the figures.
    pub detail: String,
}

/// A figure for humans: to the checker's precision, or unrounded if that would hide it.
pub(super) fn figure(value: f64) -> String {
    if value.abs() < 1e6 { format!("{value:.9}") } else { format!("{value:e}") }
}

/// A point for humans.
pub(super) fn point(at: Point2<f64>) -> String {
    format!("({}, {})", figure(at.x), figure(at.y))
}

/// The kinds of fault. Names that end in `Unconfirmed` mean that time ran out, not that the answer is wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FaultCode {
    /// An id names no object of the scene.
    UnknownObject,
    /// A step moves a fixed object.
    FixedObjectMoved,
    /// A step moves the target.
    TargetMoved,
    /// A yaw, slack or coordinate is not finite, or too large to be resolved.
    NumberOutOfRange,
    /// The object is not at the place in the step.
    WrongFrom,
    /// The new place sticks out over the table's edge.
    OffTable,
    /// The new place overlaps a keep-out.
    InKeepOut,
    /// The new place is too near to another object.
    TooClose,
    /// The stated gap is not the real one.
    WrongGap,
    /// A finger or the palm meets an obstacle at the old place.
    GraspBlocked,
    /// A finger or the palm meets an obstacle at the new place.
    ReleaseBlocked,
    /// A finger or the palm meets an obstacle at the target, after all steps.
    TargetBlocked,
    /// The stated slack is less than the yaw tolerance or more than π/k; of a listed grasp, it is not its band.
    WrongSlack,
    /// The object has no such grasp: none of its list is over this point at this yaw.
    NoSuchGrasp,
    /// The gripper's axis is not over the centre of a disc, or of a release not where the object is held.
    WrongAxis,
    /// The hand, or the stated turn, does not turn as the object does.
    WrongTurn,
    /// A part is absent that this verdict needs.
    MissingPart,
    /// A part is there that does not go with this verdict.
    UnexpectedPart,
    /// The stated cost is not that of the steps, or a plan without relocations is not called graspable.
    WrongCost,
    /// `optimal` contradicts cost and bound.
    WrongOptimal,
    /// The stated bound is above the cost of the plan that comes with it.
    BoundAboveCost,
    /// The landmarks prove less than the stated bound.
    BoundUnproven,
    /// Time ran out before the stated bound was proven or refuted.
    BoundUnconfirmed,
    /// A landmark is empty, or holds the target or a fixed object.
    BadLandmark,
    /// The target can be freed without moving any member of a landmark.
    LandmarkRefuted,
    /// A lock without the target.
    LockWithoutTarget,
    /// A member of a lock can be moved, or the target grasped, even with all other members in place.
    LockMemberFree,
    /// The core is not within the greatest lock.
    CoreOutsideBlocked,
    /// Time ran out before the lock was proven.
    LockUnconfirmed,
    /// The needed objects can't be lifted in this order, or don't free the target.
    WrongNeeded,
    /// Time ran out before the needed objects were all lifted.
    NeededUnconfirmed,
    /// Time ran out before all steps were replayed.
    ReplayUnconfirmed,
    /// The object of a step, or its grasp, is wider than the hand opens, or it has no grasp at all.
    TooWide,
    /// The object of a step was taken away before.
    AlreadyGone,
    /// A step puts aside what may only be taken away, or takes away what may only be put aside.
    WrongDestination,
    /// A drop-off's id names none of the scene.
    UnknownDropOff,
    /// The drop-off does not accept the object.
    NotAccepted,
    /// The drop-off holds as many objects as it takes.
    OverCapacity,
    /// An object that is to be taken away still stands on the table.
    WantedLeft,
    /// The object that is grasped in the end is no candidate of the goal.
    WrongTarget,
    /// The verdict does not go with the goal, or with what is left.
    WrongVerdict,
    /// `left` is not what the steps leave.
    WrongLeft,
    /// An order takes more away than the answer says.
    WrongProven,
    /// It could not be confirmed that no order takes more away.
    ProvenUnconfirmed,
}

impl FaultCode {
    /// True if it means that time ran out, not that the answer is wrong.
    pub fn means_late(self) -> bool {
        matches!(
            self,
            Self::BoundUnconfirmed
                | Self::LockUnconfirmed
                | Self::NeededUnconfirmed
                | Self::ReplayUnconfirmed
                | Self::ProvenUnconfirmed
        )
    }

    /// True if it can only be a bug of ours, whichever methods were asked for: a bound, a lock, or a part that our own code
    /// states. Steps of the paper's methods may have other faults.
    pub(crate) fn is_a_bug_of_ours(self) -> bool {
        matches!(
            self,
            Self::BoundUnproven
                | Self::BadLandmark
                | Self::LandmarkRefuted
                | Self::LockWithoutTarget
                | Self::LockMemberFree
                | Self::CoreOutsideBlocked
                | Self::UnknownObject
                | Self::MissingPart
                | Self::UnexpectedPart
                | Self::WrongCost
        )
    }

    /// The code in answers and logs.
    pub fn name(self) -> &'static str {
        match self {
            Self::UnknownObject => "unknown_object",
            Self::FixedObjectMoved => "fixed_object_moved",
            Self::TooWide => "too_wide",
            Self::AlreadyGone => "already_gone",
            Self::WrongDestination => "wrong_destination",
            Self::UnknownDropOff => "unknown_drop_off",
            Self::NotAccepted => "not_accepted",
            Self::OverCapacity => "over_capacity",
            Self::WantedLeft => "wanted_left",
            Self::WrongTarget => "wrong_target",
            Self::WrongVerdict => "wrong_verdict",
            Self::WrongLeft => "wrong_left",
            Self::WrongProven => "wrong_proven",
            Self::ProvenUnconfirmed => "proven_unconfirmed",
            Self::TargetMoved => "target_moved",
            Self::NumberOutOfRange => "number_out_of_range",
            Self::WrongFrom => "wrong_from",
            Self::OffTable => "off_table",
            Self::InKeepOut => "in_keep_out",
            Self::TooClose => "too_close",
            Self::WrongGap => "wrong_gap",
            Self::GraspBlocked => "grasp_blocked",
            Self::ReleaseBlocked => "release_blocked",
            Self::TargetBlocked => "target_blocked",
            Self::WrongSlack => "wrong_slack",
            Self::NoSuchGrasp => "no_such_grasp",
            Self::WrongAxis => "wrong_axis",
            Self::WrongTurn => "wrong_turn",
            Self::MissingPart => "missing_part",
            Self::UnexpectedPart => "unexpected_part",
            Self::WrongCost => "wrong_cost",
            Self::WrongOptimal => "wrong_optimal",
            Self::BoundAboveCost => "bound_above_cost",
            Self::BoundUnproven => "bound_unproven",
            Self::BoundUnconfirmed => "bound_unconfirmed",
            Self::BadLandmark => "bad_landmark",
            Self::LandmarkRefuted => "landmark_refuted",
            Self::LockWithoutTarget => "lock_without_target",
            Self::LockMemberFree => "lock_member_free",
            Self::CoreOutsideBlocked => "core_outside_blocked",
            Self::LockUnconfirmed => "lock_unconfirmed",
            Self::WrongNeeded => "wrong_needed",
            Self::NeededUnconfirmed => "needed_unconfirmed",
            Self::ReplayUnconfirmed => "replay_unconfirmed",
        }
    }
}

/// The checker's report.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Report {
    /// Empty if the answer holds. At most [`MAX_FAULTS`].
    pub faults: Vec<Fault>,
    /// The greatest bound that the landmarks prove, as far as time allowed.
    pub proven_bound: Cost,
    /// The stated landmarks found sound, none a superset of another: they alone prove `proven_bound`.
    pub sound_landmarks: Vec<Vec<ObjectIndex>>,
    /// The first step with a fault; the number of steps if it is the final grasp, or an object that should have gone.
    pub first_failing_step: Option<usize>,
    /// The number of steps that were replayed before time ran out; all of them where it did not.
    pub replayed: usize,
    /// True if it was shown that no order takes more objects away.
    pub clearing_proven: bool,
    /// True if the budget ended before everything was checked.
    pub interrupted: bool,
}

impl Report {
    /// True if a fault has this code.
    pub fn has(&self, code: FaultCode) -> bool {
        self.faults.iter().any(|fault| fault.code == code)
    }
}

/// The most faults of one answer.
pub const MAX_FAULTS: usize = 1000;

/// A list of faults that stops growing at [`MAX_FAULTS`]. Later faults are not even formatted.
#[derive(Debug, Default)]
pub(super) struct Faults {
    list: Vec<Fault>,
    /// Those that found no room in the list included.
    count: usize,
}

impl Faults {
    /// The number of faults so far.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// A fault of one relocation.
    pub(super) fn of_step(&mut self, code: FaultCode, step: usize, object: &str, detail: impl FnOnce() -> String) {
        self.add(code, Some(step), Some(object), detail);
    }

    /// A fault that concerns one object but no single relocation.
    pub(super) fn of_object(&mut self, code: FaultCode, object: &str, detail: impl FnOnce() -> String) {
        self.add(code, None, Some(object), detail);
    }

    /// A fault of the answer as a whole.
    pub(super) fn of_answer(&mut self, code: FaultCode, detail: impl FnOnce() -> String) {
        self.add(code, None, None, detail);
    }

    pub(super) fn add(
        &mut self,
        code: FaultCode,
        step: Option<usize>,
        object: Option<&str>,
        detail: impl FnOnce() -> String,
    ) {
        self.count += 1;
        if self.list.len() < MAX_FAULTS {
            self.list.push(Fault { code, step, object: object.map(str::to_owned), detail: detail() });
        }
    }

    pub(super) fn into_vec(self) -> Vec<Fault> {
        self.list
    }
}
