//! Goals, drop-offs and openings over HTTP.

mod answers;
mod jobs;
mod late;
mod requests;

use serde_json::{Value, json};

use crate::jobs::crowded;

/// A tray that takes anything.
pub(crate) fn tray() -> Value {
    json!([{"id": "tray"}])
}

/// The scene with this goal in place of its target, and these drop-offs.
pub(crate) fn wanting(mut scene: Value, goal: Value, drop_offs: Value) -> Value {
    scene.as_object_mut().unwrap().remove("target");
    scene["goal"] = goal;
    scene["drop_offs"] = drop_offs;
    scene
}

/// A cup among three plates and a fixed vase, to be cleared by way of a tray.
pub(crate) fn clearing() -> Value {
    wanting(crowded(), json!({"clear": true}), tray())
}

/// A scene of the client examples.
fn example(name: &str) -> Value {
    let text = match name {
        "deadlock" => include_str!("../../../client-examples/scenes/deadlock.json"),
        "no-space" => include_str!("../../../client-examples/scenes/no-space.json"),
        other => panic!("{other}"),
    };
    serde_json::from_str(text).unwrap()
}
