//! From a recipe and a seed to a scene: the same bytes on any machine, since only + − × ÷ √ take part.

use nalgebra::Point2;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::arrange;
use singulate_planner::scene::{
    Disc, Finding, GripperDraft, LENGTH_RANGE, ObjectDraft, ObjectIndex, RectangleDraft, Scene, SceneDraft,
    SceneLimits, TableDraft,
};

/// How the objects stand.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Arrangement {
    /// Anywhere, evenly.
    #[default]
    Loose,
    /// In one dense cluster, each object up to the recipe's gap from two others.
    Pressed,
}

/// What kind of scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Recipe {
    /// How many objects, the target included.
    pub objects: usize,
    /// Width and height of the table, m.
    pub table: (f64, f64),
    /// The table's lower left corner, m.
    pub origin: (f64, f64),
    /// The least and the greatest radius, m.
    pub radius: (f64, f64),
    /// The gripper.
    pub gripper: GripperDraft,
    /// How likely an object other than the target is fixed, 0 to 1.
    pub fixed_share: f64,
    /// How the objects stand.
    pub arrangement: Arrangement,
    /// The widest gap between an object of a pressed cluster and the two that it was put to, m.
    pub pressed_gap: f64,
}

/// The paper's gripper and its Case I table with 16 objects.
impl Default for Recipe {
    fn default() -> Self {
        let gripper = GripperDraft {
            fingers: Some(3.0),
            finger_width: Some(0.02),
            clearance: Some(0.05),
            margin: Some(0.0),
            yaw_tolerance: Some(0.0),
        };
        Self {
            objects: 16,
            table: (1.2, 0.7),
            origin: (0.0, 0.0),
            radius: (0.075, 0.075),
            gripper,
            fixed_share: 0.0,
            arrangement: Arrangement::Loose,
            pressed_gap: 2e-3,
        }
    }
}

/// No scene can be made from the recipe.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GenerateError {
    /// The table is too full.
    #[error("{fitted} of {wanted} objects fitted on the table")]
    TooFull {
        /// The most that stood on the table in any attempt.
        fitted: usize,
        /// What the recipe asks for.
        wanted: usize,
    },
    /// A figure of the recipe makes no sense.
    #[error("{0}")]
    Recipe(&'static str),
    /// The scene would be refused, by its table or its gripper.
    #[error("{}", .0.iter().map(|finding| finding.flaw.to_string()).collect::<Vec<_>>().join("; "))]
    Scene(Vec<Finding>),
}

/// Make the scene of `recipe` and `seed`. Ids are `o0`, `o1`, ...; all figures are whole micrometres; no two discs overlap
/// and none stands out over the table's edge. The target is the object with the closest crowd round it.
///
/// # Errors
/// [`GenerateError`], with the number of objects that fitted where the table is too full.
pub fn generate(recipe: &Recipe, seed: u64) -> Result<SceneDraft, GenerateError> {
    check(recipe)?;
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let discs = arrange::discs(recipe, &mut random)?;
    let draft = draft(recipe, &discs);
    // Neither limit is this function's affair: who plans for the scene has his own.
    let limits = SceneLimits { max_objects: usize::MAX, max_neighbours: usize::MAX - 2, ..SceneLimits::default() };
    let (scene, _) = Scene::new(draft.clone(), &limits).map_err(GenerateError::Scene)?;
    let target = most_crowded(&scene);
    let mut draft = SceneDraft { target: draft.objects[target.get()].id.clone(), ..draft };
    for (at, object) in draft.objects.iter_mut().enumerate() {
        let drawn: f64 = random.random();
        object.fixed = drawn < recipe.fixed_share && at != target.get();
    }
    Ok(draft)
}

fn check(recipe: &Recipe) -> Result<(), GenerateError> {
    let length = |value: f64| (LENGTH_RANGE.0..=LENGTH_RANGE.1).contains(&value);
    let (least, greatest) = recipe.radius;
    let faults = [
        (recipe.objects == 0, "a scene has at least one object"),
        (!(length(least) && length(greatest)), "a radius is between 1e-6 m and 1e3 m"),
        (least > greatest, "the least radius is above the greatest"),
        (!(0.0..=1.0).contains(&recipe.fixed_share), "the fixed share is between 0 and 1"),
        (!(length(recipe.table.0) && length(recipe.table.1)), "a side of the table is between 1e-6 m and 1e3 m"),
        (!(0.0..=1e3).contains(&recipe.pressed_gap), "the gap is between 0 and 1e3 m"),
        (!(recipe.origin.0.is_finite() && recipe.origin.1.is_finite()), "the origin is not a place"),
    ];
    match faults.into_iter().find(|(wrong, _)| *wrong) {
        Some((_, detail)) => Err(GenerateError::Recipe(detail)),
        None => Ok(()),
    }
}

