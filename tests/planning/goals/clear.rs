//! Clearing a table.

use nalgebra::Point2;
use singulate_planner::budget::Budget;
use singulate_planner::plan::{Settings, plan};
use singulate_planner::scene::{Goal, Scene, distance};
use singulate_planner::search::SILENT;
use singulate_planner::statement::{Statement, Step, Verdict};

use super::exhaustive::{Set, Trial};
use super::small::small;

/// Small scenes of which every order is tried.
const SCENES: usize = 500;

/// Small scenes that are to be cleared, each with its seed and its answer.
fn clearings() -> impl Iterator<Item = (u64, Scene, Statement)> {
    let scenes = (0..).map(|seed| (seed, small(seed))).filter(|(_, scene)| *scene.goal() == Goal::Clear);
    scenes.map(|(seed, scene)| {
        let stated = plan(&scene, &Settings::default(), &Budget::unlimited(), SILENT).unwrap().statement;
        (seed, scene, stated)
    })
}

fn set(scene: &Scene, ids: &[String]) -> Set {
    ids.iter().fold(0, |set, id| set | 1 << scene.find(id).unwrap().get())
}

fn gone(scene: &Scene, stated: &Statement) -> Vec<usize> {
    stated.steps().iter().map(|step| scene.find(step.object()).unwrap().get()).collect()
}

#[test]
fn a_clearing_takes_away_as_much_as_any_order_and_what_is_stuck_is_the_greatest_lock() {
    let (mut locked, mut short, mut cleared) = (0, 0, 0);
    for (seed, scene, stated) in clearings().take(SCENES) {
        let trial = Trial::new(&scene, true);
        let loose = trial.sets(0, |_| true).into_iter().fold(0, |all, set| all | set);
        let most = trial.sets(0, |set| trial.fits(set)).into_iter().map(Set::count_ones).max().unwrap() as usize;
        assert_eq!((stated.steps().len(), stated.proven), (most, Some(true)), "seed {seed}: {stated:?}");

        let stuck = trial.movable & !loose;
        let blocked = stated.stuck.as_ref().map_or(0, |lock| set(&scene, &lock.blocked));
        assert_eq!(blocked & trial.movable, stuck, "seed {seed}: {stated:?}");
        assert_eq!(stated.stuck.is_some(), stuck != 0, "seed {seed}");
        let core = stated.stuck.as_ref().map_or(0, |lock| set(&scene, &lock.core));
        assert!(core & !blocked == 0 && (core & stuck != 0 || stuck == 0), "seed {seed}: {stated:?}");

        let away = gone(&scene, &stated).iter().fold(0, |set, at| set | 1 << at);
        let fixed = scene.indices().filter(|&o| scene.object(o).fixed()).fold(0, |set, o| set | 1 << o.get());
        let all: Set = (1 << scene.objects().len()) - 1;
        assert_eq!(set(&scene, stated.left.as_ref().unwrap()), all & !away & !fixed, "seed {seed}");
        let verdict = if all & !away & !fixed == 0 { Verdict::Cleared } else { Verdict::PartlyCleared };
        assert_eq!(stated.verdict, Some(verdict), "seed {seed}");

        locked += usize::from(stuck != 0);
        short += usize::from(most < loose.count_ones() as usize);
        cleared += usize::from(verdict == Verdict::Cleared);
    }
    assert!(locked > 50 && short > 50 && cleared > 50, "{locked} {short} {cleared}");
}

#[test]
fn of_what_can_still_lead_to_the_greatest_number_the_nearest_goes_first() {
    for (seed, scene, stated) in clearings().take(SCENES) {
        let trial = Trial::new(&scene, true);
        let most = stated.steps().len();
        let (mut away, mut axis): (Set, Point2<f64>) = (0, scene.table().top().min());
        for (step, at) in stated.steps().iter().zip(gone(&scene, &stated)) {
            let next = trial.graspable(away) & trial.movable;
            let reaches = |object: usize| {
                let with = away | 1 << object;
                trial.fits(with) && greatest(&trial, with) == most
            };
            let far = |object: usize| distance(scene.objects()[object].footprint().at(), axis);
            let nearest = (0..scene.objects().len()).filter(|&object| next >> object & 1 == 1 && reaches(object));
            let nearest = nearest.min_by(|&a, &b| far(a).total_cmp(&far(b))).unwrap();
            assert_eq!(nearest, at, "seed {seed}: {stated:?}");
            assert!(matches!(step, Step::PickDrop(_)));
            away |= 1 << at;
            axis = scene.objects()[at].footprint().at();
        }
    }
}

/// The greatest number that any order takes away which begins with this set.
fn greatest(trial: &Trial<'_>, begun: Set) -> usize {
    let sets = trial.sets(0, |set| trial.fits(set));
    sets.into_iter().filter(|set| begun & !set == 0).map(Set::count_ones).max().unwrap_or_default() as usize
}
