//! From a recipe and a seed to a scene: the same bytes on any machine, since only + − × ÷ √ are used.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::arrange;
use super::arrange::Disc;
use super::recipe::{GenerateError, Recipe, rectangle};
use singulate_planner::scene::{
    GoalDraft, ObjectDraft, ObjectIndex, Scene, SceneDraft, SceneLimits, ShapeDraft, TableDraft,
};

/// Make the scene of `recipe` and `seed`. Ids are `o0`, `o1`, ...; all figures are whole micrometres; discs don't
/// overlap and none hangs over the table's edge. The target is the most crowded object.
///
/// # Errors
/// [`GenerateError`]; if the table is too full, with the number of objects that fitted.
pub fn generate(recipe: &Recipe, seed: u64) -> Result<SceneDraft, GenerateError> {
    recipe.check()?;
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let discs = arrange::discs(recipe, &mut random)?;
    let draft = draft(recipe, &discs);
    // These limits don't matter here: the reader of the scene has its own.
    let limits = SceneLimits { max_objects: usize::MAX, max_neighbours: usize::MAX - 2, ..SceneLimits::default() };
    let (scene, _) = Scene::new(draft.clone(), &limits).map_err(GenerateError::Scene)?;
    let target = most_crowded(&scene);
    let mut draft = SceneDraft { goal: draft.objects[target.get()].id.clone().map(GoalDraft::Target), ..draft };
    for (at, object) in draft.objects.iter_mut().enumerate() {
        let drawn: f64 = random.random();
        object.fixed = drawn < recipe.fixed_share && at != target.get();
    }
    Ok(draft)
}

fn draft(recipe: &Recipe, discs: &[Disc]) -> SceneDraft {
    let object = |(at, disc): (usize, &Disc)| ObjectDraft {
        id: Some(format!("o{at}")),
        x: Some(disc.centre.x),
        y: Some(disc.centre.y),
        shape: ShapeDraft::disc(disc.radius),
        fixed: false,
    };
    let (min, max) = recipe.corners();
    SceneDraft {
        table: TableDraft { top: rectangle(min, max), keep_out: Vec::new() },
        gripper: recipe.gripper,
        objects: discs.iter().enumerate().map(object).collect(),
        goal: Some(GoalDraft::Target("o0".to_owned())),
        ..SceneDraft::default()
    }
}