fn draft(recipe: &Recipe, discs: &[Disc]) -> SceneDraft {
    let object = |(at, disc): (usize, &Disc)| ObjectDraft {
        id: Some(format!("o{at}")),
        x: Some(disc.centre.x),
        y: Some(disc.centre.y),
        radius: Some(disc.radius),
        fixed: false,
    };
    let (min, max) = corners(recipe);
    SceneDraft {
        table: TableDraft { top: rectangle(min, max), keep_out: Vec::new() },
        gripper: recipe.gripper,
        objects: discs.iter().enumerate().map(object).collect(),
        target: Some("o0".to_owned()),
    }
}

/// The table's lower left and upper right corner.
pub(super) fn corners(recipe: &Recipe) -> (Point2<f64>, Point2<f64>) {
    let (x, y) = recipe.origin;
    let micrometres = |x: f64, y: f64| Point2::new(whole_micrometres(x), whole_micrometres(y));
    (micrometres(x, y), micrometres(x + recipe.table.0, y + recipe.table.1))
}

pub(super) fn rectangle(min: Point2<f64>, max: Point2<f64>) -> RectangleDraft {
    RectangleDraft { x_min: Some(min.x), y_min: Some(min.y), x_max: Some(max.x), y_max: Some(max.y) }
}

/// A JSON file with more digits than this is a nuisance to read.
pub(super) fn whole_micrometres(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

/// A number from `least` to `greatest`.
pub(super) fn between(random: &mut ChaCha8Rng, (least, greatest): (f64, f64)) -> f64 {
    let share: f64 = random.random();
    least + share * (greatest - least)
}

/// The object with the most neighbours in reach of its grasp; of several the one whose neighbours stand closest.
fn most_crowded(scene: &Scene) -> ObjectIndex {
    let crowd = |index: ObjectIndex| {
        let disc = scene.object(index).disc();
        let reach = scene.gripper().corner_distance(disc.radius) + scene.gripper().margin();
        let mut gaps: Vec<f64> = scene
            .index()
            .within(disc.centre, reach)
            .filter(|(other, _)| *other != index)
            .map(|(_, other)| other.gap(&disc))
            .collect();
        // Sums depend on the order of their terms, and the index promises none.
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

    fn scene(recipe: &Recipe, seed: u64) -> Scene {
        Scene::new(generate(recipe, seed).unwrap(), &SceneLimits { overlap_tolerance: 0.0, ..SceneLimits::default() })
            .unwrap()
            .0
    }

    fn least_gaps(scene: &Scene) -> impl Iterator<Item = f64> + '_ {
        scene.indices().map(|one| {
            let others = scene.indices().filter(move |&other| other != one);
            let gap = |other| scene.object(one).disc().gap(&scene.object(other).disc());
            others.map(gap).fold(f64::INFINITY, f64::min)
        })
    }

    #[test]
    fn loose_discs_stand_apart_and_on_the_table() {
        for seed in 0..20 {
            let scene = scene(&Recipe { origin: (-3.0, 7.0), radius: (0.02, 0.09), ..Recipe::default() }, seed);
            assert!(least_gaps(&scene).all(|gap| gap >= 0.0));
            assert!(scene.objects().iter().all(|object| scene.table().top().inner_gap(&object.disc()) >= 0.0));
        }
    }

    #[test]
    fn pressed_discs_stand_within_two_millimetres_of_another() {
        for radius in [(0.05, 0.05), (0.02, 0.08)] {
            let recipe = Recipe {
                objects: 60,
                table: (2.0, 2.0),
                radius,
                arrangement: Arrangement::Pressed,
                ..Recipe::default()
            };
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
        for arrangement in [Arrangement::Loose, Arrangement::Pressed] {
            let recipe = Recipe { objects: 60, arrangement, ..Recipe::default() };
            let Err(GenerateError::TooFull { fitted, wanted: 60 }) = generate(&recipe, 0) else { panic!("60 fit") };
            assert!((15..60).contains(&fitted), "{fitted}");
            assert!(generate(&Recipe { objects: fitted, ..recipe }, 0).is_ok());
        }
    }

    #[test]
    fn the_target_stands_in_the_closest_crowd_and_is_never_fixed() {
        let recipe = Recipe { fixed_share: 1.0, arrangement: Arrangement::Pressed, ..Recipe::default() };
        let recipe = Recipe { table: (2.0, 2.0), ..recipe };
        let scene = scene(&recipe, 1);
        assert_eq!(scene.objects().iter().filter(|object| !object.fixed()).count(), 1);
        let target = scene.object(scene.target());
        assert!(!target.fixed());
        let reach = scene.gripper().corner_distance(target.disc().radius);
        assert!(scene.index().within(target.disc().centre, reach).count() > 5);
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
        for arrangement in [Arrangement::Loose, Arrangement::Pressed] {
            let recipe = Recipe { objects: 10_000, table, arrangement, ..Recipe::default() };
            assert_eq!(scene(&recipe, 0).objects().len(), 10_000);
        }
    }
}
