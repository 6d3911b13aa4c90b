//! From a recipe and a seed to a scene: the same bytes on any machine, since only + − × ÷ √ are used.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::arrange;
use super::arrange::Disc;
use super::recipe::{GenerateError, Recipe, Wanted, rectangle};
use singulate_planner::scene::{
    GoalDraft, ObjectDraft, ObjectIndex, Scene, SceneDraft, SceneLimits, ShapeDraft, TableDraft,
};

/// Make the scene of `recipe` and `seed`. Ids are `o0`, `o1`, ...; all figures are whole micrometres; discs don't
/// overlap and none hangs over the table's edge. What the goal names are the most crowded objects that fit it.
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
    let named = named(recipe, &scene)?;
    let mut draft = SceneDraft { goal: Some(goal(recipe.wanted, &scene, &named)), ..draft };
    for (at, object) in draft.objects.iter_mut().enumerate() {
        let drawn: f64 = random.random();
        object.fixed = drawn < recipe.fixed_share && !named.contains(&ObjectIndex::new(at));
    }
    Ok(draft)
}

/// The scene before its goal is known: any object may be wanted.
fn draft(recipe: &Recipe, discs: &[Disc]) -> SceneDraft {
    let object = |(at, disc): (usize, &Disc)| ObjectDraft {
        id: Some(format!("o{at}")),
        x: Some(disc.centre.x),
        y: Some(disc.centre.y),
        shape: ShapeDraft::disc(disc.radius),
        ..ObjectDraft::default()
    };
    let (min, max) = recipe.corners();
    let objects: Vec<ObjectDraft> = discs.iter().enumerate().map(object).collect();
    SceneDraft {
        table: TableDraft { top: rectangle(min, max), keep_out: Vec::new() },
        gripper: recipe.gripper,
        goal: Some(GoalDraft::AnyOf(objects.iter().map(|object| object.id.clone()).collect())),
        objects,
        drop_offs: (!recipe.drop_offs.is_empty()).then(|| recipe.drop_offs.clone()),
        destination: recipe.destination,
    }
}

/// The objects that the goal names, the most crowded first.
fn named(recipe: &Recipe, scene: &Scene) -> Result<Vec<ObjectIndex>, GenerateError> {
    let Some(wanted) = recipe.wanted.count() else { return Ok(Vec::new()) };
    let goes = |object: &ObjectIndex| !matches!(recipe.wanted, Wanted::AllOf(_)) || scene.object(*object).accepted();
    let fit = scene.indices().filter(|&object| scene.object(object).can_be_grasped()).filter(goes);
    let mut crowds: Vec<_> = fit.map(|object| (object, crowd(scene, object))).collect();
    if crowds.len() < wanted {
        return Err(GenerateError::TooFewFit { fit: crowds.len(), wanted });
    }
    crowds.sort_by(|(_, one), (_, other)| other.0.cmp(&one.0).then(one.1.total_cmp(&other.1)));
    Ok(crowds.into_iter().take(wanted).map(|(object, _)| object).collect())
}

/// The number of neighbours in reach of a grasp, and their distances in all: of two crowds of as many, that with less
/// distance is the closer one.
fn crowd(scene: &Scene, index: ObjectIndex) -> (usize, f64) {
    let footprint = scene.object(index).footprint();
    let reach = scene.object(index).reach(scene.gripper());
    let mut gaps: Vec<f64> = scene
        .index()
        .within(footprint.at(), reach)
        .filter(|(other, _)| *other != index)
        .map(|(_, other)| other.gap(footprint))
        .collect();
    // Sums depend on the order of their terms, and the index gives them in no fixed order.
    gaps.sort_unstable_by(f64::total_cmp);
    (gaps.len(), gaps.iter().sum::<f64>())
}

