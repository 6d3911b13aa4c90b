//! Objects on the table.

use super::flaw::Flaw;
use nalgebra::Point2;

use super::footprint::Footprint;
use super::grasps::{Grasps, ListedGrasp};
use super::gripper::Gripper;
use super::likely::Lack;

/// The position of an object in its scene's list. The planner names objects only by it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ObjectIndex(u32);

impl ObjectIndex {
    /// The object at `position` of a list that has fewer than 2³² entries.
    pub fn new(position: usize) -> Self {
        Self(u32::try_from(position).expect("a scene holds fewer than 2^32 objects"))
    }

    /// The position in the list.
    pub fn get(self) -> usize {
        self.0 as usize
    }
}

/// An object of a checked scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Object {
    pub(super) id: String,
    pub(super) footprint: Footprint,
    pub(super) height: Option<f64>,
    pub(super) grasps: Grasps,
    /// True if the caller lists them.
    pub(super) grasps_stated: bool,
    /// Whether some grasp is left that the hand can do.
    pub(super) hindrance: Option<Hindrance>,
    pub(super) fixed: bool,
    pub(super) accepted: bool,
}

/// Why no hand grasps an object that is not fixed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Hindrance {
    /// It is wider than the greatest opening: its width, m.
    TooWide(f64),
    /// It has no grasp, or is no higher than the fingertips.
    NoGrasp,
}

/// An object where it stands, or may stand.
#[derive(Debug, Clone, Copy)]
pub struct Placed<'a> {
    /// The object.
    pub object: &'a Object,
    /// Where it stands.
    pub footprint: &'a Footprint,
}

/// Heights that differ by no more are equal, m: rounding, where they are sums of decimals.
const SAME_HEIGHT: f64 = 1e-9;

impl Object {
    /// The caller's name for it, unique in the scene.
    pub fn id(&self) -> &str {
        &self.id
    }

    /// The flaw of not being graspable though it is not fixed.
    pub(super) fn flaw(&self, gripper: &Gripper) -> Option<Flaw> {
        let id = || self.id.clone();
        match (self.hindrance?, gripper.max_opening()) {
            (Hindrance::TooWide(opening), Some(max_opening)) if self.grasps.listed().is_some() => {
                Some(Flaw::NeedsOpening { id: id(), opening, max_opening })
            }
            (Hindrance::TooWide(width), Some(max_opening)) => Some(Flaw::TooWide { id: id(), width, max_opening }),
            _ => Some(Flaw::NoGrasp { id: id(), why: self.lack(gripper) }),
        }
    }

    /// Why it has no grasp.
    fn lack(&self, gripper: &Gripper) -> Lack {
        let tip_height = gripper.tip_height();
        match self.height.filter(|height| *height <= tip_height + SAME_HEIGHT) {
            Some(height) => Lack::Low { height, tip_height },
            None if self.grasps_stated() => Lack::EmptyList,
            None => Lack::NotByShape(gripper.fingers()),
        }
    }

    /// Finds out whether any grasp is left that the hand can do.
    pub(super) fn find_hindrance(&mut self, gripper: &Gripper) {
        self.hindrance = match &self.grasps {
            _ if self.fixed => None,
            _ if self.height.is_some_and(|height| height <= gripper.tip_height() + SAME_HEIGHT) => {
                Some(Hindrance::NoGrasp)
            }
            Grasps::EveryYaw => {
                let width = 2.0 * self.footprint.circumradius();
                (!gripper.spans(&self.footprint)).then_some(Hindrance::TooWide(width))
            }
            Grasps::Listed(list) if list.iter().any(ListedGrasp::fits) => None,
            listed => Some(listed.least_width().map_or(Hindrance::NoGrasp, Hindrance::TooWide)),
        };
    }

    /// Where it stands at the start.
    pub fn footprint(&self) -> &Footprint {
        &self.footprint
    }

    /// How high it stands over the table, m; `None` if that is not known.
    pub fn height(&self) -> Option<f64> {
        self.height
    }

