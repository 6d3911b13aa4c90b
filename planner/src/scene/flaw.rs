//! What can be wrong with a scene, or look wrong.

use super::Rectangle;
use super::likely::{Lack, Likely, Named, Yardstick};
use super::limits::MAX_ID_LENGTH;

/// The kind of a fault or warning. Warnings are: an overlap within the tolerance, fingers that overlap, a disc that
/// hangs over the table's edge, a number that looks like a slip of its unit, an object that the hand can't grasp, what is assumed
/// of shapes, grasps and heights, a drop-off that accepts what is not there.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Flaw {
    /// A number outside its range, bounds included.
    #[error("{value} is not between {min} and {max}")]
    OutOfRange {
        /// The number given.
        value: f64,
        /// The least admitted value.
        min: f64,
        /// The greatest admitted value.
        max: f64,
    },
    /// A yaw tolerance above its range.
    #[error("{value} is not between 0 and {max}: degrees instead of radians?")]
    AngleOutOfRange {
        /// The number given.
        value: f64,
        /// The greatest admitted value, rad.
        max: f64,
    },
    /// A count that is not a whole number.
    #[error("{0} is not a whole number")]
    NotWhole(f64),
    /// A rectangle whose upper bound is not above its lower bound.
    #[error("the upper bound {max} is not above the lower bound {min}")]
    EmptyRectangle {
        /// The lower bound given, m.
        min: f64,
        /// The upper bound given, m.
        max: f64,
    },
    /// An id of no or too many characters.
    #[error("an id has 1 to {max} characters, this one has {length}")]
    IdLength {
        /// Characters given.
        length: usize,
        /// The most that is admitted.
        max: usize,
    },
    /// An id that an earlier object has.
    #[error("'{id}' is already the id of object {first}")]
    DuplicateId {
        /// The id.
        id: String,
        /// The position of the earlier object.
        first: usize,
    },
    /// More objects than the limit.
    #[error("{count} objects are more than the limit of {max}")]
    TooManyObjects {
        /// Objects given.
        count: usize,
        /// The most that is admitted.
        max: usize,
    },
    /// A drop-off's id that an earlier one has.
    #[error("'{id}' is already the id of drop-off {first}")]
    DuplicateDropOff {
        /// The id.
        id: String,
        /// The position of the earlier drop-off.
        first: usize,
    },
    /// More drop-offs than the limit.
    #[error("{count} drop-offs are more than the limit of {max}")]
    TooManyDropOffs {
        /// Drop-offs given.
        count: usize,
        /// The most that is admitted.
        max: usize,
    },
    /// What is taken away needs a drop-off.
    #[error("the field 'drop_offs' is required where objects are taken away")]
    NoDropOff,
    /// Only what a drop-off accepts may move, and there is none.
    #[error("with 'drop_off' nothing can be moved, since there is no drop-off")]
    NothingAccepted,
    /// A drop-off accepts what is not there.
    #[error("there is no object '{0}'")]
    UnknownObject(String),
    /// A list of the goal without ids.
    #[error("a list of objects that are wanted has at least one id")]
    NothingWanted,
    /// An id of the goal's list that an earlier one has.
    #[error("'{id}' is named before, at {first}")]
    NamedTwice {
        /// The id.
        id: String,
        /// The earlier position in the list.
        first: usize,
    },
    /// An object is too wide for the hand. As the goal it is a fault, elsewhere a warning.
    #[error("'{id}' is {width:.6} m wide, more than the greatest opening {max_opening} m")]
    TooWide {
        /// The object's id.
        id: String,
        /// Its width, m.
        width: f64,
        /// The hand's greatest opening, m.
        max_opening: f64,
    },
    /// No listed grasp of an object opens the hand no wider than it opens. As the goal it is a fault, elsewhere a warning.
    #[error(
        "'{id}' needs an opening of {opening:.6} m in its narrowest grasp, more than the greatest opening {max_opening} m"
    )]
    NeedsOpening {
        /// The object's id.
        id: String,
        /// The opening that it needs within the tolerance of that grasp, m.
        opening: f64,
        /// The hand's greatest opening, m.
        max_opening: f64,
    },
    /// An object has no grasp, or is no higher than the fingertips. As the goal it is a fault, elsewhere a warning.
    #[error("'{id}' has no grasp: {why}")]
    NoGrasp {
        /// The object's id.
        id: String,
        /// Why it has none.
        why: Lack,
    },
    /// The gripper's axis is beside the object in a listed grasp.
    #[error("the gripper's axis is beside '{0}': are 'x' and 'y' in the object's own frame?")]
    AxisBesideObject(String),
    /// Objects are grasped in the ways that go with their shapes.
    #[error("grasped as their shapes suggest, since no grasps are stated: {}", Named(.0))]
    DefaultGrasps(Vec<String>),
    /// Objects of unknown height, which the palm is taken to pass over.
    #[error("without a height, so that the palm is taken to pass over them: {}", Named(.0))]
    UnknownHeight(Vec<String>),
    /// More grasps of one object than the limit.
    #[error("{count} grasps are more than the limit of {max}")]
    TooManyGrasps {
        /// Grasps given.
        count: usize,
        /// The most that is admitted.
        max: usize,
    },
    /// The grasps of all objects together would take too long.
    #[error(
        "the grasps of all objects take too long to find out where the fingers close: fewer grasps, fingers or corners, or \
         smaller tolerances"
    )]
    TooMuchClosing,
    /// The tolerance of a grasp is half of the angle between two fingers or more.
    #[error("the tolerance of a grasp is below π/{fingers}")]
    WideTolerance {
        /// k.
        fingers: u32,
    },
    /// More points of one polygon than the limit.
    #[error("{count} points are more than the limit of {max}")]
    TooManyPoints {
        /// Points given.
        count: usize,
        /// The most that is admitted.
        max: usize,
    },
    /// The points of a polygon are on one line.
    #[error("a polygon has at least three points that are not on one line")]
    NoArea,
    /// A polygon that is not convex, or crosses itself, is planned as its hull.
    #[error("is not convex and is planned as its convex hull: its area grows from {stated:.6} m² to {area:.6} m²")]
    ConvexHull {
        /// The area within the points as they are given, m².
        stated: f64,
        /// The area of their hull, m².
        area: f64,
    },
    /// A palm is stated by half.
    #[error("the field '{0}' is required where the palm is described")]
    PalmByHalf(&'static str),
    /// A frame is turned by more than a whole turn.
    #[error("a yaw of {0} rad is more than a whole turn: degrees instead of radians?")]
    ManyTurns(f64),
    /// No drop-off accepts an object that is to be taken away.
    #[error("no drop-off accepts '{0}'")]
    NotAccepted(String),
    /// The hand always opens all the way, and that is not stated.
    #[error("the field 'max_opening' is required where 'opening' is 'full'")]
    NoMaxOpening,
    /// The target is no object's id.
    #[error("there is no object '{0}'")]
    UnknownTarget(String),
    /// The target can't be moved.
    #[error("the target '{0}' is fixed")]
    FixedTarget(String),
    /// An object of the goal's list can't be moved.
    #[error("'{0}' is fixed")]
    FixedMember(String),
    /// The centre is not on the table.
    #[error("the centre ({x}, {y}) is not on the table ({top}){likely}")]
    OffTable {
        /// Centre, m.
        x: f64,
        /// Centre, m.
        y: f64,
        /// The table top.
        top: Rectangle,
        /// The likely cause.
        likely: Likely,
    },
    /// Two discs overlap.
    #[error("overlaps '{other}' by {depth:.6} m (tolerance {tolerance} m){likely}")]
    Overlap {
        /// The other object's id.
        other: String,
        /// How deep, m.
        depth: f64,
        /// The deepest overlap that counts as perception noise, m.
        tolerance: f64,
        /// The likely cause.
        likely: Likely,
    },
    /// More obstacles within reach of one grasp than the limit.
    #[error("a grasp of '{id}' has more than {max} obstacles in reach")]
    TooManyNeighbours {
        /// The object that is grasped.
        id: String,
        /// The most that is admitted.
        max: usize,
    },
    /// A disc hangs over the table's edge by more than a third of its radius.
    #[error("hangs over the table's edge by {overhang:.6} m, more than a third of its radius {radius} m")]
    HangsOverTable {
        /// How far, m.
        overhang: f64,
        /// r, m.
        radius: f64,
    },
    /// With this yaw tolerance one obstacle in reach blocks every yaw.
    #[error(
        "a yaw tolerance of {tolerance} rad is π/{fingers} or more, so one obstacle in reach blocks every yaw: degrees \
         instead of radians?"
    )]
    WideYawTolerance {
        /// The tolerance, rad.
        tolerance: f64,
        /// k.
        fingers: u32,
    },
    /// A length out of proportion to the others of the scene.
    #[error("{length} m is out of all proportion to {yardstick}: millimetres instead of metres?")]
    OutOfProportion {
        /// The length, m.
        length: f64,
        /// The length that it was compared with.
        yardstick: Yardstick,
    },
    /// Neighbouring fingers overlap at the edge of the object.
    #[error("fingers of width {finger_width} m overlap round '{id}' of radius {radius} m")]
    FingersOverlap {
        /// The object that is grasped.
        id: String,
        /// w, m.
        finger_width: f64,
        /// r, m.
        radius: f64,
    },
}

impl Flaw {
    /// No object has this id. A text that is too long to be an id is not repeated.
    pub(super) fn unknown_id(id: &str, known: impl FnOnce(String) -> Self) -> Self {
        let length = id.chars().count();
        if length > MAX_ID_LENGTH { Self::IdLength { length, max: MAX_ID_LENGTH } } else { known(id.to_owned()) }
    }
}
