//! The paper's own methods beside our exact ones: what they get right, and their known defects.

use std::fs;

use singulate::experiments::{Recipe, generate, varied};
use singulate::wire::{RequestLimits, read_scene};
use singulate_planner::budget::Budget;
use singulate_planner::check::{FaultCode, check};
use singulate_planner::cost::Cost;
use singulate_planner::knowledge::{GraspModel, KnowledgeBase, SweptFinger, complete};
use singulate_planner::paper::{
    Conclusion, GraspModelName, Judged, Methods, PlacementMethod, PolarHistogram, Raster, SearchMethod, Sector,
    Warning, forward_astar, lobs, plan_by,
};
use singulate_planner::plan::Settings;
use singulate_planner::scene::{ObjectIndex, Scene, SceneLimits};
use singulate_planner::search::{Derivation, Restriction, SILENT, SearchOutcome, least};
use singulate_planner::statement::{Statement, Verdict};

const MANY: usize = 1_000_000;

/// The paper's fullest tables: 20 plates in Case I, 25 in Case II.
fn papers_scenes() -> impl Iterator<Item = Scene> {
    (0..24).map(|seed| {
        let (objects, width) = if seed % 2 == 0 { (20, 1.2) } else { (25, 1.4) };
        let recipe = Recipe { objects, table: (width, 0.7), ..Recipe::default() };
        Scene::new(generate(&recipe, seed).unwrap(), &SceneLimits::default()).unwrap().0
    })
}

fn base(scene: &Scene, model: &dyn GraspModel) -> KnowledgeBase {
    complete(scene, model, &Budget::unlimited()).unwrap()
}

fn optimum(base: &KnowledgeBase, target: ObjectIndex) -> Option<Cost> {
    match least(base, target, &Restriction::default(), &Budget::unlimited()) {
        SearchOutcome::Least(known) => Some(known.bound),
        SearchOutcome::Underivable => None,
        SearchOutcome::Interrupted(_) => unreachable!("the budget never ends"),
    }
}

/// A scene on which Algorithm 1 fails, found by trying generated ones.
fn fixture(name: &str) -> Scene {
    let path = format!("{}/tests/golden/lobs/{name}.json", env!("CARGO_MANIFEST_DIR"));
    read_scene(&fs::read(path).unwrap(), &RequestLimits::default()).unwrap().scene
}

fn planned(scene: &Scene, methods: &Methods) -> Judged {
    plan_by(methods, scene, &Settings::default(), &Budget::unlimited(), SILENT).unwrap()
}

fn by_lobs(scene: &Scene) -> Judged {
    planned(scene, &Methods { search: SearchMethod::Lobs, ..Methods::default() })
}

fn exact(scene: &Scene) -> Judged {
    planned(scene, &Methods::default())
}

/// The cost of a plan, counted by its steps.
#[track_caller]
fn cost(stated: &Statement) -> Cost {
    assert_eq!(stated.verdict, Some(Verdict::Relocate), "no plan: {stated:?}");
    let counted = Cost::of_each(stated.steps().len());
    assert_eq!(stated.cost, Some(counted));
    counted
}

/// The same, and whether the plan is said to be optimal.
#[track_caller]
fn cost_and_optimal(judged: &Judged) -> (Cost, Option<bool>) {
    let stated = judged.statement();
    (cost(stated), stated.optimal)
}

#[test]
fn lobs_takes_a_need_at_two_depths_for_a_cycle() {
    let set = |members: &[usize]| members.iter().copied().map(ObjectIndex::new).collect::<Vec<_>>();
    // t ← {a, b}, a ← {b}, b ← {c}, c free.
    let base: KnowledgeBase =
        [vec![set(&[1, 2])], vec![set(&[2])], vec![set(&[3])], vec![set(&[])]].into_iter().collect();
    let target = ObjectIndex::new(0);
    assert_eq!(lobs(&base, target, MANY, &Budget::unlimited()), Ok(Conclusion::Deadlock));
    assert_eq!(optimum(&base, target), Some(Cost::new(3)));
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
    let judged = by_lobs(&scene);
    assert_eq!(cost_and_optimal(&judged), (Cost::new(5), Some(false)));
    assert_eq!(judged.warnings, [Warning::NotOptimal { found: Cost::new(5), enough: Cost::new(3) }]);
    let exact = exact(&scene);
    assert_eq!(cost_and_optimal(&exact), (Cost::new(3), Some(true)));
    assert!(exact.warnings.is_empty());
}

#[test]
fn a_false_deadlock_of_lobs_is_served_without_proof_and_with_a_warning() {
    let scene = fixture("false_deadlock");
    let judged = by_lobs(&scene);
    let stated = judged.statement();
    assert_eq!((stated.verdict, &stated.deadlock), (Some(Verdict::Deadlock), &None));
    let enough = Cost::new(5);
    assert_eq!(
        judged.warnings,
        [Warning::FalseDeadlock { enough }, Warning::UnprovenDeadlock { enough: Some(enough), setting: "search" }]
    );
    assert_eq!(cost_and_optimal(&exact(&scene)), (enough, Some(true)));
}

