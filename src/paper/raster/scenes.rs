//! Scenes for the tests of this module.

use crate::scene::{GripperDraft, ObjectDraft, RectangleDraft, Scene, SceneDraft, SceneLimits};

/// A scene in the making, whose target is `t`. Unless told otherwise: the paper's Case I table and gripper with k fingers.
pub(super) struct TestScene(SceneDraft);

fn rectangle([x_min, y_min, x_max, y_max]: [f64; 4]) -> RectangleDraft {
    RectangleDraft { x_min: Some(x_min), y_min: Some(y_min), x_max: Some(x_max), y_max: Some(y_max) }
}

impl TestScene {
    pub(super) fn new(fingers: u32) -> Self {
        let gripper = GripperDraft {
            fingers: Some(f64::from(fingers)),
            finger_width: Some(0.02),
            clearance: Some(0.05),
            margin: Some(0.0),
            yaw_tolerance: Some(0.0),
        };
        Self(SceneDraft { gripper, target: Some("t".into()), ..SceneDraft::default() }).table(1.2, 0.7)
    }

    pub(super) fn table(mut self, width: f64, height: f64) -> Self {
        self.0.table.top = rectangle([0.0, 0.0, width, height]);
        self
    }

    pub(super) fn keep_out(mut self, sides: [f64; 4]) -> Self {
        self.0.table.keep_out.push(rectangle(sides));
        self
    }

    pub(super) fn margin(mut self, margin: f64) -> Self {
        self.0.gripper.margin = Some(margin);
        self
    }

    pub(super) fn disc(mut self, id: &str, x: f64, y: f64, radius: f64) -> Self {
        let object = ObjectDraft { id: Some(id.into()), x: Some(x), y: Some(y), radius: Some(radius), fixed: false };
        self.0.objects.push(object);
        self
    }

    /// Those of the discs (x, y, radius) that don't overlap an earlier one, named by their number.
    pub(super) fn scatter(mut self, discs: &[(f64, f64, f64)]) -> Self {
        for (at, &(x, y, radius)) in discs.iter().enumerate() {
            let apart = |other: &ObjectDraft| {
                let (dx, dy) = (other.x.unwrap_or_default() - x, other.y.unwrap_or_default() - y);
                (dx * dx + dy * dy).sqrt() - other.radius.unwrap_or_default() - radius
            };
            if self.0.objects.iter().all(|other| apart(other) >= 0.0) {
                self = self.disc(&format!("d{at}"), x, y, radius);
            }
        }
        self
    }

    pub(super) fn build(self) -> Scene {
        Scene::new(self.0, &SceneLimits::default()).expect("a scene that holds").0
    }
}
