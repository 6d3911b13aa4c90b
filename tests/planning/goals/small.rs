//! Small random scenes.

use singulate::experiments::{Crowding, Recipe, generate, wanting};
use singulate_planner::scene::{GripperDraft, Scene, SceneDraft, SceneLimits};

/// Three to nine discs of two sizes pressed together, so that some lock each other, with a random goal.
pub(super) fn small(seed: u64) -> Scene {
    let draft = wanting(&pressed(seed), seed);
    Scene::new(draft, &SceneLimits::default()).unwrap().0
}

pub(super) fn pressed(seed: u64) -> SceneDraft {
    let base = Recipe::default();
    let share = |step: u64| f64::from(u32::try_from(seed / step % 8).unwrap()) / 8.0;
    let gripper = GripperDraft {
        fingers: Some(2.0 + f64::from(u32::try_from(seed % 3).unwrap())),
        clearance: Some(0.01 + 0.03 * share(3)),
        finger_width: Some(0.006 + 0.014 * share(5)),
        ..base.gripper
    };
    let recipe = Recipe {
        objects: 3 + usize::try_from(seed % 7).unwrap(),
        table: (0.8, 0.8),
        radius: (0.03, 0.05),
        gripper,
        fixed_share: if seed.is_multiple_of(4) { 0.2 } else { 0.0 },
        arrangement: Crowding::Pressed,
        pressed_gap: 0.002 + 0.02 * share(7),
        ..base
    };
    generate(&recipe, seed).unwrap()
}