    /// How it may be grasped, whatever the hand can do.
    pub fn grasps(&self) -> &Grasps {
        &self.grasps
    }

    /// True if the caller lists its grasps; else they go with its shape.
    pub fn grasps_stated(&self) -> bool {
        self.grasps_stated
    }

    /// True if the caller calls it fixed.
    pub fn fixed(&self) -> bool {
        self.fixed
    }

    /// True if some drop-off accepts it.
    pub fn accepted(&self) -> bool {
        self.accepted
    }

    /// True if it is not fixed and the hand can grasp it in some way.
    pub fn can_be_grasped(&self) -> bool {
        !self.fixed && self.hindrance.is_none()
    }

    /// True if it is not fixed, but has no grasp, or is no higher than the fingertips; false for what is too wide for the hand.
    pub fn lacks_grasp(&self) -> bool {
        self.hindrance == Some(Hindrance::NoGrasp)
    }

    /// How near to the gripper's axis a finger closes at least, m: for a disc its radius.
    pub(super) fn closest_finger(&self) -> f64 {
        match &self.grasps {
            Grasps::EveryYaw => self.footprint.shape().inradius(),
            Grasps::Listed(list) => {
                let inner = list.iter().filter(|grasp| grasp.fits()).flat_map(ListedGrasp::inner);
                inner.copied().fold(f64::INFINITY, f64::min)
            }
        }
    }

    /// How high over the table the fingertips are when they grasp it, m.
    pub fn tips(&self, gripper: &Gripper) -> f64 {
        match (gripper.palm(), self.height) {
            (Some(palm), Some(height)) => gripper.tip_height().max(height - palm.finger_length),
            _ => gripper.tip_height(),
        }
    }

    /// True if fingers that grasp it pass over `obstacle`.
    pub fn fingers_pass_over(&self, obstacle: &Self, gripper: &Gripper) -> bool {
        obstacle.height.is_some_and(|height| height <= self.tips(gripper) + SAME_HEIGHT)
    }

    /// How near to the gripper's axis the edge of `obstacle` may come, so that the palm does not meet it when the gripper grasps
    /// this object, m; `None` where it passes over.
    pub fn palm_distance(&self, obstacle: &Self, gripper: &Gripper) -> Option<f64> {
        let (palm, height) = (gripper.palm()?, obstacle.height?);
        // The palm is as high as the object or higher: added up, rounding could put it below a neighbour of the same height.
        let palm_height = self.height.unwrap_or(0.0).max(gripper.tip_height() + palm.finger_length);
        (height > palm_height + SAME_HEIGHT).then_some(palm.radius + gripper.margin())
    }

    /// The gripper's axis in each grasp where the object stands, and how far from it the edge of another object can hinder it, m.
    pub(super) fn hands(&self, gripper: &Gripper) -> impl Iterator<Item = (Point2<f64>, f64)> {
        let (pose, palm) = (self.footprint.pose(), gripper.palm().map_or(0.0, |palm| palm.radius));
        let every_yaw = self.grasps.listed().is_none().then(|| (pose.at, self.reach(gripper)));
        let fitting = self.grasps.listed().unwrap_or_default().iter().filter(|grasp| grasp.fits());
        let listed =
            fitting.map(move |grasp| (pose.point(grasp.at()), grasp.corner_distance().max(palm) + gripper.margin()));
        every_yaw.into_iter().chain(listed)
    }

    /// The distance from the origin of its frame within which the edge of another object can hinder a grasp of it, m.
    pub fn reach(&self, gripper: &Gripper) -> f64 {
        let palm = gripper.palm().map_or(0.0, |palm| palm.radius);
        let reach = match &self.grasps {
            Grasps::EveryYaw => gripper.corner_distance(&self.footprint).max(palm),
            Grasps::Listed(list) => {
                list.iter().map(|grasp| grasp.reach().max(palm + grasp.offset())).fold(0.0, f64::max)
            }
        };
        reach + gripper.margin()
    }
}
