//! The scenes that more than one bench takes.

use singulate::experiments::{Recipe, generate};
use singulate_planner::scene::{Scene, SceneDraft, SceneLimits};

/// The scene of a draft.
pub(crate) fn scene(draft: SceneDraft) -> Scene {
    Scene::new(draft, &SceneLimits::default()).expect("a sound scene").0
}

/// `objects` of the paper's dishes on a table that they fill to 45 %.
pub(crate) fn equal_density(objects: usize, seed: u64) -> SceneDraft {
    let side = (count(objects) * 0.075 * 0.075 * core::f64::consts::PI / 0.45).sqrt();
    generate(&Recipe { objects, table: (side, side), ..Recipe::default() }, seed).expect("fits")
}

/// As a float.
pub(crate) fn count(objects: usize) -> f64 {
    f64::from(u32::try_from(objects).expect("a small count"))
}
