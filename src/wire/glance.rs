//! Pre-parse: scene_id, target and time limit only, so that a time-out can be answered before the body is validated.

use core::time::Duration;
use std::borrow::Cow;

use serde::Deserialize;

use super::limits::{MAX_SCENE_ID_LENGTH, RequestLimits};

/// The pre-parsed fields of a planning or verification request. Faults are reported by the reader; here a body with a
/// field of a wrong type, or a repeated field, shows nothing.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Glance {
    /// The caller's id for the scene.
    pub scene_id: Option<String>,
    /// The id of the target.
    pub target: Option<String>,
    /// The time limit, queuing included.
    pub time_limit: Duration,
}

#[derive(Default, Deserialize)]
struct Body<'a> {
    #[serde(borrow, default)]
    scene_id: Option<Cow<'a, str>>,
    #[serde(borrow, default)]
    target: Option<Cow<'a, str>>,
    #[serde(default)]
    settings: Option<GlancedSettings>,
    /// The scene of a verification, which is nested.
    #[serde(borrow, default)]
    scene: Option<Box<Body<'a>>>,
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
        let Body { scene_id, target, settings, .. } = body;
        let stated = settings.and_then(|settings| settings.time_limit_ms).filter(|ms| *ms >= 1.0);
        let stated = stated.and_then(|ms| Duration::try_from_secs_f64(ms / 1000.0).ok());
        let scene_id = scene_id.filter(|id| id.chars().count() <= MAX_SCENE_ID_LENGTH);
        Self {
            scene_id: scene_id.map(Cow::into_owned),
            target: target.map(Cow::into_owned),
            time_limit: stated.unwrap_or(limits.default_time_limit).min(limits.max_time_limit),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(body: &str, scene_id: Option<&str>, target: Option<&str>, ms: u64) {
        let glance = Glance::at(body.as_bytes(), &RequestLimits::default());
        assert_eq!((glance.scene_id.as_deref(), glance.target.as_deref()), (scene_id, target), "{body}");
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
    fn a_faulty_field_counts_as_absent() {
        check("", None, None, 1000);
        check(r#"{"target": 5}"#, None, None, 1000);
        check(r#"{"target": "cup", "settings": {"time_limit_ms": -1}}"#, None, Some("cup"), 1000);
        check(r#"{"target": "cup", "settings": {"time_limit_ms": 1e300}}"#, None, Some("cup"), 1000);
        check(r#"{"target": "cup", "settings": {"time_limit_ms": 1e9}}"#, None, Some("cup"), 60_000);
    }
}
