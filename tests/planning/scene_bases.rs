//! Bases that come from scenes: the search and the locks against exhaustion.

use singulate::experiments::{Crowding, Recipe, generate};
use singulate_planner::budget::Budget;
use singulate_planner::cost::Cost;
use singulate_planner::knowledge::{KnowledgeBase, SweptFinger, complete, derivable, relevant};
use singulate_planner::plan::{Settings, plan};
use singulate_planner::scene::{
    GoalDraft, GripperDraft, ObjectDraft, ObjectIndex, Scene, SceneDraft, SceneLimits, ShapeDraft,
};
use singulate_planner::search::{Restriction, SILENT, SearchOutcome, least};
use singulate_planner::statement::{Statement, Verdict};

/// Up to 11 discs, with gaps about as wide as a finger, so that options share members, hold each other and the target.
fn crowd(seed: u64) -> Scene {
    let pick = |step: u64, count: u64| seed / step % count;
    let share = |step: u64, count: u64| [0.0, 0.5, 1.0, 1.5][usize::try_from(pick(step, count)).unwrap()];
    let gripper = GripperDraft {
        fingers: Some([2.0, 3.0, 4.0, 5.0, 6.0][usize::try_from(pick(1, 5)).unwrap()]),
        finger_width: Some(0.02),
        clearance: Some(0.02 + 0.03 * share(3, 3)),
        margin: Some(0.002 * share(7, 2)),
        yaw_tolerance: Some(0.05 * share(11, 3)),
        ..GripperDraft::default()
    };
    let recipe = Recipe {
        objects: usize::try_from(5 + pick(13, 7)).unwrap(),
        radius: (0.03, 0.03 + 0.03 * share(5, 3)),
        table: (2.0, 2.0),
        gripper,
        fixed_share: if pick(17, 3) == 0 { 0.2 } else { 0.0 },
        arrangement: Crowding::Pressed,
        pressed_gap: 0.012 + 0.02 * share(2, 4),
        ..Recipe::default()
    };
    Scene::new(generate(&recipe, seed).unwrap(), &SceneLimits::default()).unwrap().0
}

/// The options of one object, a bit for each member.
type Options = Vec<u32>;

fn masks(base: &KnowledgeBase) -> Vec<Options> {
    let mask = |option: &[ObjectIndex]| option.iter().fold(0_u32, |set, member| set | 1 << member.get());
    base.objects().map(|object| base.options(object).map(mask).collect()).collect()
}

/// Does the target follow when only `movable` may be moved? Round by round, straight from the definition.
fn follows(options: &[Options], target: usize, movable: u32) -> bool {
    let mut moved = 0_u32;
    loop {
        let graspable = |object: usize| options[object].iter().any(|option| option & !moved == 0);
        let may = |object: usize| object != target && movable >> object & 1 == 1;
        let next = (0..options.len()).filter(|&o| may(o) && graspable(o)).fold(moved, |set, o| set | 1 << o);
        if next == moved {
            return graspable(target);
        }
        moved = next;
    }
}

#[test]
fn the_least_set_of_a_small_crowd_is_what_exhaustion_finds() {
    let (mut derived, mut locked, mut around_the_target) = (0, 0, 0);
    for seed in 0..600 {
        let scene = crowd(seed);
        let base = complete(&scene, &SweptFinger, &Budget::unlimited()).unwrap();
        let options = masks(&base);
        for target in scene.indices().filter(|&object| !scene.object(object).fixed()) {
            let at = target.get();
            let all = (1_u32 << options.len()) - 1;
            let expected = (0..=all).filter(|&set| set >> at & 1 == 0);
            let expected = expected.filter(|&set| follows(&options, at, set)).map(u32::count_ones).min();
            let near = relevant(&scene, target, &SweptFinger, &Budget::unlimited()).unwrap();
            match least(&near, target, &Restriction::default(), &Budget::unlimited()) {
                SearchOutcome::Least(found) => {
                    assert_eq!(u32::try_from(found.bound.get()).ok(), expected, "seed {seed} target {at}");
                    assert_eq!(Cost::of_each(found.derivation.order.len()), found.bound);
                    derived += usize::from(found.bound > Cost::ZERO);
                    around_the_target += usize::from(options.iter().flatten().any(|option| option >> at & 1 == 1));
                    let landmarks = masks(&[vec![vec![]], found.landmarks].into_iter().collect());
                    for &landmark in &landmarks[1] {
                        assert!(!follows(&options, at, all & !landmark), "seed {seed} target {at}: {landmark:b}");
                    }
                }
                outcome => {
                    assert_eq!((&outcome, expected), (&SearchOutcome::Underivable, None), "seed {seed} target {at}");
                    locked += 1;
                }
            }
        }
    }
    eprintln!("{derived} derived, {locked} locked, {around_the_target} with options that hold the target");
    assert!(derived > 300 && locked > 300 && around_the_target > 300);
}

