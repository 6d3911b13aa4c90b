//! The paper's own methods beside our exact ones: what they get right, and their known defects.

use std::fs;

use singulate::experiments::{Recipe, generate, varied};
use singulate::wire::{RequestLimits, read_scene};
use singulate_planner::budget::Budget;
use singulate_planner::knowledge::{KnowledgeBase, OptionsOf, complete, swept_finger_options};
use singulate_planner::paper::{
    Conclusion, PolarHistogram, Raster, forward_astar, lobs, sector_options, sector_shadow,
};
use singulate_planner::plan::check::{FaultCode, check};
use singulate_planner::plan::{
    Answer, Claim, GraspModel, PlacementMethod, SearchMethod, Settings, Verdict, Warning, plan,
};
use singulate_planner::scene::{ObjectIndex, Scene, SceneLimits};
use singulate_planner::search::{Derivation, Outcome, Restriction, least};

const MANY: usize = 1_000_000;

/// The paper's fullest tables: 20 plates in Case I, 25 in Case II.
fn papers_scenes() -> impl Iterator<Item = Scene> {
    (0..24).map(|seed| {
        let (objects, width) = if seed % 2 == 0 { (20, 1.2) } else { (25, 1.4) };
        let recipe = Recipe { objects, table: (width, 0.7), ..Recipe::default() };
        Scene::new(generate(&recipe, seed).unwrap(), &SceneLimits::default()).unwrap().0
    })
}

fn base(scene: &Scene, options_of: OptionsOf) -> KnowledgeBase {
    complete(scene, options_of, &Budget::unlimited()).unwrap()
}

fn optimum(base: &KnowledgeBase, target: ObjectIndex) -> Option<usize> {
    match least(base, target, &Restriction::default(), &Budget::unlimited()) {
        Outcome::Least(known) => Some(known.bound),
        Outcome::Underivable => None,
        Outcome::Interrupted(_) => unreachable!("the budget never ends"),
    }
}

/// A scene on which Algorithm 1 fails, found by trying generated ones.
fn fixture(name: &str) -> Scene {
    let path = format!("{}/tests/golden/lobs/{name}.json", env!("CARGO_MANIFEST_DIR"));
    read_scene(&fs::read(path).unwrap(), &RequestLimits::default()).unwrap().scene
}

fn planned(scene: &Scene, grasp_model: GraspModel, search: SearchMethod) -> Answer {
    let settings = Settings { grasp_model, search, ..Settings::default() };
    plan(scene, &settings, &Budget::unlimited()).unwrap()
}

fn exact(scene: &Scene) -> Answer {
    planned(scene, GraspModel::SweptFinger, SearchMethod::Landmarks)
}

fn cost(answer: &Answer) -> usize {
    match &answer.verdict {
        Verdict::Relocate(plan) => plan.cost(),
        other => panic!("no plan: {other:?}"),
    }
}

#[test]
fn lobs_takes_a_need_at_two_depths_for_a_cycle() {
    let set = |members: &[usize]| members.iter().copied().map(ObjectIndex::new).collect::<Vec<_>>();
    // t ← {a, b}, a ← {b}, b ← {c}, c free.
    let base: KnowledgeBase =
        [vec![set(&[1, 2])], vec![set(&[2])], vec![set(&[3])], vec![set(&[])]].into_iter().collect();
    let target = ObjectIndex::new(0);
    assert_eq!(lobs(&base, target, MANY, &Budget::unlimited()), Ok(Conclusion::Deadlock));
    assert_eq!(optimum(&base, target), Some(3));
    let sequence = Conclusion::Sequence(Derivation { order: set(&[3, 2, 1]) });
    assert_eq!(forward_astar(&base, target, MANY, &Budget::unlimited()), Ok(sequence));
    // With c held by b there is none.
    let base: KnowledgeBase =
        [vec![set(&[1, 2])], vec![set(&[2])], vec![set(&[3])], vec![set(&[2])]].into_iter().collect();
    assert_eq!(forward_astar(&base, target, MANY, &Budget::unlimited()), Ok(Conclusion::Deadlock));
}

