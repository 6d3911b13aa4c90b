//! What is worth knowing about an answer that one of the paper's methods gave.

use core::fmt;

use super::check::Fault;

/// One warning.
#[derive(Debug, Clone, PartialEq)]
pub enum Warning {
    /// For so many obstacles Eq. 10 is undefined or too small, and the tangent angle stands in.
    TangentAngle {
        /// Obstacles of grasps that were looked at.
        obstacles: usize,
    },
    /// The search found no sequence, but the exact search on the same base did.
    FalseDeadlock {
        /// The least number of relocations, places apart.
        least: usize,
    },
    /// The search's sequence is longer than the exact search's on the same base.
    NotOptimal {
        /// The length of the search's.
        found: usize,
        /// The least number of relocations, places apart.
        least: usize,
    },
    /// The search reached its limit of memory.
    SearchTooLarge,
    /// The deadlock is not proven for the swept finger: refuted, where the least number of relocations is known.
    UnprovenDeadlock {
        /// The least number of relocations by the swept finger, places apart.
        least: Option<usize>,
    },
    /// The checker, which judges by the swept finger alone, refuses a part of the plan.
    Faulty(Fault),
}

/// Whose doing it is: where a pointer into the request leads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cause<'a> {
    /// The setting of this name.
    Setting(&'static str),
    /// The object of this id.
    Object(&'a str),
}

impl Warning {
    /// The code in answers.
    pub fn code(&self) -> &'static str {
        match self {
            Self::TangentAngle { .. } => "tangent_angle",
            Self::FalseDeadlock { .. } => "false_deadlock",
            Self::NotOptimal { .. } => "not_optimal",
            Self::SearchTooLarge => "search_too_large",
            Self::UnprovenDeadlock { .. } => "unproven_deadlock",
            Self::Faulty(fault) => fault.code.name(),
        }
    }

    /// Where it comes from.
    pub fn cause(&self) -> Cause<'_> {
        match self {
            Self::TangentAngle { .. } | Self::UnprovenDeadlock { .. } => Cause::Setting("grasp_model"),
            Self::FalseDeadlock { .. } | Self::NotOptimal { .. } | Self::SearchTooLarge => Cause::Setting("search"),
            Self::Faulty(Fault { object: Some(id), .. }) => Cause::Object(id),
            Self::Faulty(_) => Cause::Setting("placement"),
        }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TangentAngle { obstacles } => write!(
                f,
                "for {obstacles} obstacles inside the fingers' ring Eq. 10 is undefined or too small: the tangent angle is taken"
            ),
            Self::FalseDeadlock { least } => {
                write!(f, "no sequence found, but {least} relocations free the target by the same knowledge")
            }
            Self::NotOptimal { found, least } => {
                write!(f, "{found} relocations found, but {least} are enough by the same knowledge")
            }
            Self::SearchTooLarge => write!(f, "the search reached its limit of memory"),
            Self::UnprovenDeadlock { least: Some(least) } => {
                write!(f, "no deadlock for the swept finger: {least} relocations free the target, places apart")
            }
            Self::UnprovenDeadlock { least: None } => {
                write!(f, "whether this is a deadlock for the swept finger too could not be told in time")
            }
            Self::Faulty(Fault { step: Some(step), detail, .. }) => write!(f, "relocation {step}: {detail}"),
            Self::Faulty(fault) => write!(f, "{}", fault.detail),
        }
    }
}