fn goal(wanted: Wanted, scene: &Scene, named: &[ObjectIndex]) -> GoalDraft {
    let id = |&object: &ObjectIndex| scene.object(object).id().to_owned();
    let ids = || named.iter().map(|object| Some(id(object))).collect();
    match wanted {
        Wanted::Target => GoalDraft::Target(named.first().map(id).unwrap_or_default()),
        Wanted::AnyOf(_) => GoalDraft::AnyOf(ids()),
        Wanted::AllOf(_) => GoalDraft::AllOf(ids()),
        Wanted::Clear => GoalDraft::Clear,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiments::recipe::Crowding;
    use singulate_planner::scene::{DropOffDraft, Goal, GripperDraft};

    fn scene(recipe: &Recipe, seed: u64) -> Scene {
        Scene::new(generate(recipe, seed).unwrap(), &SceneLimits { overlap_tolerance: 0.0, ..SceneLimits::default() })
            .unwrap()
            .0
    }

    fn least_gaps(scene: &Scene) -> impl Iterator<Item = f64> + '_ {
        scene.indices().map(|one| {
            let others = scene.indices().filter(move |&other| other != one);
            let gap = |other| scene.object(one).footprint().gap(scene.object(other).footprint());
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
        let reach = scene.gripper().corner_distance(target.footprint());
        assert!(scene.index().within(target.footprint().at(), reach).count() > 5);
    }

    #[test]
    fn a_recipe_that_makes_no_sense_is_refused() {
        let sound = Recipe::default();
        let tray = DropOffDraft { id: Some("tray".to_owned()), ..DropOffDraft::default() };
        let refused = [
            Recipe { objects: 0, ..sound.clone() },
            Recipe { radius: (0.2, 0.1), ..sound.clone() },
            Recipe { radius: (f64::NAN, 0.1), ..sound.clone() },
            Recipe { fixed_share: 1.5, ..sound.clone() },
            Recipe { table: (-1.0, 1.0), ..sound.clone() },
            Recipe { pressed_gap: -0.001, ..sound.clone() },
            Recipe { wanted: Wanted::AnyOf(0), ..sound.clone() },
            Recipe { wanted: Wanted::AllOf(0), drop_offs: vec![tray], ..sound.clone() },
            Recipe { wanted: Wanted::AllOf(1), ..sound.clone() },
            Recipe { wanted: Wanted::Clear, ..sound.clone() },
            Recipe { origin: (f64::INFINITY, 0.0), ..sound.clone() },
        ];
        for recipe in refused {
            assert!(matches!(generate(&recipe, 0), Err(GenerateError::Recipe(_))), "{recipe:?}");
        }
        let gripper = GripperDraft { fingers: Some(99.0), ..sound.gripper };
        assert!(matches!(generate(&Recipe { gripper, ..sound.clone() }, 0), Err(GenerateError::Scene(_))));
    }

    /// A drop-off that takes these only.
    fn drop_off(accepted: &[&str]) -> DropOffDraft {
        let accepts = Some(accepted.iter().map(|id| Some((*id).to_owned())).collect());
        DropOffDraft { id: Some("tray".to_owned()), capacity: None, accepts }
    }

    #[test]
    fn a_goal_names_the_most_crowded_objects_and_none_of_them_is_fixed() {
        let recipe = Recipe { fixed_share: 1.0, drop_offs: vec![drop_off(&["o1", "o2", "o3"])], ..Recipe::default() };
        let named = |wanted, count| {
            let scene = scene(&Recipe { wanted, ..recipe.clone() }, 2);
            assert_eq!(scene.objects().iter().filter(|object| !object.fixed()).count(), count);
            assert!(scene.goal().named().iter().all(|&object| !scene.object(object).fixed()));
            scene.goal().clone()
        };
        let of = |positions: &[usize]| positions.iter().map(|&at| ObjectIndex::new(at)).collect::<Vec<_>>();
        let Goal::Target(target) = named(Wanted::Target, 1) else { panic!("a target") };
        assert_eq!(named(Wanted::AnyOf(1), 1), Goal::AnyOf(vec![target]));
        let scene = scene(&recipe, 2);
        let mut crowds: Vec<usize> = scene.indices().map(|object| crowd(&scene, object).0).collect();
        let Goal::AnyOf(four) = named(Wanted::AnyOf(4), 4) else { panic!("a choice") };
        let least = four.iter().map(|&object| crowd(&scene, object).0).min();
        crowds.sort_unstable();
        assert_eq!(least, Some(crowds[crowds.len() - 4]));
        assert_eq!(named(Wanted::AllOf(3), 3), Goal::AllOf(of(&[1, 2, 3])), "no drop-off accepts others");
        assert_eq!(named(Wanted::Clear, 0), Goal::Clear);
        let few = generate(&Recipe { wanted: Wanted::AllOf(4), ..recipe.clone() }, 2);
        assert_eq!(few, Err(GenerateError::TooFewFit { fit: 3, wanted: 4 }));
    }

    #[test]
    fn only_what_the_hand_spans_is_wanted() {
        let gripper = GripperDraft { max_opening: Some(0.1), ..Recipe::default().gripper };
        let recipe = Recipe { radius: (0.03, 0.07), gripper, ..Recipe::default() };
        for seed in 0..20 {
            let draft = generate(&Recipe { gripper: Recipe::default().gripper, ..recipe.clone() }, seed).unwrap();
            let fit = draft.objects.iter().filter(|object| object.shape.disc_radius().unwrap() <= 0.05).count();
            let scene = scene(&Recipe { wanted: Wanted::AnyOf(fit), ..recipe.clone() }, seed);
            assert_eq!(scene.goal().named().len(), fit);
            let more = generate(&Recipe { wanted: Wanted::AnyOf(fit + 1), ..recipe.clone() }, seed);
            assert_eq!(more, Err(GenerateError::TooFewFit { fit, wanted: fit + 1 }));
        }
        let narrow = GripperDraft { max_opening: Some(0.01), ..recipe.gripper };
        let none = generate(&Recipe { gripper: narrow, ..recipe }, 0);
        assert!(matches!(none, Err(GenerateError::Scene(_))), "{none:?}");
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