fn planned(scene: &Scene) -> Statement {
    plan(scene, &Settings::default(), &Budget::unlimited(), SILENT).unwrap().statement
}

#[test]
fn a_lock_of_a_small_crowd_holds_and_no_part_of_its_core_does() {
    let (mut locks, mut with_fixed) = (0, 0);
    for seed in 0..600 {
        let scene = crowd(seed);
        let Some(lock) = planned(&scene).deadlock else { continue };
        let base = complete(&scene, &SweptFinger, &Budget::unlimited()).unwrap();
        let options = masks(&base);
        let set = |members: &[ObjectIndex]| members.iter().fold(0_u32, |set, member| set | 1 << member.get());
        let holds = |set: u32| {
            let movable = (0..options.len()).filter(|&o| set >> o & 1 == 1 && !scene.objects()[o].fixed());
            movable.into_iter().all(|member| options[member].iter().all(|option| option & set != 0))
        };
        let members = |ids: &[String]| ids.iter().map(|id| scene.find(id).unwrap()).collect::<Vec<_>>();
        let greatest = members(&lock.blocked);
        let (blocked, core) = (set(&greatest), set(&members(&lock.core)));
        assert!(holds(blocked) && holds(core) && core & !blocked == 0, "seed {seed}: {lock:?}");
        let target = 1 << scene.target().unwrap().get();
        let parts = (0..core).filter(|part| part & !core == 0 && part & target != 0);
        assert_eq!(parts.into_iter().find(|&part| holds(part)), None, "seed {seed}: {lock:?}");
        let closure = derivable(&base, |_| false, &Budget::unlimited()).unwrap();
        let stuck = scene.indices().filter(|&o| !scene.object(o).fixed() && !closure.derives(o));
        let fixed: Vec<ObjectIndex> = greatest.into_iter().filter(|&o| scene.object(o).fixed()).collect();
        assert_eq!(
            blocked & !set(&fixed),
            set(&stuck.collect::<Vec<_>>()),
            "seed {seed}: all that is stuck is in the greatest lock"
        );
        locks += 1;
        with_fixed += usize::from(!fixed.is_empty());
    }
    assert!(locks > 50 && with_fixed > 10, "{locks} {with_fixed}");
}

/// The target with one plate of the same size that touches it and can't be moved.
fn beside_a_fixed_plate(fingers: u32) -> SceneDraft {
    let mut draft = generate(&Recipe { objects: 1, table: (1.2, 0.7), ..Recipe::default() }, 1).unwrap();
    draft.gripper.fingers = Some(fingers.into());
    let plate = |id: &str, x: f64, fixed: bool| ObjectDraft {
        id: Some(id.into()),
        x: Some(x),
        y: Some(0.35),
        shape: ShapeDraft::disc(0.075),
        fixed,
        ..ObjectDraft::default()
    };
    draft.objects = vec![plate("wanted", 0.5, false), plate("plate", 0.65, true)];
    draft.goal = Some(GoalDraft::Target("wanted".into()));
    draft
}

#[test]
fn one_touching_fixed_plate_locks_six_fingers_and_more_but_not_five() {
    for fingers in 2..=12 {
        let (scene, _) = Scene::new(beside_a_fixed_plate(fingers), &SceneLimits::default()).unwrap();
        let stated = planned(&scene);
        let both: Vec<String> = scene.objects().iter().map(|object| object.id().to_owned()).collect();
        match (stated.verdict, stated.deadlock) {
            (Some(Verdict::Graspable), None) => assert!(fingers <= 5, "{fingers}"),
            (Some(Verdict::Deadlock), Some(lock)) => {
                assert!(fingers >= 6, "{fingers}");
                assert_eq!((&lock.core, &lock.blocked), (&both, &both));
            }
            other => panic!("{fingers}: {other:?}"),
        }
    }
}