/// The object with the most neighbours in reach of its grasp; ties go to the one with the closest neighbours.
fn most_crowded(scene: &Scene) -> ObjectIndex {
    let crowd = |index: ObjectIndex| {
        let footprint = scene.object(index).footprint();
        let reach = scene.gripper().reach(&footprint);
        let mut gaps: Vec<f64> = scene
            .index()
            .within(footprint.at(), reach)
            .filter(|(other, _)| *other != index)
            .map(|(_, other)| other.gap(&footprint))
            .collect();
        // Sums depend on the order of their terms, and the index gives them in no fixed order.
        gaps.sort_unstable_by(f64::total_cmp);
        (gaps.len(), gaps.iter().sum::<f64>())
    };
    let mut best = (ObjectIndex::new(0), crowd(ObjectIndex::new(0)));
    for index in scene.indices().skip(1) {
        let (count, gaps) = crowd(index);
        if count > best.1.0 || (count == best.1.0 && gaps < best.1.1) {
            best = (index, (count, gaps));
        }
    }
    best.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiments::recipe::Crowding;
    use singulate_planner::scene::GripperDraft;

    fn scene(recipe: &Recipe, seed: u64) -> Scene {
        Scene::new(generate(recipe, seed).unwrap(), &SceneLimits { overlap_tolerance: 0.0, ..SceneLimits::default() })
            .unwrap()
            .0
    }

    fn least_gaps(scene: &Scene) -> impl Iterator<Item = f64> + '_ {
        scene.indices().map(|one| {
            let others = scene.indices().filter(move |&other| other != one);
            let gap = |other| scene.object(one).footprint().gap(&scene.object(other).footprint());
            others.map(gap).fold(f64::INFINITY, f64::min)
        })
    }

    #[test]
    fn loose_discs_stand_apart_and_on_the_table() {
        for seed in 0..20 {
            let scene = scene(&Recipe { origin: (-3.0, 7.0), radius: (0.02, 0.09), ..Recipe::default() }, seed);
            assert!(least_gaps(&scene).all(|gap| gap >= 0.0));
            assert!(scene.objects().iter().all(|object| object.footprint().gap_inside(&scene.table().top()) >= 0.0));
        }
    }

    #[test]
    fn pressed_discs_stand_within_two_millimetres_of_another() {
        for radius in [(0.05, 0.05), (0.02, 0.08)] {
            let recipe =
                Recipe { objects: 60, table: (2.0, 2.0), radius, arrangement: Crowding::Pressed, ..Recipe::default() };
            let scene = scene(&recipe, 3);
            assert!(least_gaps(&scene).all(|gap| (0.0..0.002_01).contains(&gap)));
        }
    }

    #[test]
    fn the_papers_fullest_tables_fit() {
        for seed in 0..10 {
            scene(&Recipe { objects: 20, ..Recipe::default() }, seed);
            scene(&Recipe { objects: 25, table: (1.4, 0.7), ..Recipe::default() }, seed);
        }
    }

    #[test]
    fn a_table_too_full_says_how_many_fitted_and_so_many_do() {
        for arrangement in [Crowding::Loose, Crowding::Pressed] {
            let recipe = Recipe { objects: 60, arrangement, ..Recipe::default() };
            let Err(GenerateError::TooFull { fitted, wanted: 60 }) = generate(&recipe, 0) else { panic!("60 fit") };
            assert!((15..60).contains(&fitted), "{fitted}");
            assert!(generate(&Recipe { objects: fitted, ..recipe }, 0).is_ok());
        }
    }

    #[test]
    fn the_target_stands_in_the_closest_crowd_and_is_never_fixed() {
        let recipe = Recipe { fixed_share: 1.0, arrangement: Crowding::Pressed, ..Recipe::default() };
        let recipe = Recipe { table: (2.0, 2.0), ..recipe };
        let scene = scene(&recipe, 1);
        assert_eq!(scene.objects().iter().filter(|object| !object.fixed()).count(), 1);
        let target = scene.object(scene.target().unwrap());
        assert!(!target.fixed());
        let reach = scene.gripper().corner_distance(&target.footprint());
        assert!(scene.index().within(target.footprint().at(), reach).count() > 5);
    }

    #[test]
    fn a_recipe_that_makes_no_sense_is_refused() {
        let sound = Recipe::default();
        let refused = [
            Recipe { objects: 0, ..sound },
            Recipe { radius: (0.2, 0.1), ..sound },
            Recipe { radius: (f64::NAN, 0.1), ..sound },
            Recipe { fixed_share: 1.5, ..sound },
            Recipe { table: (-1.0, 1.0), ..sound },
            Recipe { pressed_gap: -0.001, ..sound },
            Recipe { origin: (f64::INFINITY, 0.0), ..sound },
        ];
        for recipe in refused {
            assert!(matches!(generate(&recipe, 0), Err(GenerateError::Recipe(_))), "{recipe:?}");
        }
        let gripper = GripperDraft { fingers: Some(99.0), ..sound.gripper };
        assert!(matches!(generate(&Recipe { gripper, ..sound }, 0), Err(GenerateError::Scene(_))));
    }

    #[test]
    fn ten_thousand_discs_are_generated_as_well() {
        let table = (1.2 * 25.0, 0.7 * 25.0);
        for arrangement in [Crowding::Loose, Crowding::Pressed] {
            let recipe = Recipe { objects: 10_000, table, arrangement, ..Recipe::default() };
            assert_eq!(scene(&recipe, 0).objects().len(), 10_000);
        }
    }
}
