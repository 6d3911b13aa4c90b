//! The paper's scenes.

use singulate::experiments::{Recipe, generate};
use singulate_planner::budget::Budget;
use singulate_planner::knowledge::{SweptFinger, complete};
use singulate_planner::scene::{ObjectIndex, Scene, SceneLimits};

/// The paper's Case II with 50 objects: 1.4 × 1.4 m, the target the object with the largest least option.
pub(crate) fn paper_50(seed: u64) -> Scene {
    let recipe = Recipe { objects: 50, table: (1.4, 1.4), ..Recipe::default() };
    let draft = generate(&recipe, seed).expect("fits");
    let (scene, _) = Scene::new(draft, &SceneLimits::default()).expect("a sound scene");
    let base = complete(&scene, &SweptFinger, &Budget::unlimited()).expect("small");
    let least = |object: &ObjectIndex| base.options(*object).map(<[_]>::len).min();
    let hardest = scene.indices().max_by_key(least).expect("not empty");
    scene.with_target(hardest).expect("nothing is fixed")
}
