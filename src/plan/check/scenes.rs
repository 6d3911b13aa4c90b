//! Scenes for the tests of this module.

use crate::scene::{GripperDraft, ObjectDraft, RectangleDraft, Scene, SceneDraft, SceneLimits, TableDraft};

/// A scene in the making. Unless told otherwise: a table of 2 × 2 m, fingers 0.02 m wide, a clearance of 0.05 m.
pub(super) struct TestScene(SceneDraft);

impl TestScene {
    pub(super) fn new(fingers: u32) -> Self {
        let gripper = GripperDraft {
            fingers: Some(f64::from(fingers)),
            finger_width: Some(0.02),
            clearance: Some(0.05),
            margin: Some(0.0),
            yaw_tolerance: Some(0.0),
        };
        Self(SceneDraft { gripper, ..SceneDraft::default() }).table(2.0, 2.0)
    }

    pub(super) fn table(mut self, width: f64, height: f64) -> Self {
        let top = RectangleDraft { x_min: Some(0.0), y_min: Some(0.0), x_max: Some(width), y_max: Some(height) };
        self.0.table = TableDraft { top, keep_out: Vec::new() };
        self
    }

    pub(super) fn finger(mut self, width: f64, clearance: f64) -> Self {
        self.0.gripper = GripperDraft { finger_width: Some(width), clearance: Some(clearance), ..self.0.gripper };
        self
    }

    pub(super) fn yaw_tolerance(mut self, tolerance: f64) -> Self {
        self.0.gripper.yaw_tolerance = Some(tolerance);
        self
    }

    /// Those of the discs (x, y, radius) that don't overlap an earlier one, as d0, d1 and so on; d0 is the target.
    pub(super) fn scatter(mut self, discs: &[(f64, f64, f64)]) -> Scene {
        let mut kept: Vec<(f64, f64, f64)> = Vec::new();
        for &(x, y, radius) in discs {
            if kept.iter().all(|&(a, b, r)| (a - x) * (a - x) + (b - y) * (b - y) >= (r + radius) * (r + radius)) {
                self = self.disc(&format!("d{}", kept.len()), x, y, radius);
                kept.push((x, y, radius));
            }
        }
        self.build("d0")
    }

    pub(super) fn disc(mut self, id: &str, x: f64, y: f64, radius: f64) -> Self {
        let object = ObjectDraft { id: Some(id.into()), x: Some(x), y: Some(y), radius: Some(radius), fixed: false };
        self.0.objects.push(object);
        self
    }

    pub(super) fn build(mut self, target: &str) -> Scene {
        self.0.target = Some(target.into());
        Scene::new(self.0, &SceneLimits::default()).expect("a scene that holds").0
    }
}
