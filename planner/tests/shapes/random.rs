//! Random shapes, hands and scenes of two or more objects.

use proptest::prelude::*;
use singulate_planner::scene::{
    GoalDraft, GraspDraft, GripperDraft, ObjectDraft, RectangleDraft, Scene, SceneDraft, SceneLimits, ShapeDraft,
    TableDraft,
};

/// From 5 mm to 0.2 m.
fn length() -> impl Strategy<Value = f64> {
    0.005..0.2_f64
}

/// Shapes of every kind.
pub(crate) fn shape() -> impl Strategy<Value = ShapeDraft> {
    prop_oneof![
        length().prop_map(ShapeDraft::disc),
        (length(), 0.0..0.3_f64)
            .prop_map(|(radius, more)| ShapeDraft::Capsule { length: Some(2.0 * radius + more), radius: Some(radius) }),
        (length(), length(), 0.0..1.0_f64).prop_map(|(length, width, share)| ShapeDraft::Rectangle {
            length: Some(length),
            width: Some(width),
            corner_radius: Some(if share < 0.3 { 0.0 } else { (share - 0.3) * length.min(width) / 2.0 }),
        }),
        (proptest::collection::vec((-0.15..0.15_f64, -0.15..0.15_f64), 3..9), prop_oneof![Just(0.0), 0.0..0.05_f64])
            .prop_map(|(points, radius)| ShapeDraft::Polygon {
                points: points.into_iter().map(|(x, y)| [Some(x), Some(y)]).collect(),
                corner_radius: Some(radius),
            }),
    ]
}

pub(crate) fn gripper() -> impl Strategy<Value = GripperDraft> {
    (2_u32..=6, 0.002..0.05_f64, 0.005..0.08_f64, prop_oneof![Just(0.0), 0.0..0.01_f64]).prop_map(
        |(fingers, width, clearance, margin)| GripperDraft {
            fingers: Some(f64::from(fingers)),
            finger_width: Some(width),
            clearance: Some(clearance),
            margin: Some(margin),
            yaw_tolerance: Some(0.0),
            ..GripperDraft::default()
        },
    )
}

/// An object at (x, y), turned by `yaw`.
pub(crate) fn object(
    id: &str,
    [x, y, yaw]: [f64; 3],
    shape: ShapeDraft,
    grasps: Option<Vec<GraspDraft>>,
) -> ObjectDraft {
    let id = Some(id.to_owned());
    ObjectDraft { id, x: Some(x), y: Some(y), yaw: Some(yaw), shape, grasps, ..ObjectDraft::default() }
}

/// A scene on a table of 6 × 6 m round the origin, where objects may overlap; `None` where the target can't be grasped.
pub(crate) fn scene(gripper: GripperDraft, objects: Vec<ObjectDraft>) -> Option<Scene> {
    let side = |at: f64| Some(at);
    let top = RectangleDraft { x_min: side(-3.0), y_min: side(-3.0), x_max: side(3.0), y_max: side(3.0) };
    let goal = Some(GoalDraft::Target("t".into()));
    let table = TableDraft { top, keep_out: Vec::new() };
    let draft = SceneDraft { table, gripper, objects, goal, ..SceneDraft::default() };
    let limits = SceneLimits { overlap_tolerance: 10.0, ..SceneLimits::default() };
    Scene::new(draft, &limits).ok().map(|(scene, _)| scene)
}

/// A grasp over the origin of the object's frame.
pub(crate) fn over_the_origin() -> GraspDraft {
    GraspDraft { yaw: Some(0.0), ..GraspDraft::default() }
}