#[test]
fn lobs_moves_more_than_is_needed_and_is_told_so() {
    let scene = fixture("not_optimal");
    let answer = planned(&scene, GraspModel::SweptFinger, SearchMethod::Lobs);
    assert_eq!(cost(&answer), 5);
    assert_eq!(answer.warnings, [Warning::NotOptimal { found: 5, enough: 3 }]);
    assert_eq!(answer.optimal(), Some(false));
    let exact = exact(&scene);
    assert_eq!((cost(&exact), exact.optimal()), (3, Some(true)));
    assert!(exact.warnings.is_empty());
}

#[test]
fn a_false_deadlock_of_lobs_is_served_without_proof_and_with_a_warning() {
    let scene = fixture("false_deadlock");
    let answer = planned(&scene, GraspModel::SweptFinger, SearchMethod::Lobs);
    assert_eq!(answer.verdict, Verdict::Deadlock(None));
    assert_eq!(
        answer.warnings,
        [Warning::FalseDeadlock { enough: 5 }, Warning::UnprovenDeadlock { enough: Some(5), setting: "search" }]
    );
    let exact = exact(&scene);
    assert_eq!((cost(&exact), exact.optimal()), (5, Some(true)));
}

#[test]
fn a_true_deadlock_of_the_papers_methods_comes_with_our_proof() {
    let mut deadlocks = 0;
    for scene in papers_scenes() {
        let exact = exact(&scene);
        if let Verdict::Deadlock(proof) = exact.verdict {
            deadlocks += 1;
            let answer = planned(&scene, GraspModel::SweptFinger, SearchMethod::Lobs);
            assert_eq!(answer.verdict, Verdict::Deadlock(proof));
            assert!(answer.warnings.is_empty(), "{:?}", answer.warnings);
        }
    }
    assert!(deadlocks > 0);
}

/// Each object's option is relocated before it.
fn is_derivation(base: &KnowledgeBase, target: ObjectIndex, order: &[ObjectIndex]) -> bool {
    order.iter().chain([&target]).enumerate().all(|(at, &object)| {
        let mut options = base.options(object);
        options.any(|option| option.iter().all(|member| order[..at.min(order.len())].contains(member)))
    })
}

#[test]
fn in_the_papers_cases_its_searches_find_the_optimum() {
    let (mut sequences, mut deadlocks) = (0, 0);
    for scene in papers_scenes() {
        for base in [base(&scene, sector_options), base(&scene, swept_finger_options)] {
            for target in scene.indices() {
                let optimum = optimum(&base, target);
                let mut found = vec![lobs(&base, target, MANY, &Budget::unlimited()).unwrap()];
                // What forward search can't find it looks for among all sets of objects.
                if optimum.is_some() {
                    found.push(forward_astar(&base, target, MANY, &Budget::unlimited()).unwrap());
                }
                for found in found {
                    match found {
                        Conclusion::Sequence(Derivation { order }) => {
                            sequences += 1;
                            assert!(is_derivation(&base, target, &order), "{order:?}");
                            assert_eq!(Some(order.len()), optimum);
                        }
                        Conclusion::Deadlock => {
                            deadlocks += 1;
                            assert_eq!(optimum, None);
                        }
                        Conclusion::TooLarge => panic!("small scenes"),
                    }
                }
            }
        }
    }
    assert!(sequences > 100 && deadlocks > 10, "{sequences} {deadlocks}");
}

#[test]
fn a_search_that_outgrows_its_memory_says_so() {
    let scene = fixture("not_optimal");
    let (base, target) = (base(&scene, swept_finger_options), scene.target());
    assert_eq!(lobs(&base, target, 3, &Budget::unlimited()), Ok(Conclusion::TooLarge));
    assert_eq!(forward_astar(&base, target, 3, &Budget::unlimited()), Ok(Conclusion::TooLarge));
}

#[test]
fn the_histogram_blocks_a_sector_exactly_where_a_sector_shadow_covers_it() {
    for scene in papers_scenes().take(4) {
        for object in scene.indices() {
            let g = PolarHistogram::around(&scene, object).g();
            let (gripper, grasped) = (scene.gripper(), scene.object(object).disc());
            let others: Vec<_> = scene.indices().filter(|other| *other != object).collect();
            assert_eq!(g.len(), 120);
            for (z, magnitude) in g.iter().enumerate() {
                let yaw = f64::from(u32::try_from(z).unwrap()).to_radians();
                let covers = |other: &ObjectIndex| {
                    let shadow = sector_shadow(gripper, &grasped, &scene.object(*other).disc(), 0.0);
                    shadow.arcs().iter().any(|arc| arc.lo <= yaw && yaw <= arc.hi)
                };
                assert_eq!(*magnitude > 0.0, others.iter().any(covers), "{object:?} {z}");
            }
        }
    }
}

