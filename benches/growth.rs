//! Knowledge and deadlock from N = 50 to 10,000 at equal density: the slope of log time over log N. And the survey of tables on
//! which each object stands loose, and their clearing, checked.
//!
//! Fails where a slope is above 1.2, where the survey takes more than 1.5 times as long for each of 9,216 objects as for
//! each of 144, or more than a second for 10,000.

mod cases;
#[path = "cases/slope.rs"]
mod slope;

use core::hint::black_box;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use singulate_planner::budget::Budget;
use singulate_planner::knowledge::{SweptFinger, complete, derivable};
use singulate_planner::plan::{Settings, plan, survey};
use singulate_planner::scene::{
    DropOffDraft, GoalDraft, ObjectDraft, RectangleDraft, Scene, SceneDraft, ShapeDraft, TableDraft,
};
use singulate_planner::search::SILENT;
use singulate_planner::statement::Verdict;
use slope::slope;

const SIZES: [usize; 8] = [50, 100, 200, 500, 1000, 2000, 5000, 10_000];
const SCENES: u64 = 3;
const MAX_SLOPE: f64 = 1.2;
/// Objects on a side of the cleared tables.
const CLEARED_SIDES: [usize; 6] = [10, 18, 32, 50, 71, 100];
/// Objects on a side of the surveyed tables.
const SIDES: [usize; 4] = [12, 48, 96, 100];
/// Of the time for each object, from the smallest to 96 x 96.
const MAX_SURVEY_GROWTH: f64 = 1.5;
const MAX_SURVEY: Duration = Duration::from_secs(1);

/// The fastest of some runs: the least disturbed one.
fn time(scene: &Scene) -> Duration {
    let run = |_| {
        let started = Instant::now();
        let base = complete(scene, &SweptFinger, &Budget::unlimited()).expect("within the limits");
        black_box(derivable(&base, |_| false, &Budget::unlimited()).expect("unlimited"));
        started.elapsed()
    };
    (0..9).map(run).min().expect("some runs")
}

/// The fastest of some surveys.
fn survey_time(scene: &Scene) -> Duration {
    let run = |_| {
        let started = Instant::now();
        black_box(survey(scene, &Budget::unlimited()).expect("within the limits"));
        started.elapsed()
    };
    (0..5).map(run).min().expect("some runs")
}

/// Discs of 4 cm on a square grid of 30 cm, far beyond the reach of the gripper.
fn loose(side: usize) -> SceneDraft {
    let at = |n: usize| 0.15 + 0.3 * cases::count(n);
    let places = (0..side).flat_map(|row| (0..side).map(move |column| (at(column), at(row))));
    let objects = places.enumerate().map(|(n, (x, y))| ObjectDraft {
        id: Some(format!("d{n}")),
        x: Some(x),
        y: Some(y),
        shape: ShapeDraft::disc(0.04),
        ..ObjectDraft::default()
    });
    let length = Some(0.3 * cases::count(side));
    let top = RectangleDraft { x_min: Some(0.0), y_min: Some(0.0), x_max: length, y_max: length };
    SceneDraft {
        table: TableDraft { top, keep_out: Vec::new() },
        objects: objects.collect(),
        goal: Some(GoalDraft::Target("d0".to_owned())),
        ..cases::equal_density(50, 0)
    }
}

/// The fastest of some clearings.
fn clearing_time(scene: &Scene) -> Duration {
    let run = |_| {
        let started = Instant::now();
        let answer = plan(scene, &Settings::default(), &Budget::unlimited(), SILENT).expect("within the limits");
        assert_eq!(answer.statement.verdict, Some(Verdict::Cleared));
        started.elapsed()
    };
    (0..5).map(run).min().expect("some runs")
}

fn clearings() -> bool {
    println!("{:>8} {:>12} {:>12}", "cleared", "time (µs)", "per object");
    let points = CLEARED_SIDES.map(|side| {
        let goal = Some(GoalDraft::Clear);
        let tray = DropOffDraft { id: Some("tray".to_owned()), ..DropOffDraft::default() };
        let scene = cases::scene(SceneDraft { goal, drop_offs: Some(vec![tray]), ..loose(side) });
        let (objects, time) = (cases::count(side * side), clearing_time(&scene).as_secs_f64() * 1e6);
        println!("{objects:>8} {time:>12.0} {:>12.3}", time / objects);
        (libm::log(objects), libm::log(time))
    });
    let slope = slope(&points);
    println!("slope of log time over log N, clearing: {slope:.3} (at most {MAX_SLOPE})");
    slope <= MAX_SLOPE
}

fn surveys() -> bool {
    println!("{:>8} {:>12} {:>12}", "surveyed", "time (µs)", "per object");
    let times = SIDES.map(|side| {
        let (objects, time) = (side * side, survey_time(&cases::scene(loose(side))));
        let per_object = time.as_secs_f64() * 1e6 / cases::count(objects);
        println!("{objects:>8} {:>12.0} {per_object:>12.3}", time.as_secs_f64() * 1e6);
        (time, per_object)
    });
    let growth = times[2].1 / times[0].1;
    println!("per object {growth:.2} times from 144 to 9,216 (at most {MAX_SURVEY_GROWTH}); 10,000 within 1 s");
    growth <= MAX_SURVEY_GROWTH && times[3].0 <= MAX_SURVEY
}

fn main() -> ExitCode {
    println!("{:>8} {:>12} {:>12}", "objects", "time (µs)", "per object");
    let mut points = Vec::new();
    for objects in SIZES {
        let scenes = (0..SCENES).map(|seed| cases::scene(cases::equal_density(objects, seed)));
        let times: Vec<f64> = scenes.map(|scene| time(&scene).as_secs_f64() * 1e6).collect();
        let mean = times.iter().sum::<f64>() / cases::count(times.len());
        println!("{objects:>8} {mean:>12.1} {:>12.3}", mean / cases::count(objects));
        points.push((libm::log(cases::count(objects)), libm::log(mean)));
    }
    let slope = slope(&points);
    println!("slope of log time over log N: {slope:.3} (at most {MAX_SLOPE})");
    if surveys() & clearings() && slope <= MAX_SLOPE { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
