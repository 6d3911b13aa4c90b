//! The scene-born instance classes: a knowledge base and a target each.

use std::time::Duration;

use singulate::experiments::{Crowding, PAPERS_CASES, Recipe, generate};
use singulate_planner::budget::Budget;
use singulate_planner::cost::Cost;
use singulate_planner::knowledge::{KnowledgeBase, SweptFinger, complete, derivable, relevant};
use singulate_planner::scene::{GripperDraft, ObjectIndex, Scene, SceneLimits};
use singulate_planner::search::{Restriction, SearchOutcome, least};

use super::cases::count;
use super::{RUNS, RUNS_ALONE, fastest};

/// One question for every solver.
pub(crate) struct Instance {
    /// Tells it from all others of its class.
    pub(crate) name: String,
    pub(crate) base: KnowledgeBase,
    pub(crate) target: ObjectIndex,
    /// How long the way from the scene to the base took; `None` where no scene is behind it.
    pub(crate) knowledge: Option<Duration>,
}

/// The widest gaps of the pressed clusters, m. Between the narrowest, where nearly all is locked, and the widest, where
/// little is in the way, lie the long derivations.
const GAPS: [f64; 6] = [0.018, 0.02, 0.022, 0.024, 0.026, 0.028];
/// Objects, widest gap, seed: the deepest of 60 clusters of each size and gap.
const DEEP: [(usize, f64, usize); 9] = [
    (150, 0.026, 3),
    (300, 0.024, 12),
    (300, 0.024, 49),
    (300, 0.022, 7),
    (600, 0.026, 47),
    (600, 0.024, 26),
    (600, 0.024, 34),
    (600, 0.026, 21),
    (600, 0.024, 38),
];
/// The same for mixed radii and the paper's wider fingers.
const MIXED_GAPS: [f64; 4] = [0.035, 0.04, 0.045, 0.05];

/// The paper's scenes, its columns in turn: the target is the object with the largest least option by the swept finger.
pub(crate) fn paper(number: usize) -> Instance {
    let case = &PAPERS_CASES[number % PAPERS_CASES.len()];
    let (objects, table) = (case.objects, case.table);
    let seed = number / PAPERS_CASES.len();
    let scene = scene(&Recipe { objects, table, ..Recipe::default() }, seed);
    let base = complete(&scene, &SweptFinger, &Budget::unlimited()).expect("small");
    let least = |object: &ObjectIndex| base.options(*object).map(<[_]>::len).min();
    let target = scene.indices().max_by_key(least).expect("not empty");
    instance(format!("N={objects} seed {seed}"), &scene, target)
}

/// 80 discs of 3 to 9 cm radius in a loosely pressed cluster, the paper's gripper.
pub(crate) fn mixed(number: usize) -> Instance {
    let gap = MIXED_GAPS[number % MIXED_GAPS.len()];
    let gripper = Recipe::default().gripper;
    hardest(&Recipe { radius: (0.03, 0.09), gripper, ..pressed_recipe(80, gap) }, number)
}

/// Dishes in a pressed cluster and four slim fingers: the deepest first, then every gap in turn.
pub(crate) fn pressed(objects: usize, number: usize) -> Instance {
    let deep: Vec<_> = DEEP.iter().filter(|deep| deep.0 == objects).collect();
    let (gap, seed) = match deep.get(number) {
        Some(&&(_, gap, seed)) => (gap, seed),
        // No seed of the list above comes twice.
        None => (GAPS[number % GAPS.len()], 100 + number),
    };
    hardest(&pressed_recipe(objects, gap), seed)
}

fn pressed_recipe(objects: usize, gap: f64) -> Recipe {
    let side = (count(objects) * 0.05 * 0.05 * core::f64::consts::PI / 0.3).sqrt();
    let gripper = GripperDraft {
        fingers: Some(4.0),
        finger_width: Some(0.008),
        clearance: Some(0.025),
        ..Recipe::default().gripper
    };
    Recipe {
        objects,
        table: (side, side),
        radius: (0.04, 0.06),
        gripper,
        arrangement: Crowding::Pressed,
        pressed_gap: gap,
        ..Recipe::default()
    }
}

/// The target that takes most relocations, of several the first.
fn hardest(recipe: &Recipe, seed: usize) -> Instance {
    let scene = scene(recipe, seed);
    let budget = Budget::unlimited();
    let base = complete(&scene, &SweptFinger, &budget).expect("within the limits");
    let closure = derivable(&base, |_| false, &budget).expect("unlimited");
    let bound = |target: ObjectIndex| match least(&base, target, &Restriction::default(), &budget) {
        SearchOutcome::Least(set) => set.bound,
        SearchOutcome::Underivable | SearchOutcome::Interrupted(_) => Cost::ZERO,
    };
    let derivable = scene.indices().filter(|object| closure.derives(*object));
    let target = derivable.max_by_key(|object| (bound(*object), core::cmp::Reverse(*object)));
    let name = format!("gap {:.0} mm seed {seed}", recipe.pressed_gap * 1e3);
    instance(name, &scene, target.or(scene.target()).expect("a target"))
}

fn scene(recipe: &Recipe, seed: usize) -> Scene {
    let draft = generate(recipe, u64::try_from(seed).expect("small")).expect("fits");
    Scene::new(draft, &SceneLimits::default()).expect("a sound scene").0
}

/// With the part of the base that matters to the target: what the search itself is asked.
fn instance(name: String, scene: &Scene, target: ObjectIndex) -> Instance {
    let work = || relevant(scene, target, &SweptFinger, &Budget::unlimited()).expect("within the limits");
    let (base, knowledge) = fastest(RUNS_ALONE, work);
    Instance { name, base, target, knowledge: Some(knowledge) }
}

/// What is asked of everybody with 10,000 objects: which of them can be derived at all?
pub(crate) struct Crowd {
    pub(crate) base: KnowledgeBase,
    pub(crate) derivable: usize,
    /// From the scene to the closure of its complete base.
    pub(crate) time: Duration,
    /// From the base to its closure.
    pub(crate) closing: Duration,
}

/// A table full of the paper's dishes, all of them asked at once.
pub(crate) fn crowd(scene: &Scene) -> Crowd {
    let budget = Budget::unlimited();
    let work = || {
        let base = complete(scene, &SweptFinger, &budget).expect("within the limits");
        let closure = derivable(&base, |_| false, &budget).expect("unlimited");
        (base, closure)
    };
    let ((base, closure), time) = fastest(RUNS_ALONE, work);
    let (_, closing) = fastest(RUNS, || derivable(&base, |_| false, &budget).expect("unlimited"));
    let derivable = scene.indices().filter(|object| closure.derives(*object)).count();
    Crowd { base, derivable, time, closing }
}
