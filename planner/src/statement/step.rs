//! The steps of a plan: one variant for each action that the robot can do.

use nalgebra::Point2;

use crate::cost::Cost;
use crate::scene::Pose;

/// One step of a plan.
#[derive(Debug, Clone, PartialEq)]
pub enum Step {
    /// Lift an object and set it down elsewhere.
    PickPlace(PickPlace),
    /// Lift an object and take it away to a drop-off.
    PickDrop(PickDrop),
}

/// A stated pick-and-place.
#[derive(Debug, Clone, PartialEq)]
pub struct PickPlace {
    /// The id of the object moved.
    pub object: String,
    /// Where it stood.
    pub from: Option<StatedPose>,
    /// Where it is put.
    pub to: StatedPose,
    /// How it is picked.
    pub grasp: StatedGrasp,
    /// How it is let go.
    pub release: StatedGrasp,
    /// How far the object turns, rad; `None` for a disc that may be grasped at every yaw.
    pub turn: Option<f64>,
    /// The least distance to another object at the new place, edge to edge, m.
    pub gap: Option<f64>,
}

/// A stated pick-and-drop.
#[derive(Debug, Clone, PartialEq)]
pub struct PickDrop {
    /// The id of the object taken away.
    pub object: String,
    /// Where it stood.
    pub from: Option<StatedPose>,
    /// How it is picked.
    pub grasp: StatedGrasp,
    /// The id of the drop-off that it is taken to.
    pub drop_off: String,
}

/// Where an object's frame is said to stand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StatedPose {
    /// The frame's origin, m.
    pub at: Point2<f64>,
    /// How far the frame is turned, rad; `None` for a disc that may be grasped at every yaw.
    pub yaw: Option<f64>,
}

/// A stated grasp or release.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StatedGrasp {
    /// The gripper's axis, m; `None` for the origin of the object's frame.
    pub at: Option<Point2<f64>>,
    /// Direction of finger 0, rad, counter-clockwise from +x.
    pub yaw: f64,
    /// The free angle on each side of the yaw, rad.
    pub slack: Option<f64>,
}

/// Of a disc that may be grasped at every yaw.
impl From<Point2<f64>> for StatedPose {
    fn from(at: Point2<f64>) -> Self {
        Self { at, yaw: None }
    }
}

impl From<Pose> for StatedPose {
    fn from(pose: Pose) -> Self {
        Self { at: pose.at, yaw: Some(pose.yaw) }
    }
}

impl From<StatedPose> for Pose {
    fn from(StatedPose { at, yaw }: StatedPose) -> Self {
        Self { at, yaw: yaw.unwrap_or_default() }
    }
}

impl Step {
    /// The id of the object that is moved.
    pub fn object(&self) -> &str {
        match self {
            Self::PickPlace(step) => &step.object,
            Self::PickDrop(step) => &step.object,
        }
    }

    /// Where the step leaves the object; `None` if not on the table.
    pub fn rests_at(&self) -> Option<StatedPose> {
        match self {
            Self::PickPlace(step) => Some(step.to),
            Self::PickDrop(_) => None,
        }
    }

    /// The step, if it is a pick-and-place.
    pub fn pick_place(&self) -> Option<&PickPlace> {
        match self {
            Self::PickPlace(step) => Some(step),
            Self::PickDrop(_) => None,
        }
    }

    /// The same, to be changed.
    pub fn pick_place_mut(&mut self) -> Option<&mut PickPlace> {
        match self {
            Self::PickPlace(step) => Some(step),
            Self::PickDrop(_) => None,
        }
    }

    /// Where the hand holds the object on the table before and after, as far as stated, and how.
    pub fn holds(&self) -> impl Iterator<Item = (StatedPose, StatedGrasp)> + use<> {
        let (from, grasp, set_down) = match self {
            Self::PickPlace(step) => (step.from, step.grasp, Some((step.to, step.release))),
            Self::PickDrop(step) => (step.from, step.grasp, None),
        };
        from.map(|from| (from, grasp)).into_iter().chain(set_down)
    }

    /// What the step adds to the cost of a plan: at least one, since a bound counts the objects that have to move.
    pub fn cost(&self) -> Cost {
        match self {
            Self::PickPlace(_) | Self::PickDrop(_) => Cost::new(1),
        }
    }
}
