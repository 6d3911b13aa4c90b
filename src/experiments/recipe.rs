//! Recipes of generated scenes, and the number helpers of their generators.

use nalgebra::Point2;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use singulate_planner::scene::{Destination, DropOffDraft, Finding, GripperDraft, LENGTH_RANGE, RectangleDraft};

/// The arrangement of the objects.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Crowding {
    /// Uniformly at random.
    #[default]
    Loose,
    /// In one dense cluster, each object up to the recipe's gap from two others.
    Pressed,
}

/// What is wanted of a generated scene. Objects that it names are never fixed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Wanted {
    /// The most crowded object that the hand spans, as the target.
    #[default]
    Target,
    /// Any of so many: the most crowded objects that the hand spans. One or more.
    AnyOf(usize),
    /// All of so many: the most crowded objects that the hand spans and a drop-off accepts. One or more.
    AllOf(usize),
    /// A clear table.
    Clear,
}

/// A kind of scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Recipe {
    /// The number of objects, the target included.
    pub objects: usize,
    /// Width and height of the table, m.
    pub table: (f64, f64),
    /// The table's lower left corner, m.
    pub origin: (f64, f64),
    /// The least and the greatest radius, m.
    pub radius: (f64, f64),
    /// The gripper.
    pub gripper: GripperDraft,
    /// The probability that an object other than the target is fixed.
    pub fixed_share: f64,
    /// The arrangement of the objects.
    pub arrangement: Crowding,
    /// The largest gap between an object of a pressed cluster and its two supports, m.
    pub pressed_gap: f64,
    /// What is wanted.
    pub wanted: Wanted,
    /// The drop-offs. Objects are called `o0`, `o1` and so on.
    pub drop_offs: Vec<DropOffDraft>,
    /// Where objects go that have to move; `None` for the default.
    pub destination: Option<Destination>,
}

/// The paper's gripper and its Case I table with 16 objects.
impl Default for Recipe {
    fn default() -> Self {
        let gripper = GripperDraft {
            fingers: Some(3.0),
            finger_width: Some(0.02),
            clearance: Some(0.05),
            margin: Some(0.0),
            yaw_tolerance: Some(0.0),
            ..GripperDraft::default()
        };
        Self {
            objects: 16,
            table: (1.2, 0.7),
            origin: (0.0, 0.0),
            radius: (0.075, 0.075),
            gripper,
            fixed_share: 0.0,
            arrangement: Crowding::Loose,
            pressed_gap: 2e-3,
            wanted: Wanted::Target,
            drop_offs: Vec::new(),
            destination: None,
        }
    }
}

/// Why no scene can be made from the recipe.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GenerateError {
    /// The table is too full.
    #[error("{fitted} of {wanted} objects fitted on the table")]
    TooFull {
        /// The most objects placed in any attempt.
        fitted: usize,
        /// The number in the recipe.
        wanted: usize,
    },
    /// Too few objects can be wanted.
    #[error("{wanted} objects are wanted, and {fit} can be grasped and taken where they have to go")]
    TooFewFit {
        /// How many can be grasped, and where they are to be taken away, are accepted by a drop-off.
        fit: usize,
        /// How many the recipe wants.
        wanted: usize,
    },
    /// A figure of the recipe is invalid.
    #[error("{0}")]
    Recipe(&'static str),
    /// The table or the gripper of the scene is invalid.
    #[error("{}", .0.iter().map(|finding| finding.flaw.to_string()).collect::<Vec<_>>().join("; "))]
    Scene(Vec<Finding>),
}

impl Wanted {
    /// How many objects the goal names; `None` if it names none.
    pub(super) fn count(self) -> Option<usize> {
        match self {
            Self::Target => Some(1),
            Self::AnyOf(count) | Self::AllOf(count) => Some(count),
            Self::Clear => None,
        }
    }

    /// True if the goal takes objects to drop-offs.
    fn takes_away(self) -> bool {
        matches!(self, Self::AllOf(_) | Self::Clear)
    }
}

impl Recipe {
    /// # Errors
    /// [`GenerateError::Recipe`] if a figure is invalid.
    pub(super) fn check(&self) -> Result<(), GenerateError> {
        let length = |value: f64| (LENGTH_RANGE.0..=LENGTH_RANGE.1).contains(&value);
        let (least, greatest) = self.radius;
        let faults = [
            (self.objects == 0, "a scene has at least one object"),
            (!(length(least) && length(greatest)), "a radius is between 1e-6 m and 1e3 m"),
            (least > greatest, "the least radius is above the greatest"),
            (!(0.0..=1.0).contains(&self.fixed_share), "the fixed share is between 0 and 1"),
            (!(length(self.table.0) && length(self.table.1)), "a side of the table is between 1e-6 m and 1e3 m"),
            (!(0.0..=1e3).contains(&self.pressed_gap), "the gap is between 0 and 1e3 m"),
            (self.wanted.count() == Some(0), "a goal names at least one object"),
            (self.wanted.takes_away() && self.drop_offs.is_empty(), "to take objects away, the scene needs a drop-off"),
            (!(self.origin.0.is_finite() && self.origin.1.is_finite()), "the origin is not a place"),
        ];
        match faults.into_iter().find(|(wrong, _)| *wrong) {
            Some((_, detail)) => Err(GenerateError::Recipe(detail)),
            None => Ok(()),
        }
    }

    /// The table's lower left and upper right corner.
    pub(super) fn corners(&self) -> (Point2<f64>, Point2<f64>) {
        let (x, y) = self.origin;
        let micrometres = |x: f64, y: f64| Point2::new(whole_micrometres(x), whole_micrometres(y));
        (micrometres(x, y), micrometres(x + self.table.0, y + self.table.1))
    }
}

/// A rectangle with these corners.
pub(super) fn rectangle(min: Point2<f64>, max: Point2<f64>) -> RectangleDraft {
    RectangleDraft { x_min: Some(min.x), y_min: Some(min.y), x_max: Some(max.x), y_max: Some(max.y) }
}

/// Rounded, since a JSON file with more digits is hard to read.
pub(super) fn whole_micrometres(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

/// A random number from `least` to `greatest`.
pub(super) fn between(random: &mut ChaCha8Rng, (least, greatest): (f64, f64)) -> f64 {
    let share: f64 = random.random();
    least + share * (greatest - least)
}
