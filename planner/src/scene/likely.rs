//! The parts of sentences about flaws: likely causes, what a length was compared with, lists of ids.

use core::fmt;

/// The most ids that a sentence names.
const MAX_NAMED: usize = 1000;

/// Ids as a list, which ends early.
pub(super) struct Named<'a>(pub(super) &'a [String]);

impl fmt::Display for Named<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (at, id) in self.0.iter().take(MAX_NAMED).enumerate() {
            write!(f, "{}'{id}'", if at == 0 { "" } else { ", " })?;
        }
        match self.0.len().saturating_sub(MAX_NAMED) {
            0 => Ok(()),
            more => write!(f, " and {more} more"),
        }
    }
}

/// The likely cause of a fault, as the end of its sentence.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Likely {
    /// No single cause is likely.
    Open,
    /// The objects are given in another unit, or in another frame than the table.
    FrameOrUnit,
    /// Two detections of one object.
    SeenTwice,
    /// The lengths are no metres, or two detections of one object.
    UnitOrSeenTwice,
}

impl fmt::Display for Likely {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Open => "",
            Self::FrameOrUnit => ": another frame, or millimetres instead of metres?",
            Self::SeenTwice => ": one object seen twice?",
            Self::UnitOrSeenTwice => ": millimetres instead of metres, or one object seen twice?",
        })
    }
}

/// A length that another one is compared with, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Yardstick {
    /// The largest radius of an object.
    LargestRadius(f64),
    /// The smallest radius of an object.
    SmallestRadius(f64),
    /// The sides of the table.
    Table(f64, f64),
}

impl fmt::Display for Yardstick {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::LargestRadius(radius) => write!(f, "the largest radius, {radius} m"),
            Self::SmallestRadius(radius) => write!(f, "the smallest radius, {radius} m"),
            Self::Table(x, y) => write!(f, "the table of {x:.3} m by {y:.3} m"),
        }
    }
}

/// Why an object has no grasp.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Lack {
    /// The caller lists none.
    EmptyList,
    /// None goes with its shape and so many fingers.
    NotByShape(u32),
    /// It is no higher than the fingertips.
    Low {
        /// m.
        height: f64,
        /// m.
        tip_height: f64,
    },
}

impl fmt::Display for Lack {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::EmptyList => write!(f, "its list of grasps is empty"),
            Self::NotByShape(fingers) => {
                write!(f, "none goes with its shape and {fingers} fingers; list its 'grasps'")
            }
            Self::Low { height, tip_height } => {
                write!(f, "its height {height} m is not above the fingertips, {tip_height} m over the table")
            }
        }
    }
}
