//! Knowledge and deadlock from N = 50 to 10,000 at equal density: the slope of log time over log N.
//!
//! Fails where the slope is above 1.2.

mod cases;

use core::hint::black_box;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use singulate_planner::budget::Budget;
use singulate_planner::knowledge::{close, complete, swept_finger_options};
use singulate_planner::scene::Scene;

const SIZES: [usize; 8] = [50, 100, 200, 500, 1000, 2000, 5000, 10_000];
const SCENES: u64 = 3;
const MAX_SLOPE: f64 = 1.2;

/// The fastest of some runs: the least disturbed one.
fn time(scene: &Scene) -> Duration {
    let run = |_| {
        let started = Instant::now();
        let base = complete(scene, swept_finger_options, &Budget::unlimited()).expect("within the limits");
        black_box(close(&base, |_| false, &Budget::unlimited()).expect("unlimited"));
        started.elapsed()
    };
    (0..9).map(run).min().expect("some runs")
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
    if slope <= MAX_SLOPE { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Least squares.
fn slope(points: &[(f64, f64)]) -> f64 {
    let n = cases::count(points.len());
    let (x, y) = points.iter().fold((0.0, 0.0), |(x, y), point| (x + point.0 / n, y + point.1 / n));
    let (above, below) =
        points.iter().fold((0.0, 0.0), |(a, b), p| (a + (p.0 - x) * (p.1 - y), b + (p.0 - x) * (p.0 - x)));
    above / below
}
