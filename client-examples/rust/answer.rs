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

/// What is left to do: the steps, then what comes of them.
pub(crate) struct Plan {
    steps: VecDeque<Step>,
    pub(crate) end: End,
    /// The same as the service has put it.
    pub(crate) body: Value,
}

/// What comes of the steps of a plan.
pub(crate) enum End {
    /// The target can be grasped.
    Grasp {
        target: String,
        grasp: Grasp,
    },
    /// All that is wanted away is away.
    AllAway,
    Cleared,
    PartlyCleared(Remains),
}

/// What a clearing leaves on the table.
#[derive(Deserialize)]
pub(crate) struct Remains {
    pub(crate) left: Vec<String>,
    /// What locks itself, if anything does.
    #[serde(deserialize_with = "Option::deserialize")]
    pub(crate) stuck: Option<Lock>,
    /// False if more could perhaps be taken away.
    pub(crate) proven: bool,
}

pub(crate) enum Step {
    Relocation(Relocation),
    Removal(Removal),
}

/// To another place on the table.
#[derive(Deserialize)]
pub(crate) struct Relocation {
    pub(crate) object: String,
    pub(crate) from: Pose,
    pub(crate) to: Pose,
    pub(crate) grasp: Grasp,
    pub(crate) release: Grasp,
    /// How far the object turns on the way, if that is said, rad.
    pub(crate) turn: Option<f64>,
}

/// Away from the table.
#[derive(Deserialize)]
pub(crate) struct Removal {
    pub(crate) object: String,
    pub(crate) from: Pose,
    pub(crate) grasp: Grasp,
    pub(crate) drop_off: String,
}

/// An object's own frame, or the centre of a disc.
#[derive(Deserialize)]
pub(crate) struct Pose {
    pub(crate) x: f64,
    pub(crate) y: f64,
    /// None for a disc that may be grasped at every yaw.
    pub(crate) yaw: Option<f64>,
}

/// The gripper's axis, and the direction of finger 0.
#[derive(Deserialize)]
pub(crate) struct Grasp {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) yaw: f64,
}

#[derive(Deserialize)]
pub(crate) struct Lock {
    pub(crate) core: Vec<String>,
}

#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
enum Verdict {
    Graspable,
    Relocate,
    Deadlock,
    NoSpace,
    TimedOut,
    Cleared,
    PartlyCleared,
}

#[derive(Deserialize)]
struct Head {
    verdict: Verdict,
}

#[derive(Deserialize)]
struct Steps {
    relocations: Vec<Value>,
}

#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
enum Action {
    PickPlace,
    PickDrop,
}

#[derive(Deserialize)]
struct Kind {
    action: Action,
}

/// Null may stand here, but the fields must.
#[derive(Deserialize)]
struct Target {
    #[serde(deserialize_with = "Option::deserialize")]
    target: Option<String>,
    #[serde(deserialize_with = "Option::deserialize")]
    target_grasp: Option<Grasp>,
}

#[derive(Deserialize)]
struct Deadlock {
    deadlock: Option<Lock>,
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
            Verdict::Graspable => Plan::to_goal(body, false).map(Self::Plan),
            Verdict::Relocate => Plan::to_goal(body, true).map(Self::Plan),
            Verdict::Cleared => Plan::read(body, End::Cleared).map(Self::Plan),
            Verdict::PartlyCleared => Plan::read(body, End::PartlyCleared(part(body)?)).map(Self::Plan),
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
    /// Without a target, objects are taken away and none is grasped in the end.
    fn to_goal(body: &str, with_steps: bool) -> serde_json::Result<Self> {
        let plan = Self::read(
            body,
            match part(body)? {
                Target { target: Some(target), target_grasp: Some(grasp) } => End::Grasp { target, grasp },
                Target { target: None, target_grasp: None } => End::AllAway,
                _ => return Err(Error::custom("a target without a grasp, or a grasp without a target")),
            },
        )?;
        if plan.steps.is_empty() == with_steps {
            return Err(Error::custom(format!("{} relocations do not go with the verdict", plan.steps.len())));
        }
        Ok(plan)
    }

    fn read(body: &str, end: End) -> serde_json::Result<Self> {
        let steps = part::<Steps>(body)?.relocations.iter().map(Step::read).collect::<serde_json::Result<_>>()?;
        Ok(Self { steps, end, body: part(body)? })
    }

    /// The next step. The plan is then what is left after it.
    pub(crate) fn next_step(&mut self) -> Option<Step> {
        let step = self.steps.pop_front()?;
        self.body["relocations"].as_array_mut()?.remove(0);
        Some(step)
    }

    /// True if the robot has nothing left to do.
    pub(crate) fn is_done(&self) -> bool {
        self.steps.is_empty() && !matches!(self.end, End::Grasp { .. })
    }
}

impl Step {
    fn read(step: &Value) -> serde_json::Result<Self> {
        match Kind::deserialize(step)?.action {
            Action::PickPlace => Relocation::deserialize(step).map(Self::Relocation),
            Action::PickDrop => Removal::deserialize(step).map(Self::Removal),
        }
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