#[test]
fn a_true_deadlock_of_the_papers_methods_comes_with_our_proof() {
    let mut deadlocks = 0;
    for scene in papers_scenes() {
        let ours = exact(&scene).answer.statement;
        if ours.verdict == Some(Verdict::Deadlock) {
            deadlocks += 1;
            let judged = by_lobs(&scene);
            assert!(ours.deadlock.is_some());
            assert_eq!(judged.answer.statement, ours);
            assert!(judged.warnings.is_empty(), "{:?}", judged.warnings);
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
        for base in [base(&scene, &Sector), base(&scene, &SweptFinger)] {
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
                            assert_eq!(Some(Cost::of_each(order.len())), optimum);
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
    let (base, target) = (base(&scene, &SweptFinger), scene.target().unwrap());
    assert_eq!(lobs(&base, target, 3, &Budget::unlimited()), Ok(Conclusion::TooLarge));
    assert_eq!(forward_astar(&base, target, 3, &Budget::unlimited()), Ok(Conclusion::TooLarge));
}

#[test]
fn the_histogram_blocks_a_sector_exactly_where_a_sector_shadow_covers_it() {
    for scene in papers_scenes().take(4) {
        for object in scene.indices() {
            let g = PolarHistogram::around(&scene, object).g();
            let (gripper, grasped) = (scene.gripper(), scene.object(object).footprint());
            let others: Vec<_> = scene.indices().filter(|other| *other != object).collect();
            assert_eq!(g.len(), 120);
            for (z, magnitude) in g.iter().enumerate() {
                let yaw = f64::from(u32::try_from(z).unwrap()).to_radians();
                let covers = |other: &ObjectIndex| {
                    let shadow = Sector.sector(gripper, grasped, scene.object(*other).footprint(), 0.0);
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
            let by_sectors = Methods { grasp_model: GraspModelName::Sector, ..Methods::default() };
            let (sector, ours) = (planned(&scene, &by_sectors), exact(&scene).answer.statement);
            let stated = &sector.answer.statement;
            match (stated.verdict.unwrap(), ours.verdict.unwrap()) {
                (Verdict::Deadlock, Verdict::Relocate) => {
                    unproven += 1;
                    assert_eq!(stated.deadlock, None);
                    let (enough, setting) = (ours.lower_bound, "grasp_model");
                    assert_eq!(sector.warnings, [Warning::UnprovenDeadlock { enough, setting }]);
                }
                (Verdict::Deadlock, Verdict::Deadlock) => {
                    proven += 1;
                    assert!(ours.deadlock.is_some());
                    assert_eq!(stated.deadlock, ours.deadlock);
                }
                (Verdict::Relocate, Verdict::Relocate) => {
                    plans += 1;
                    assert_eq!((stated.lower_bound, &stated.landmarks), (ours.lower_bound, &ours.landmarks));
                    let enough = ours.lower_bound.unwrap();
                    let fewer = (cost(stated) > enough).then_some(Warning::FewerSuffice { enough });
                    assert_eq!(sector.warnings, fewer.into_iter().collect::<Vec<_>>());
                }
                (_, Verdict::Deadlock) => panic!("{sector:?}"),
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
            let placement = PlacementMethod::Raster(Raster::new(0.005, scene.table()).unwrap());
            let judged = planned(&scene, &Methods { placement, ..Methods::default() });
            let stated = judged.statement();
            if stated.verdict != Some(Verdict::Relocate) {
                continue;
            }
            plans += 1;
            // The bound is that of the swept finger, whatever becomes of the places.
            assert_eq!(stated.lower_bound, Some(cost(stated)), "{judged:?}");
            assert_eq!(stated.optimal, (!judged.faulty()).then_some(true));
            let report = check(&scene, &Statement { optimal: None, ..stated.clone() }, &Budget::unlimited());
            let faults: Vec<Warning> = report.faults.iter().cloned().map(Warning::Faulty).collect();
            assert_eq!(judged.warnings, faults);
            faulty += usize::from(judged.faulty());
            let known = [FaultCode::ReleaseBlocked, FaultCode::WrongSlack];
            other += report.faults.iter().filter(|fault| !known.contains(&fault.code)).count();
        }
    }
    assert!(plans > 30 && faulty > 0 && other == 0, "{plans} {faulty} {other}");
}

#[test]
fn an_unproven_deadlock_does_not_pass_for_a_proof() {
    let scene = fixture("false_deadlock");
    let report = check(&scene, &by_lobs(&scene).answer.statement, &Budget::unlimited());
    assert_eq!(report.faults.iter().map(|fault| fault.code).collect::<Vec<_>>(), [FaultCode::MissingPart]);
}
