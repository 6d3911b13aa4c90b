//! Answers of the service, as far as this client needs them.

use serde::Deserialize;
use serde::de::{DeserializeOwned, Error};

/// An answer that this client understands.
pub(crate) enum Answer {
    Graspable {
        target: String,
        yaw: f64,
    },
    /// The plan's first step. The others are planned again once the table is seen again.
    Relocate(Relocation),
    /// The core.
    Deadlock(Vec<String>),
    /// What would have to go.
    NoSpace(Vec<String>),
    TimedOut(Vec<String>),
}

#[derive(Deserialize)]
pub(crate) struct Relocation {
    /// Read so that an unknown one is an error.
    #[serde(rename = "action")]
    _action: Action,
    pub(crate) object: String,
    pub(crate) from: Place,
    pub(crate) to: Place,
    pub(crate) grasp: Grasp,
    pub(crate) release: Grasp,
}

#[derive(Deserialize)]
pub(crate) struct Place {
    pub(crate) x: f64,
    pub(crate) y: f64,
}

#[derive(Deserialize)]
pub(crate) struct Grasp {
    pub(crate) yaw: f64,
}

#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
enum Verdict {
    Graspable,
    Relocate,
    Deadlock,
    NoSpace,
    TimedOut,
}

#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
enum Action {
    PickPlace,
}

#[derive(Deserialize)]
struct Head {
    verdict: Verdict,
}

#[derive(Deserialize)]
struct Graspable {
    target: String,
    target_grasp: Grasp,
}

#[derive(Deserialize)]
struct Plan {
    relocations: Vec<Relocation>,
}

#[derive(Deserialize)]
struct Deadlock {
    deadlock: Option<Lock>,
}

#[derive(Deserialize)]
struct Lock {
    core: Vec<String>,
}

#[derive(Deserialize)]
struct Unplanned {
    needed: Option<Vec<String>>,
}

impl Answer {
    /// Read the body. A verdict or an action that this client does not know is an error.
    pub(crate) fn read(body: &str) -> serde_json::Result<Self> {
        match part::<Head>(body)?.verdict {
            Verdict::Graspable => {
                let Graspable { target, target_grasp } = part(body)?;
                Ok(Self::Graspable { target, yaw: target_grasp.yaw })
            }
            Verdict::Relocate => {
                let first = part::<Plan>(body)?.relocations.into_iter().next();
                first.map(Self::Relocate).ok_or_else(|| Error::custom("a plan without relocations"))
            }
            Verdict::Deadlock => {
                let lock = part::<Deadlock>(body)?.deadlock;
                Ok(Self::Deadlock(lock.map(|lock| lock.core).unwrap_or_default()))
            }
            Verdict::NoSpace => Ok(Self::NoSpace(part::<Unplanned>(body)?.needed.unwrap_or_default())),
            Verdict::TimedOut => Ok(Self::TimedOut(part::<Unplanned>(body)?.needed.unwrap_or_default())),
        }
    }
}

/// The fields that this type names.
fn part<T: DeserializeOwned>(body: &str) -> serde_json::Result<T> {
    serde_json::from_str(body)
}
