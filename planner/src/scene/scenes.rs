//! A builder of scenes for unit tests.

use super::{
    Destination, DropOffDraft, GoalDraft, GripperDraft, ObjectDraft, RectangleDraft, Scene, SceneDraft, SceneLimits,
    ShapeDraft,
};

/// The builder. By default: a table of 2 × 2 m, fingers 0.02 m wide, a clearance of 0.05 m.
#[derive(Clone)]
pub(crate) struct TestScene(SceneDraft);

fn rectangle([x_min, y_min, x_max, y_max]: [f64; 4]) -> RectangleDraft {
    RectangleDraft { x_min: Some(x_min), y_min: Some(y_min), x_max: Some(x_max), y_max: Some(y_max) }
}

impl TestScene {
    pub(crate) fn new(fingers: u32) -> Self {
        let gripper = GripperDraft {
            fingers: Some(f64::from(fingers)),
            finger_width: Some(0.02),
            clearance: Some(0.05),
            margin: Some(0.0),
            yaw_tolerance: Some(0.0),
            ..GripperDraft::default()
        };
        Self(SceneDraft { gripper, ..SceneDraft::default() }).table(2.0, 2.0)
    }

    pub(crate) fn table(mut self, width: f64, height: f64) -> Self {
        self.0.table.top = rectangle([0.0, 0.0, width, height]);
        self
    }

    pub(crate) fn keep_out(mut self, sides: [f64; 4]) -> Self {
        self.0.table.keep_out.push(rectangle(sides));
        self
    }

    pub(crate) fn finger(mut self, width: f64, clearance: f64) -> Self {
        self.0.gripper = GripperDraft { finger_width: Some(width), clearance: Some(clearance), ..self.0.gripper };
        self
    }

    pub(crate) fn yaw_tolerance(mut self, tolerance: f64) -> Self {
        self.0.gripper.yaw_tolerance = Some(tolerance);
        self
    }

    /// The object `id` can't be moved.
    pub(crate) fn fix(mut self, id: &str) -> Self {
        let object = self.0.objects.iter_mut().find(|object| object.id.as_deref() == Some(id));
        object.expect("an object of the scene").fixed = true;
        self
    }

    pub(crate) fn margin(mut self, margin: f64) -> Self {
        self.0.gripper.margin = Some(margin);
        self
    }

    pub(crate) fn disc(self, id: &str, x: f64, y: f64, radius: f64) -> Self {
        let object = ObjectDraft {
            id: Some(id.into()),
            x: Some(x),
            y: Some(y),
            shape: ShapeDraft::disc(radius),
            ..Default::default()
        };
        self.object(object)
    }

    pub(crate) fn object(mut self, object: ObjectDraft) -> Self {
        self.0.objects.push(object);
        self
    }

    /// A rectangle of `length` by `width` at (x, y), turned by `yaw`.
    pub(crate) fn rectangle(self, id: &str, [x, y, yaw]: [f64; 3], [length, width]: [f64; 2]) -> Self {
        let shape = ShapeDraft::Rectangle { length: Some(length), width: Some(width), corner_radius: None };
        let (id, yaw) = (Some(id.into()), Some(yaw));
        self.object(ObjectDraft { id, x: Some(x), y: Some(y), yaw, shape, ..ObjectDraft::default() })
    }

    /// A hand with a palm.
    pub(crate) fn palm(mut self, finger_length: f64, radius: f64) -> Self {
        let (finger_length, palm_radius) = (Some(finger_length), Some(radius));
        self.0.gripper = GripperDraft { finger_length, palm_radius, ..self.0.gripper };
        self
    }

    /// The object `id` is so high.
    pub(crate) fn height(mut self, id: &str, height: f64) -> Self {
        let object = self.0.objects.iter_mut().find(|object| object.id.as_deref() == Some(id));
        object.expect("an object of the scene").height = Some(height);
        self
    }

    pub(crate) fn max_opening(mut self, opening: f64) -> Self {
        self.0.gripper.max_opening = Some(opening);
        self
    }

    pub(crate) fn tip_height(mut self, height: f64) -> Self {
        self.0.gripper.tip_height = Some(height);
        self
    }

    /// Adds the discs (x, y, radius) that don't overlap an earlier one, as d0, d1 and so on by their positions in the
    /// list.
    pub(crate) fn scatter(mut self, discs: &[(f64, f64, f64)]) -> Self {
        for (at, &(x, y, radius)) in discs.iter().enumerate() {
            let apart = |other: &ObjectDraft| {
                let (dx, dy) = (other.x.unwrap_or_default() - x, other.y.unwrap_or_default() - y);
                (dx * dx + dy * dy).sqrt() - other.shape.disc_radius().unwrap_or_default() - radius
            };
            if self.0.objects.iter().all(|other| apart(other) >= 0.0) {
                self = self.disc(&format!("d{at}"), x, y, radius);
            }
        }
        self
    }

    pub(crate) fn drop_off(mut self, id: &str, capacity: Option<u32>, accepts: Option<&[&str]>) -> Self {
        let accepts = accepts.map(|ids| ids.iter().map(|id| Some((*id).to_owned())).collect());
        let drop_off = DropOffDraft { id: Some(id.into()), capacity: capacity.map(f64::from), accepts };
        self.0.drop_offs.get_or_insert_default().push(drop_off);
        self
    }

    pub(crate) fn destination(mut self, destination: Destination) -> Self {
        self.0.destination = Some(destination);
        self
    }

    pub(crate) fn build(self, target: &str) -> Scene {
        self.with_goal(GoalDraft::Target(target.into()))
    }

    pub(crate) fn with_goal(mut self, goal: GoalDraft) -> Scene {
        self.0.goal = Some(goal);
        Scene::new(self.0, &SceneLimits::default()).expect("a scene that holds").0
    }
}
