//! Pre-parse: scene_id, the kind of goal and time limit only, so that a time-out can be answered before the body is validated.

use core::time::Duration;
use std::borrow::Cow;

use serde::Deserialize;
use serde::de::IgnoredAny;

use super::limits::{MAX_SCENE_ID_LENGTH, RequestLimits};

/// The pre-parsed fields of a planning or verification request. Faults are reported by the reader; here a body with a
/// field of a wrong type, or a repeated field, shows nothing.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Glance {
    /// The caller's id for the scene.
    pub scene_id: Option<String>,
    /// What an answer without a plan says of the target. `None` if nothing shows, and for a clearing: its answer names all that
    /// is left.
    pub target: Option<GlancedTarget>,
    /// The time limit, queuing included.
    pub time_limit: Duration,
}

/// The target, as far as a glance shows it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum GlancedTarget {
    /// The object of this id.
    Named(String),
    /// None: several objects are candidates, or are to be taken away.
    Unnamed,
}

#[derive(Default, Deserialize)]
struct Body<'a> {
    #[serde(borrow, default)]
    scene_id: Option<Cow<'a, str>>,
    #[serde(borrow, default)]
    target: Option<Cow<'a, str>>,
    #[serde(default)]
    goal: Option<GlancedGoal>,
    #[serde(default)]
    settings: Option<GlancedSettings>,
    /// The scene of a verification, which is nested.
    #[serde(borrow, default)]
    scene: Option<Box<Body<'a>>>,
}

#[derive(Deserialize)]
struct GlancedGoal {
    #[serde(default)]
    any_of: Option<IgnoredAny>,
    #[serde(default)]
    all_of: Option<IgnoredAny>,
}

#[derive(Default, Deserialize)]
struct GlancedSettings {
    #[serde(default)]
    time_limit_ms: Option<f64>,
}

impl Glance {
    /// Pre-parse a body.
    pub fn at(body: &[u8], limits: &RequestLimits) -> Self {
        let mut body: Body<'_> = serde_json::from_slice(body).unwrap_or_default();
        if let Some(scene) = body.scene.take() {
            body = *scene;
        }
        let Body { scene_id, target, goal, settings, .. } = body;
        let stated = settings.and_then(|settings| settings.time_limit_ms).filter(|ms| *ms >= 1.0);
        let stated = stated.and_then(|ms| Duration::try_from_secs_f64(ms / 1000.0).ok());
        let scene_id = scene_id.filter(|id| id.chars().count() <= MAX_SCENE_ID_LENGTH);
        Self {
            scene_id: scene_id.map(Cow::into_owned),
            target: GlancedTarget::of(target, goal.as_ref()),
            time_limit: stated.unwrap_or(limits.default_time_limit).min(limits.max_time_limit),
        }
    }
}

impl GlancedTarget {
    fn of(target: Option<Cow<'_, str>>, goal: Option<&GlancedGoal>) -> Option<Self> {
        match (target, goal) {
            (Some(target), None) => Some(Self::Named(target.into_owned())),
            (None, Some(goal)) if goal.any_of.is_some() || goal.all_of.is_some() => Some(Self::Unnamed),
            _ => None,
        }
    }

    /// The target's id.
    pub(super) fn id(&self) -> Option<&str> {
        match self {
            Self::Named(id) => Some(id),
            Self::Unnamed => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn glance(body: &str) -> Glance {
        Glance::at(body.as_bytes(), &RequestLimits::default())
    }

    #[track_caller]
    fn check(body: &str, scene_id: Option<&str>, target: Option<&str>, ms: u64) {
        let glance = glance(body);
        let target = target.map(|id| GlancedTarget::Named(id.to_owned()));
        assert_eq!((glance.scene_id.as_deref(), glance.target), (scene_id, target), "{body}");
        assert_eq!(glance.time_limit, Duration::from_millis(ms), "{body}");
    }

    #[test]
    fn a_glance_shows_the_names_and_the_limit_of_a_scene() {
        let scene =
            r#"{"objects": [{"x": 1e999}], "target": "c\u00fcp", "scene_id": "s", "settings": {"time_limit_ms": 7}}"#;
        check(scene, Some("s"), Some("cüp"), 7);
        check(&format!(r#"{{"plan": {{"target": "other"}}, "scene": {scene}}}"#), Some("s"), Some("cüp"), 7);
        check(r#"{"target": "cup", "scene_id": null, "settings": null}"#, None, Some("cup"), 1000);
    }

    #[test]
    fn a_glance_shows_that_no_target_has_a_name() {
        for (body, shown) in [
            (r#"{"goal": {"any_of": ["a", "b"]}}"#, true),
            (r#"{"goal": {"all_of": ["a"], "clear": null}, "target": null}"#, true),
            (r#"{"scene": {"goal": {"any_of": ["a"]}}, "plan": {"target": "a"}}"#, true),
            (r#"{"goal": {"clear": true}}"#, false),
            (r#"{"goal": {"any_of": null}}"#, false),
            (r#"{"goal": {"any_of": ["a"]}, "target": "a"}"#, false),
            (r#"{"goal": null}"#, false),
        ] {
            assert_eq!(glance(body).target, shown.then_some(GlancedTarget::Unnamed), "{body}");
        }
        check(r#"{"goal": null, "target": "cup"}"#, None, Some("cup"), 1000);
        let limited = glance(r#"{"goal": {"clear": true}, "settings": {"time_limit_ms": 7}}"#);
        assert_eq!(limited.time_limit, Duration::from_millis(7));
    }

    #[test]
    fn a_faulty_field_counts_as_absent() {
        check("", None, None, 1000);
        check(r#"{"target": 5}"#, None, None, 1000);
        check(r#"{"target": "cup", "settings": {"time_limit_ms": -1}}"#, None, Some("cup"), 1000);
        check(r#"{"target": "cup", "settings": {"time_limit_ms": 1e300}}"#, None, Some("cup"), 1000);
        check(r#"{"target": "cup", "settings": {"time_limit_ms": 1e9}}"#, None, Some("cup"), 60_000);
    }
}
