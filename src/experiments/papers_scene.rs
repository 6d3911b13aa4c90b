//! A scene of one of the paper's cases, with its target.

use core::cmp::Reverse;
use core::time::Duration;

use super::error::{EpisodeError, ExperimentError};
use super::generate::generate;
use super::papers_cases::PapersCase;
use super::recipe::GenerateError;
use super::workers::Patience;
use singulate_planner::budget::{Budget, Clock};
use singulate_planner::knowledge::{KnowledgeBase, complete};
use singulate_planner::paper::GraspModelName;
use singulate_planner::scene::{ObjectIndex, Scene, SceneLimits};

/// The distance between the seeds of two columns, since columns with the same table would otherwise share scenes.
const COLUMN_SEEDS: u64 = 1_000_000;

/// A scene to search and plan for.
#[derive(Debug)]
pub(super) struct PapersScene {
    pub(super) scene: Scene,
    pub(super) target: ObjectIndex,
    /// The complete base by the sector model.
    pub(super) sector: KnowledgeBase,
    /// The time for the base.
    pub(super) knowledge: Duration,
}

/// The seed of an episode: `singulate generate` makes the same discs from it, with another target.
pub(super) fn seed_of(seed: u64, column: usize, episode: usize) -> u64 {
    seed.wrapping_add(column as u64 * COLUMN_SEEDS).wrapping_add(episode as u64)
}

/// The scene of one seed. Its target is the object with the largest G_min, the least number of obstacles at any yaw, by
/// the paper's sector model; ties go to the first.
pub(super) fn papers_scene(
    case: &PapersCase,
    seed: u64,
    patience: &Patience<'_>,
) -> Result<PapersScene, ExperimentError> {
    let no_scene = |error| ExperimentError { objects: case.objects, seed, cause: EpisodeError::Scene(error) };
    let draft = generate(&case.recipe(), seed).map_err(no_scene)?;
    let (scene, _) =
        Scene::new(draft, &SceneLimits::default()).map_err(|findings| no_scene(GenerateError::Scene(findings)))?;
    let watch = patience.watch();
    let sector = complete_base(case, seed, &scene, GraspModelName::Sector, &watch)?;
    let knowledge = watch.elapsed();
    let target = hardest(&sector);
    let scene = scene.with_target(target).expect("nothing is fixed in the paper's cases");
    Ok(PapersScene { scene, target, sector, knowledge })
}

/// The base of all objects, without a time limit: it is not part of the measured times.
pub(super) fn complete_base(
    case: &PapersCase,
    seed: u64,
    scene: &Scene,
    model: GraspModelName,
    watch: &dyn Clock,
) -> Result<KnowledgeBase, ExperimentError> {
    complete(scene, model.model(), &Budget::new(watch, Duration::MAX)).map_err(|error| ExperimentError {
        objects: case.objects,
        seed,
        cause: EpisodeError::Knowledge(error),
    })
}

fn hardest(base: &KnowledgeBase) -> ObjectIndex {
    let g_min = |object: ObjectIndex| base.options(object).map(<[_]>::len).min().unwrap_or_default();
    // Ties go to the first; `max_by_key` would give the last.
    base.objects().min_by_key(|object| Reverse(g_min(*object))).expect("the paper's cases have objects")
}

#[cfg(test)]
mod tests {
    use core::sync::atomic::AtomicBool;

    use super::*;
    use crate::experiments::PAPERS_CASES;
    use singulate_planner::paper::PolarHistogram;

    #[test]
    fn the_target_is_the_first_object_with_the_largest_g_min() {
        let patience = Patience { limit: Duration::MAX, failed: &AtomicBool::new(false) };
        let mut obstacles = 0;
        for (column, case) in PAPERS_CASES.iter().enumerate() {
            let scene = papers_scene(case, seed_of(7, column, 0), &patience).unwrap().scene;
            let g_min = |object| {
                let sets = PolarHistogram::around(&scene, object).local_sets();
                sets.iter().map(Vec::len).min().unwrap()
            };
            let largest = scene.indices().map(g_min).max().unwrap();
            obstacles += largest;
            assert_eq!(scene.indices().find(|object| g_min(*object) == largest), scene.target());
            assert_eq!(scene.objects().len(), case.objects);
        }
        assert!(obstacles > 6, "{obstacles}");
    }

    #[test]
    fn no_two_episodes_share_a_seed() {
        assert_eq!((seed_of(5, 0, 3), seed_of(5, 2, 3)), (8, 2_000_008));
        assert_eq!(seed_of(u64::MAX, 0, 2), 1);
    }
}
