//! The scenes that ask the most of the service.

use singulate::experiments::{Crowding, Recipe, generate};
use singulate_planner::budget::Budget;
use singulate_planner::knowledge::{SweptFinger, complete, derivable};
use singulate_planner::scene::{
    GoalDraft, GripperDraft, ObjectDraft, RectangleDraft, SceneDraft, ShapeDraft, TableDraft,
};

use super::cases::{count, scene};

/// `objects` dishes of two sizes in one pressed cluster, for a gripper with four slim fingers.
pub(crate) fn pressed(objects: usize, seed: u64) -> SceneDraft {
    let side = (count(objects) * 0.05 * 0.05 * core::f64::consts::PI / 0.3).sqrt();
    let gripper = GripperDraft { fingers: Some(4.0), finger_width: Some(0.01), ..Recipe::default().gripper };
    let recipe = Recipe {
        objects,
        table: (side, side),
        radius: (0.04, 0.06),
        gripper,
        arrangement: Crowding::Pressed,
        pressed_gap: 0.015,
        ..Recipe::default()
    };
    generate(&recipe, seed).expect("fits")
}

/// A cluster with gaps next to wide enough for four very slim fingers, and a target that LOBS does not get to the end of.
pub(crate) fn too_much_for_lobs() -> SceneDraft {
    let gripper = GripperDraft {
        fingers: Some(4.0),
        finger_width: Some(0.008),
        clearance: Some(0.025),
        ..Recipe::default().gripper
    };
    let recipe = Recipe {
        objects: 100,
        table: (1.618, 1.618),
        radius: (0.04, 0.06),
        gripper,
        arrangement: Crowding::Pressed,
        pressed_gap: 0.024,
        ..Recipe::default()
    };
    SceneDraft { goal: Some(GoalDraft::Target("o9".to_owned())), ..generate(&recipe, 0).expect("fits") }
}

/// With the object as target that chaining reaches last.
pub(crate) fn freed_last(draft: SceneDraft) -> SceneDraft {
    let scene = scene(draft.clone());
    let base = complete(&scene, &SweptFinger, &Budget::unlimited()).expect("within the limits");
    let closure = derivable(&base, |_| false, &Budget::unlimited()).expect("unlimited");
    let last = closure.order.last().expect("not all are locked");
    SceneDraft { goal: Some(GoalDraft::Target(scene.object(*last).id().to_owned())), ..draft }
}

/// With the first object as target that nothing can free.
pub(crate) fn locked(draft: SceneDraft) -> SceneDraft {
    let scene = scene(draft.clone());
    let base = complete(&scene, &SweptFinger, &Budget::unlimited()).expect("within the limits");
    let closure = derivable(&base, |_| false, &Budget::unlimited()).expect("unlimited");
    let stuck = scene.indices().find(|object| !closure.derives(*object)).expect("some are locked");
    SceneDraft { goal: Some(GoalDraft::Target(scene.object(stuck).id().to_owned())), ..draft }
}

/// 10,000 crumbs, all but touching. With a clearance of 16.5 mm a grasp has as many in reach as the limit admits.
pub(crate) fn crumbs(fingers: f64, clearance: f64) -> SceneDraft {
    let pitch = 0.0022;
    let place = |n: u32, shift: u32| 0.01 + pitch * f64::from(n) + 1e-5 * f64::from(shift % 11);
    let crumb = |(i, j): (u32, u32)| ObjectDraft {
        id: Some(format!("c{i}-{j}")),
        x: Some(place(i, 7 * i + 13 * j)),
        y: Some(place(j, 5 * i + 3 * j)),
        shape: ShapeDraft::disc(0.001),
        ..ObjectDraft::default()
    };
    let objects = (0..100).flat_map(|i| (0..100).map(move |j| (i, j))).map(crumb).collect();
    let top = RectangleDraft { x_min: Some(0.0), y_min: Some(0.0), x_max: Some(0.4), y_max: Some(0.4) };
    let gripper = GripperDraft {
        fingers: Some(fingers),
        finger_width: Some(0.0002),
        clearance: Some(clearance),
        ..Recipe::default().gripper
    };
    SceneDraft {
        table: TableDraft { top, keep_out: Vec::new() },
        gripper,
        objects,
        goal: Some(GoalDraft::Target("c50-50".into())),
        ..SceneDraft::default()
    }
}
