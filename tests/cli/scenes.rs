//! Scenes whose answer one can see.

/// One cup alone.
pub(crate) const ALONE: &str = r#"{"scene_id": "alone", "table": {"x_min": 0, "y_min": 0, "x_max": 1, "y_max": 1},
    "gripper": {"fingers": 3, "finger_width": 0.02, "clearance": 0.05},
    "objects": [{"id": "cup", "x": 0.5, "y": 0.5, "radius": 0.05}], "target": "cup"}"#;

/// Three plates and a fixed vase round a cup: two plates have to go.
pub(crate) const CROWD: &str = include_str!("../../src/cli/example.json");

/// Four faults.
pub(crate) const FAULTY: &str = r#"{"table": {"x_min": 0, "y_min": 0, "x_max": 1, "y_max": 1},
    "gripper": {"fingers": 3.5, "finger_width": 0.02, "clearance": "wide"},
    "objects": [{"id": "cup", "x": 0.5, "y": 0.5, "radius": 1e999}], "target": "cup", "colour": 1}"#;
