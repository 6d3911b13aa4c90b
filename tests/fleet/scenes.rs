//! What is handed in: the same scenes in every run.

use serde_json::{Value, json};
use singulate::experiments::{Crowding, Recipe, generate};
use singulate::wire::SceneBody;
use singulate_planner::budget::Budget;
use singulate_planner::knowledge::{SweptFinger, complete, derivable};
use singulate_planner::scene::{GoalDraft, GripperDraft, Scene, SceneDraft, SceneLimits};

/// One request for a job.
#[derive(Debug, Clone)]
pub(crate) struct Request {
    /// Its idempotency key, and the caller's name for its scene.
    pub(crate) key: String,
    pub(crate) body: String,
}

impl Request {
    fn new(key: String, draft: SceneDraft, settings: Value, priority: i64) -> Self {
        let scene = Scene::new(draft, &SceneLimits::default()).unwrap().0;
        let mut body = serde_json::to_value(SceneBody::new(&scene, Some(&key))).unwrap();
        body["settings"] = settings;
        body["priority"] = json!(priority);
        Self { key, body: body.to_string() }
    }
}

/// A thousand jobs, less those that a test adds: most take a moment, one in five some tens of milliseconds, so that one
/// runs nearly always.
pub(crate) fn thousand(added: usize) -> Vec<Request> {
    let job = |number: u64| {
        let key = format!("job-{number}");
        if number.is_multiple_of(5) { brief(key, 20 + number % 30) } else { short(key, number) }
    };
    (0..1000).take(1000 - added).map(job).collect()
}

/// A few dishes.
pub(crate) fn short(key: String, seed: u64) -> Request {
    let recipe = Recipe { objects: 6, ..Recipe::default() };
    Request::new(key, generate(&recipe, seed).unwrap(), json!({}), 0)
}

/// One of the paper's searches runs out this time: some tens of milliseconds.
fn brief(key: String, time_limit_ms: u64) -> Request {
    let draft = SceneDraft { goal: Some(GoalDraft::Target("o9".to_owned())), ..pressed(100, 1.618, 0.024) };
    Request::new(key, draft, json!({"search": "lobs", "time_limit_ms": time_limit_ms}), 0)
}

/// Before all others, and longer than it takes to do something to its server: dozens of dishes have to be moved on a
/// table with as many pixels as may be.
pub(crate) fn long(key: String, time_limit_ms: u64) -> Request {
    let mut draft = pressed(5500, 9.9, 0.022);
    draft.goal = Some(GoalDraft::Target(freed_last(&draft)));
    Request::new(key, draft, json!({"placement": "raster", "time_limit_ms": time_limit_ms}), 1)
}

/// A cluster with gaps next to wide enough for four very slim fingers.
fn pressed(objects: usize, side: f64, pressed_gap: f64) -> SceneDraft {
    let gripper = GripperDraft {
        fingers: Some(4.0),
        finger_width: Some(0.008),
        clearance: Some(0.025),
        ..Recipe::default().gripper
    };
    let recipe = Recipe {
        objects,
        table: (side, side),
        radius: (0.04, 0.06),
        gripper,
        arrangement: Crowding::Pressed,
        pressed_gap,
        ..Recipe::default()
    };
    generate(&recipe, 0).unwrap()
}

/// The object that chaining reaches last.
fn freed_last(draft: &SceneDraft) -> String {
    let scene = Scene::new(draft.clone(), &SceneLimits::default()).unwrap().0;
    let base = complete(&scene, &SweptFinger, &Budget::unlimited()).unwrap();
    let closure = derivable(&base, |_| false, &Budget::unlimited()).unwrap();
    scene.object(*closure.order.last().unwrap()).id().to_owned()
}
