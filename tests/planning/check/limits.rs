//! Time that runs out, and answers by strangers.

use core::cell::Cell;
use core::time::Duration;

use singulate_planner::budget::{Budget, Clock};
use singulate_planner::check::FaultCode::*;
use singulate_planner::check::{MAX_FAULTS, check};
use singulate_planner::cost::Cost;
use singulate_planner::scene::Scene;
use singulate_planner::statement::{Deadlock, StatedGrasp, Statement, Verdict};

use super::scenes::*;

/// A clock that goes on by 1 ms whenever it is asked.
#[derive(Default)]
struct Ticking(Cell<u32>);

impl Clock for Ticking {
    fn elapsed(&self) -> Duration {
        self.0.set(self.0.get() + 1);
        Duration::from_millis(self.0.get().into())
    }

    fn cancelled(&self) -> bool {
        false
    }
}

/// `columns` × `rows` discs packed as honeycombs are; the rim is fixed. Nothing inside can be lifted.
fn honeycomb(columns: u32, rows: u32) -> Scene {
    let side = f64::from(columns + rows);
    let mut builder = Builder::new(3).table([-1.0, -1.0, side, side]);
    for n in 0..columns * rows {
        let (column, row) = (n % columns, n / columns);
        let x = 0.1 * f64::from(column) + 0.05 * f64::from(row % 2);
        let id = format!("d{n}");
        builder = builder.disc(&id, x, 0.1 * 0.75_f64.sqrt() * f64::from(row), 0.05);
    }
    let rim = |n: u32| [0, columns - 1].contains(&(n % columns)) || [0, rows - 1].contains(&(n / columns));
    for n in (0..columns * rows).filter(|n| rim(*n)) {
        builder = builder.fix(&format!("d{n}"));
    }
    builder.build(&format!("d{}", columns + 1))
}

fn all_locked(scene: &Scene) -> Statement {
    let all: Vec<String> = scene.objects().iter().map(|object| object.id().to_owned()).collect();
    let deadlock = Some(Deadlock { blocked: all.clone(), core: all });
    Statement { verdict: Some(Verdict::Deadlock), deadlock, ..Statement::default() }
}

#[test]
fn a_lock_that_is_not_checked_to_its_end_is_not_confirmed() {
    let scene = honeycomb(20, 20);
    let stated = all_locked(&scene);
    assert_valid(&scene, &stated);
    let mut interrupted = 0;
    for deadline in 1..200 {
        let clock = Ticking::default();
        let report = check(&scene, &stated, &Budget::new(&clock, Duration::from_millis(deadline)));
        if !report.interrupted {
            assert!(report.faults.is_empty());
            break;
        }
        interrupted += 1;
        assert_eq!(codes(&report), [LockUnconfirmed]);
    }
    // Some 400 objects with some ten neighbours each, at about 100 a look.
    assert!((10..150).contains(&interrupted), "{interrupted}");
}

/// The proof for the gate, with its three landmarks repeated until there are `landmarks`.
fn bounded(landmarks: usize) -> Statement {
    let singles = ["cap", "west", "east"].map(|id| ids(&[id]));
    let landmarks = (0..landmarks).map(|n| singles[n % 3].clone()).collect();
    let needed = Some(ids(&["cap", "west", "east"]));
    Statement { lower_bound: Some(Cost::new(3)), landmarks: Some(landmarks), needed, ..Statement::default() }
}

#[test]
fn a_bound_that_is_not_checked_to_its_end_is_not_confirmed() {
    let scene = gate_with_posts();
    // So many copies that the budget is looked at while they are read.
    let stated = bounded(3000);
    assert_valid(&scene, &stated);
    let ended = check(&scene, &stated, &Budget::new(&Ticking::default(), Duration::ZERO));
    assert!(ended.interrupted && ended.proven_bound == Cost::ZERO);
    assert_eq!(codes(&ended), [BoundUnconfirmed]);
    for deadline in 1..100 {
        let clock = Ticking::default();
        let report = check(&scene, &stated, &Budget::new(&clock, Duration::from_millis(deadline)));
        assert!(report.proven_bound <= Cost::new(3));
        assert_eq!(report.proven_bound < Cost::new(3), codes(&report) == [BoundUnconfirmed]);
    }
}

#[test]
fn a_short_plan_is_replayed_even_when_time_is_up() {
    let stated = Statement { landmarks: None, lower_bound: None, optimal: None, ..gate_plan() };
    let report = check(&gate_with_posts(), &stated, &Budget::new(&Ticking::default(), Duration::ZERO));
    assert!(report.faults.is_empty() && !report.interrupted);
}

#[test]
fn a_pile_of_steps_ends_with_the_budget() {
    let scene = honeycomb(40, 40);
    let inner: Vec<String> = scene.objects().iter().filter(|object| !object.fixed()).map(|o| o.id().into()).collect();
    // Everything is put on one heap, again and again.
    let steps = (0..10_000).map(|n| step(&inner[1 + n % (inner.len() - 1)], [60.0, 60.0], 0.0, 0.0)).collect();
    let target_grasp = Some(StatedGrasp { at: None, yaw: 0.0, slack: None });
    let stated = Statement { relocations: Some(steps), target_grasp, ..Statement::default() };
    let report = check(&scene, &stated, &Budget::new(&Ticking::default(), Duration::from_millis(50)));
    assert!(report.interrupted);
    assert_eq!(report.faults.len(), MAX_FAULTS);
}

#[test]
fn stated_gaps_end_with_the_budget_too() {
    // So few steps without gaps are replayed in any case. A gap looks at every place of the steps: nothing stands on them.
    let scene = Builder::new(2).disc("target", 1.9, 0.1, 0.01).disc("cup", 1.0, 1.0, 0.01).build("target");
    let place = |n: usize| [0.2 + n as f64 * 1e-3, 0.2 + (n * 7919 % 1_200) as f64 * 1e-3];
    let report = |gap: Option<f64>| {
        let mut stated = Statement {
            relocations: Some((0..1_200).map(|n| step("cup", place(n), 0.0, 0.0)).collect()),
            target_grasp: Some(StatedGrasp { at: None, yaw: 0.0, slack: None }),
            ..Statement::default()
        };
        for n in 0..1_200 {
            step_mut(&mut stated, n).from = None;
            step_mut(&mut stated, n).gap = gap;
        }
        check(&scene, &stated, &Budget::new(&Ticking::default(), Duration::ZERO))
    };
    assert!(!report(None).has(ReplayUnconfirmed));
    assert!(report(Some(1.0)).has(ReplayUnconfirmed));
}
