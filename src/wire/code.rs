//! The codes of a request's faults.

use core::fmt;

use serde::Serialize;
use utoipa::ToSchema;

/// The page that explains every code, in the project's sources.
pub(super) const ERRORS_PAGE: &str = "docs/errors.md";

/// The kinds of fault of a request. Some of them are only warnings. An `overlap` within the tolerance is a warning, a
/// deeper one a fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(example = "out_of_range")]
pub enum ErrorCode {
    /// The body is not JSON.
    MalformedJson,
    /// A field that is required is absent.
    Missing,
    /// A field that is not known here.
    UnknownField,
    /// A field that is there twice.
    RepeatedField,
    /// Another type of value was expected.
    WrongType,
    /// None of the words that may stand here.
    UnknownValue,
    /// Not a whole number.
    NotWhole,
    /// Too small, too large, or further from 0 than any number may be; a parameter that can't be read; a URL of too many bytes.
    OutOfRange,
    /// An id is empty or too long.
    IdLength,
    /// Two objects, or two drop-offs, have one id; a list names an id twice.
    DuplicateId,
    /// A rectangle whose least is not below its greatest.
    EmptyRectangle,
    /// The middle of an object is not on the table.
    OffTable,
    /// Two objects overlap: past the tolerance a fault, within it a warning.
    Overlap,
    /// The fingers overlap each other. Only ever a warning.
    FingersOverlap,
    /// An object hangs over the table's edge. Only ever a warning.
    HangsOverTable,
    /// A yaw tolerance with which any obstacle in reach blocks every yaw; degrees for radians? Only ever a warning.
    WideYawTolerance,
    /// A length that does not go with the rest of the scene, or a yaw of more than a turn; millimetres for metres, degrees for
    /// radians? Only ever a warning.
    OutOfProportion,
    /// The target, or another object that is wanted, is no object of the scene.
    UnknownTarget,
    /// The target, or another object that is wanted, can't be moved.
    FixedTarget,
    /// An object that is wanted, or taken away, is wider than the hand opens. As the goal a fault, elsewhere only a warning.
    TooWide,
    /// An object that is wanted, or taken away, has no grasp that the hand can do. As the goal a fault, elsewhere only a warning.
    NoGrasp,
    /// A polygon that is not convex is planned as its hull. Only ever a warning.
    ConvexHull,
    /// The points of a polygon are fewer than three, or on one line.
    NoArea,
    /// More points than a polygon may have.
    TooManyPoints,
    /// More grasps than an object may have.
    TooManyGrasps,
    /// Objects are grasped as their shapes suggest, since none of their grasps are stated. Only ever a warning.
    DefaultGrasps,
    /// Objects without a height, where a palm is described. Only ever a warning.
    UnknownHeight,
    /// The gripper's axis is beside the object in a listed grasp; the table's frame for the object's? Only ever a warning.
    AxisBesideObject,
    /// No drop-off accepts an object that is to be taken away.
    NotAccepted,
    /// A list of ids without an id.
    EmptyList,
    /// Fields that exclude each other.
    ConflictingFields,
    /// The paper's methods know no such field: they know only discs.
    DiscsOnly,
    /// What a drop-off accepts is no object of the scene. Only ever a warning.
    UnknownObject,
    /// Nothing can be moved without a drop-off. Only ever a warning.
    NoDropOff,
    /// More drop-offs than a scene may have.
    TooManyDropOffs,
    /// More objects than a scene may have.
    TooManyObjects,
    /// More obstacles in reach of one grasp than there may be.
    TooManyNeighbours,
    /// The options of all objects together would not fit into memory.
    TooDense,
    /// The image of the table would have too many pixels.
    TooFine,
    /// The plan is for another target than the scene's.
    TargetMismatch,
    /// A batch without scenes.
    TooFewScenes,
    /// A batch with more scenes than it may have.
    TooManyScenes,
    /// The URL of a callback has too many characters.
    UrlLength,
    /// The URL of a callback is none that could be called.
    BadCallbackUrl,
    /// The operator has not listed the host of a callback.
    CallbackNotAllowed,
    /// The header `Idempotency-Key` is no key.
    IdempotencyKey,
    /// A parameter that is not known here.
    UnknownParameter,
    /// A parameter that is there twice.
    RepeatedParameter,
}

impl ErrorCode {
    /// The entry that explains it.
    pub(super) fn entry(self) -> String {
        format!("{ERRORS_PAGE}#{self}")
    }
}

impl fmt::Display for ErrorCode {
    /// Its name in JSON.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}