#[test]
fn the_histogram_of_three_fingers_adds_what_stands_120_degrees_apart() {
    for scene in papers_scenes().take(4) {
        for object in scene.indices() {
            let histogram = PolarHistogram::around(&scene, object);
            let (h, g) = (histogram.h(), histogram.g());
            for z in 0..120 {
                assert!((g[z] - (h[z] + h[z + 120] + h[z + 240])).abs() < 1e-9);
            }
        }
    }
}

#[test]
fn what_sectors_leave_free_the_fingers_do_too_but_not_the_other_way_round() {
    let (mut unproven, mut proven, mut plans) = (0, 0, 0);
    for scene in papers_scenes() {
        for target in scene.indices() {
            let scene = scene.with_target(target).unwrap();
            let (sector, exact) = (planned(&scene, GraspModel::Sector, SearchMethod::Landmarks), exact(&scene));
            match (&sector.verdict, &exact.verdict) {
                (Verdict::Deadlock(None), Verdict::Relocate(plan)) => {
                    unproven += 1;
                    let enough = plan.bound.as_ref().map(|bound| bound.cost);
                    let setting = "grasp_model";
                    assert_eq!(sector.warnings, [Warning::UnprovenDeadlock { enough, setting }]);
                }
                (Verdict::Deadlock(Some(lock)), Verdict::Deadlock(Some(ours))) => {
                    proven += 1;
                    assert_eq!(lock, ours);
                }
                (Verdict::Relocate(plan), Verdict::Relocate(ours)) => {
                    plans += 1;
                    assert_eq!(plan.bound, ours.bound);
                    let least = ours.bound.as_ref().map_or(0, |bound| bound.cost);
                    let fewer = (plan.cost() > least).then_some(Warning::FewerSuffice { enough: least });
                    assert_eq!(sector.warnings, fewer.into_iter().collect::<Vec<_>>());
                }
                (_, Verdict::Deadlock(_)) => panic!("{sector:?}"),
                _ => {}
            }
        }
    }
    assert!(unproven > 5 && proven > 5 && plans > 20, "{unproven} {proven} {plans}");
}

#[test]
fn releases_without_room_become_warnings_of_a_raster_plan() {
    let (mut plans, mut faulty, mut other) = (0, 0, 0);
    let made_up = (0..200).map(|seed| Scene::new(varied(seed), &SceneLimits::default()).unwrap().0);
    for scene in papers_scenes().chain(made_up) {
        for target in scene.indices().take(6) {
            let Some(scene) = scene.with_target(target) else { continue };
            let raster = PlacementMethod::Raster(Raster::new(0.005, scene.table()).unwrap());
            let settings = Settings { placement: raster, ..Settings::default() };
            let answer = plan(&scene, &settings, &Budget::unlimited()).unwrap();
            let Verdict::Relocate(plan) = &answer.verdict else { continue };
            plans += 1;
            // The bound is that of the swept finger, whatever becomes of the places.
            assert!(plan.optimal(), "{answer:?}");
            assert_eq!(answer.optimal(), (!answer.faulty()).then_some(true));
            let mut claim = Claim::of(&scene, &answer);
            claim.optimal = None;
            let report = check(&scene, &claim, &Budget::unlimited());
            let faults: Vec<Warning> = report.faults.iter().cloned().map(Warning::Faulty).collect();
            assert_eq!(answer.warnings, faults);
            faulty += usize::from(answer.faulty());
            let known = [FaultCode::ReleaseBlocked, FaultCode::WrongSlack];
            other += report.faults.iter().filter(|fault| !known.contains(&fault.code)).count();
        }
    }
    assert!(plans > 30 && faulty > 0 && other == 0, "{plans} {faulty} {other}");
}

#[test]
fn an_unproven_deadlock_does_not_pass_for_a_proof() {
    let scene = fixture("false_deadlock");
    let answer = planned(&scene, GraspModel::SweptFinger, SearchMethod::Lobs);
    let report = check(&scene, &Claim::of(&scene, &answer), &Budget::unlimited());
    assert_eq!(report.faults.iter().map(|fault| fault.code).collect::<Vec<_>>(), [FaultCode::MissingPart]);
}
