//! The table as the client knows it, in the words of the request.

use serde_json::Value;

use crate::answer::Pose;
use crate::service::Failure;

/// The service's own limits, where its operator has not changed them.
const DEFAULT_LIMIT_MS: u64 = 1000;
const LONGEST_LIMIT_MS: u64 = 60_000;

/// Any JSON will do: what makes a scene is for the service to say.
pub(crate) struct Scene(pub(crate) Value);

impl Scene {
    /// What the scene names.
    pub(crate) fn limit_ms(&self) -> u64 {
        let named = self.0.pointer("/settings/time_limit_ms").and_then(Value::as_u64);
        named.unwrap_or(DEFAULT_LIMIT_MS).min(LONGEST_LIMIT_MS)
    }

    /// The same scene with ten times the time to plan, as far as the service gives it.
    pub(crate) fn with_more_time(&self) -> Self {
        let mut patient = self.0.clone();
        patient["settings"]["time_limit_ms"] = self.limit_ms().saturating_mul(10).min(LONGEST_LIMIT_MS).into();
        Self(patient)
    }

    /// Puts an object elsewhere.
    pub(crate) fn put(&mut self, object: &str, to: &Pose) -> Result<(), Failure> {
        let (items, at) = self.find("objects", object)?;
        items[at]["x"] = to.x.into();
        items[at]["y"] = to.y.into();
        if let Some(yaw) = to.yaw {
            items[at]["yaw"] = yaw.into();
        }
        Ok(())
    }

    /// Takes an object away to a drop-off. One that is then full is left out, and what is away is no longer wanted away.
    pub(crate) fn take_away(&mut self, object: &str, to: &str) -> Result<(), Failure> {
        let (objects, at) = self.find("objects", object)?;
        objects.remove(at);
        let (drop_offs, at) = self.find("drop_offs", to)?;
        match drop_offs[at]["capacity"].as_f64() {
            Some(capacity) if capacity > 1.0 => drop_offs[at]["capacity"] = (capacity - 1.0).into(),
            Some(_) => drop(drop_offs.remove(at)),
            None => {}
        }
        if let Some(wanted) = self.0.pointer_mut("/goal/all_of").and_then(Value::as_array_mut) {
            wanted.retain(|id| id.as_str() != Some(object));
        }
        Ok(())
    }

    /// A list of the scene, and where the item of this id is in it.
    fn find(&mut self, list: &str, id: &str) -> Result<(&mut Vec<Value>, usize), Failure> {
        let items = self.0.get_mut(list).and_then(Value::as_array_mut);
        let found = items.and_then(|items| items.iter().position(|item| item["id"] == id).map(|at| (items, at)));
        found.ok_or_else(|| Failure::Other(format!("no '{id}' among the {list} of the scene")))
    }
}
