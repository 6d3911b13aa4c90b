//! Answers of the service, as far as this client needs them.

use std::collections::VecDeque;

use serde::Deserialize;
use serde::de::{DeserializeOwned, Error};
use serde_json::Value;

/// An answer that this client understands.
pub(crate) enum Answer {
    Plan(Plan),
    /// The core.
    Deadlock(Vec<String>),
    /// What would have to go.
    NoSpace(Vec<String>),
    TimedOut(Vec<String>),
}

/// What is left to do: the steps, then the grasp of the target.
pub(crate) struct Plan {
    steps: VecDeque<Relocation>,
    pub(crate) target: String,
    pub(crate) yaw: f64,
    /// The same as the service has put it.
    pub(crate) body: Value,
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
struct Planned {
    relocations: VecDeque<Relocation>,
    target: String,
    target_grasp: Grasp,
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

#[derive(Deserialize)]
struct Verification {
    replan: bool,
}

impl Answer {
    /// Read the body. A verdict or an action that this client does not know is an error.
    pub(crate) fn read(body: &str) -> serde_json::Result<Self> {
        match part::<Head>(body)?.verdict {
            Verdict::Graspable => Plan::read(body, false).map(Self::Plan),
            Verdict::Relocate => Plan::read(body, true).map(Self::Plan),
            Verdict::Deadlock => {
                let lock = part::<Deadlock>(body)?.deadlock;
                Ok(Self::Deadlock(lock.map(|lock| lock.core).unwrap_or_default()))
            }
            Verdict::NoSpace => Ok(Self::NoSpace(part::<Unplanned>(body)?.needed.unwrap_or_default())),
            Verdict::TimedOut => Ok(Self::TimedOut(part::<Unplanned>(body)?.needed.unwrap_or_default())),
        }
    }
}

impl Plan {
    fn read(body: &str, with_steps: bool) -> serde_json::Result<Self> {
        let Planned { relocations: steps, target, target_grasp } = part(body)?;
        if steps.is_empty() == with_steps {
            return Err(Error::custom(format!("{} relocations do not go with the verdict", steps.len())));
        }
        Ok(Self { steps, target, yaw: target_grasp.yaw, body: part(body)? })
    }

    /// The next step. The plan is then what is left after it.
    pub(crate) fn next_step(&mut self) -> Option<Relocation> {
        let step = self.steps.pop_front()?;
        self.body["relocations"].as_array_mut()?.remove(0);
        Some(step)
    }
}

/// Whether a verification asks for a new plan.
pub(crate) fn read_replan(body: &str) -> serde_json::Result<bool> {
    part::<Verification>(body).map(|verification| verification.replan)
}

/// The fields that this type names.
fn part<T: DeserializeOwned>(body: &str) -> serde_json::Result<T> {
    serde_json::from_str(body)
}
