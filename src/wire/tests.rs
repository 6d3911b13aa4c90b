//! Bad inputs with their pointers, and answers with their fields.

mod answers;
mod drop_offs;
mod edits;
mod malformed;
mod noise;
mod requests;
mod shape_faults;
mod shapes;
mod slips;
mod typed;
mod walk;
mod wanted;

use serde_json::{Value, json};

use super::*;

fn scene() -> Value {
    json!({
        "scene_id": "cell-4/17",
        "table": {"x_min": 0, "y_min": 0, "x_max": 1.2, "y_max": 0.7},
        "gripper": {"fingers": 3.0, "finger_width": 0.02, "clearance": 0.05},
        "objects": [
            {"id": "a", "x": 0.3, "y": 0.2, "radius": 0.075},
            {"id": "b", "x": 0.6, "y": 0.2, "radius": 0.075},
            {"id": "vase", "x": 0.9, "y": 0.5, "radius": 0.05, "fixed": true}
        ],
        "target": "a"
    })
}

/// The scene with the value at `pointer` replaced or added.
fn with(pointer: &str, value: Value) -> Value {
    let mut body = scene();
    let (parent, name) = pointer.rsplit_once('/').unwrap();
    let parent = body.pointer_mut(parent).unwrap();
    match parent {
        Value::Array(items) => items[name.parse::<usize>().unwrap()] = value,
        _ => parent[name] = value,
    }
    body
}

fn without(pointer: &str) -> Value {
    let mut body = scene();
    let (parent, name) = pointer.rsplit_once('/').unwrap();
    body.pointer_mut(parent).unwrap().as_object_mut().unwrap().remove(name);
    body
}

fn read(body: &str) -> Result<PlanRequest, Problem> {
    read_scene(body.as_bytes(), &RequestLimits::default())
}

/// Assert the codes and pointers of the problem's faults.
#[track_caller]
fn has_faults(problem: &Problem, expected: &[(&str, &str)]) {
    let faults = problem.errors().iter().map(|error| (error.code.to_string(), error.pointer.clone()));
    let expected: Vec<_> = expected.iter().map(|&(code, pointer)| (code.to_owned(), pointer.to_owned())).collect();
    assert_eq!(faults.collect::<Vec<_>>(), expected, "{problem}");
}
