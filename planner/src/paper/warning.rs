//! Warnings about answers of the paper's methods.

use core::fmt;

use crate::check::Fault;
use crate::cost::Cost;
use crate::knowledge::NoBase;

/// One warning.
#[derive(Debug, Clone, PartialEq)]
pub enum Warning {
    /// Eq. 10 is undefined or too small for some pairs, and the tangent angle replaces it.
    TangentAngle {
        /// The number of such pairs of a grasped object and an obstacle, among the grasps examined.
        pairs: usize,
    },
    /// The search found no sequence, but the exact search on the same base did.
    FalseDeadlock {
        /// This many relocations suffice, places ignored.
        enough: Cost,
    },
    /// The search's sequence is longer than the exact search's on the same base.
    NotOptimal {
        /// The length of the search's sequence.
        found: Cost,
        /// This many relocations suffice, places ignored.
        enough: Cost,
    },
    /// The search reached its limit of memory.
    SearchTooLarge,
    /// The plan is longer than the swept finger needs.
    FewerSuffice {
        /// This many relocations suffice by the swept finger, places ignored.
        enough: Cost,
    },
    /// The deadlock is not proven for the swept finger; refuted if it is known how many relocations suffice.
    UnprovenDeadlock {
        /// This many relocations suffice by the swept finger, places ignored.
        enough: Option<Cost>,
        /// The setting that causes it.
        setting: &'static str,
    },
    /// The deadlock is not proven for the swept finger, whose knowledge base would be too large.
    DeadlockTooDense {
        /// The setting that causes it.
        setting: &'static str,
    },
    /// The checker, which judges by the swept finger alone, refuses a part of the plan.
    Faulty(Fault),
}

/// The part of the request a warning points to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cause<'a> {
    /// The setting of this name.
    Setting(&'static str),
    /// The object of this id.
    Object(&'a str),
    /// The request as a whole.
    Request,
}

impl Warning {
    /// The code in answers.
    pub fn code(&self) -> &'static str {
        match self {
            Self::TangentAngle { .. } => "tangent_angle",
            Self::FalseDeadlock { .. } => "false_deadlock",
            Self::NotOptimal { .. } => "not_optimal",
            Self::SearchTooLarge => "search_too_large",
            Self::FewerSuffice { .. } => "fewer_suffice",
            Self::UnprovenDeadlock { .. } | Self::DeadlockTooDense { .. } => "unproven_deadlock",
            Self::Faulty(fault) => fault.code.name(),
        }
    }

    /// The part of the request it points to.
    pub fn cause(&self) -> Cause<'_> {
        match self {
            Self::TangentAngle { .. } | Self::FewerSuffice { .. } => Cause::Setting("grasp_model"),
            Self::UnprovenDeadlock { setting, .. } | Self::DeadlockTooDense { setting } => Cause::Setting(setting),
            Self::FalseDeadlock { .. } | Self::NotOptimal { .. } | Self::SearchTooLarge => Cause::Setting("search"),
            Self::Faulty(Fault { object: Some(id), .. }) => Cause::Object(id),
            Self::Faulty(_) => Cause::Request,
        }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TangentAngle { pairs } => write!(
                f,
                "Eq. 10 is undefined or too small for {pairs} of an object and an obstacle inside the ring of its fingers: the tangent angle is taken",
                pairs = counted(*pairs as u64, "pair")
            ),
            Self::FalseDeadlock { enough } => {
                write!(f, "no sequence found, but by the same knowledge {}", sufficient(*enough))
            }
            Self::NotOptimal { found, enough } => {
                write!(
                    f,
                    "{} found, but by the same knowledge {}",
                    counted(found.get(), "relocation"),
                    sufficient(*enough)
                )
            }
            Self::SearchTooLarge => write!(f, "the search reached its limit of memory"),
            Self::FewerSuffice { enough } => {
                write!(f, "by the swept finger {}, if there are places for them", sufficient(*enough))
            }
            Self::UnprovenDeadlock { enough: Some(enough), .. } => {
                write!(f, "no deadlock for the swept finger: {}, if there are places for them", sufficient(*enough))
            }
            Self::UnprovenDeadlock { enough: None, .. } => {
                write!(f, "time ran out before it was known whether this is a deadlock for the swept finger too")
            }
            Self::DeadlockTooDense { .. } => {
                write!(
                    f,
                    "it was not examined whether this is a deadlock for the swept finger too: {}",
                    NoBase::TooLarge
                )
            }
            Self::Faulty(Fault { step: Some(step), detail, .. }) => write!(f, "step {}: {detail}", step + 1),
            Self::Faulty(fault) => write!(f, "{}", fault.detail),
        }
    }
}

fn sufficient(cost: Cost) -> String {
    format!("{} suffice{}", counted(cost.get(), "relocation"), if cost.get() == 1 { "s" } else { "" })
}

fn counted(count: u64, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::FaultCode;

    #[test]
    fn a_step_is_counted_from_one_and_one_of_a_kind_has_no_plural() {
        let fault = Fault {
            code: FaultCode::ReleaseBlocked,
            step: Some(0),
            object: Some("plate".into()),
            detail: "a finger".into(),
        };
        let faulty = Warning::Faulty(fault);
        assert_eq!((faulty.code(), faulty.cause()), ("release_blocked", Cause::Object("plate")));
        assert_eq!(faulty.to_string(), "step 1: a finger");
        let texts = [1, 2]
            .map(|count| Warning::UnprovenDeadlock { enough: Some(Cost::new(count)), setting: "search" }.to_string());
        assert!(
            texts[0].contains("1 relocation suffices,") && texts[1].contains("2 relocations suffice,"),
            "{texts:?}"
        );
    }
}
