//! A target, one of several candidates, several objects that are all taken away.

use singulate_planner::budget::Budget;
use singulate_planner::cost::Cost;
use singulate_planner::plan::{Settings, plan};
use singulate_planner::scene::{Destination, Goal, Scene};
use singulate_planner::search::SILENT;
use singulate_planner::statement::{Statement, Step, Verdict};

use super::exhaustive::{Set, Trial};
use super::small::small;

/// Small scenes of which every order is tried.
const SCENES: usize = 500;

/// True if the goal is reached once the set is gone.
fn reached(trial: &Trial<'_>, gone: Set) -> bool {
    let bits = |objects: &[_]| {
        objects.iter().fold(0, |set: Set, object: &singulate_planner::scene::ObjectIndex| set | 1 << object.get())
    };
    let goal = trial.scene.goal();
    let wanted = bits(goal.wanted_away());
    trial.graspable(gone) & bits(goal.candidates()) != 0 || wanted != 0 && wanted & !gone == 0
}

/// The fewest moves that reach the goal, places ignored, and the same with no more objects at drop-offs than these hold.
fn fewest(scene: &Scene) -> (Option<u32>, Option<u32>) {
    let leaves = scene.destination() == Destination::DropOff;
    let trial = Trial::new(scene, leaves);
    let held = scene.goal().candidates().iter().fold(0, |set, object| set | 1 << object.get());
    let least = |sets: Vec<Set>| sets.into_iter().filter(|&set| reached(&trial, set)).map(Set::count_ones).min();
    let whole = least(trial.sets(held, |_| true));
    (whole, if leaves { least(trial.sets(held, |set| trial.fits(set))) } else { whole })
}

fn check(seed: u64, scene: &Scene, stated: &Statement) -> &'static str {
    let (bound, with_room) = fewest(scene);
    let Some(bound) = bound else {
        assert_eq!(stated.verdict, Some(Verdict::Deadlock), "seed {seed}: {stated:?}");
        let lock = stated.deadlock.as_ref().unwrap();
        let holds = |object| {
            let id = scene.object(object).id();
            lock.core.iter().any(|member| member == id) && lock.blocked.iter().any(|member| member == id)
        };
        assert!(scene.goal().candidates().iter().all(|&candidate| holds(candidate)), "seed {seed}: {stated:?}");
        let wanted = scene.goal().wanted_away();
        assert!(wanted.is_empty() || wanted.iter().any(|&object| holds(object)), "seed {seed}: {stated:?}");
        return "deadlock";
    };
    assert_eq!(stated.lower_bound, Some(Cost::new(u64::from(bound))), "seed {seed}: {stated:?}");
    match stated.verdict.unwrap() {
        Verdict::Graspable => assert_eq!(bound, 0, "seed {seed}"),
        Verdict::Relocate => {
            let least = with_room.expect("room for a plan that passed its check");
            assert!(stated.cost.unwrap().get() >= u64::from(least), "seed {seed}: {stated:?}");
            let only_drops = scene.destination() == Destination::DropOff;
            assert!(!only_drops || stated.cost.unwrap().get() == u64::from(least), "seed {seed}: {stated:?}");
        }
        Verdict::NoSpace => {
            // Where all goes to drop-offs, room is the only thing that can be short.
            assert!(scene.destination() != Destination::DropOff || with_room.is_none(), "seed {seed}: {stated:?}");
        }
        verdict => panic!("seed {seed}: {verdict:?}"),
    }
    if let Some(target) = &stated.target {
        assert!(scene.goal().is_candidate(scene.find(target).unwrap()), "seed {seed}");
    }
    let dropped = |step: &Step| matches!(step, Step::PickDrop(_));
    for &wanted in scene.goal().wanted_away().iter().filter(|_| !stated.steps().is_empty()) {
        let id = scene.object(wanted).id();
        let own: Vec<&Step> = stated.steps().iter().filter(|step| step.object() == id).collect();
        assert!(own.len() == 1 && dropped(own[0]), "seed {seed}: {stated:?}");
    }
    stated.verdict.map_or("none", Verdict::as_str)
}

#[test]
fn the_bound_is_what_trying_every_order_finds() {
    let (mut tried, mut verdicts) = (0, std::collections::BTreeMap::<&str, usize>::new());
    let mut kinds = [0; 3];
    for seed in 0.. {
        if tried == SCENES {
            break;
        }
        let scene = small(seed);
        let kind = match scene.goal() {
            Goal::AnyOf(_) => 0,
            Goal::AllOf(_) => 1,
            Goal::Target(_) if !scene.drop_offs().is_empty() => 2,
            _ => continue,
        };
        kinds[kind] += 1;
        tried += usize::from(kind < 2);
        let stated = plan(&scene, &Settings::default(), &Budget::unlimited(), SILENT).unwrap().statement;
        *verdicts.entry(check(seed, &scene, &stated)).or_default() += 1;
    }
    eprintln!("{verdicts:?} {kinds:?}");
    assert!(kinds.iter().all(|count| *count > 100), "{kinds:?}");
    for verdict in ["graspable", "relocate", "deadlock", "no_space"] {
        assert!(verdicts.get(verdict).is_some_and(|count| *count > 2), "{verdicts:?}");
    }
}
