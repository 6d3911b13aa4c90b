//! Shapes against discs: whole answers of tables of 50 objects, and how knowledge and deadlock grow with 2,000 rectangles.
//!
//! Fails where the median answer for shapes takes more than 3 times as long as that for discs, or the slope of log time over log N
//! is above 1.2.

mod cases;
#[path = "cases/slope.rs"]
mod slope;

use core::hint::black_box;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use singulate::experiments::shaped;
use singulate::wire::{AnswerBody, RequestLimits, SceneBody, read_scene};
use singulate_planner::budget::Budget;
use singulate_planner::knowledge::{SweptFinger, complete, derivable};
use singulate_planner::paper::plan_by;
use singulate_planner::scene::{GripperDraft, ObjectDraft, Scene, SceneDraft, ShapeDraft};
use singulate_planner::search::SILENT;
use slope::slope;

const TABLES: u64 = 41;
const MAX_RATIO: f64 = 3.0;
const SIZES: [usize; 6] = [50, 100, 200, 500, 1000, 2000];
const SCENES: u64 = 3;
const MAX_SLOPE: f64 = 1.2;

/// The fastest of some runs: the least disturbed one.
fn fastest<T>(runs: u32, mut run: impl FnMut() -> T) -> f64 {
    let timed = |_| {
        let started = Instant::now();
        black_box(run());
        started.elapsed()
    };
    (0..runs).map(timed).min().unwrap_or(Duration::ZERO).as_secs_f64() * 1e6
}

/// From the body of a request to the body of its answer, µs.
fn answer_time(draft: SceneDraft) -> f64 {
    let body = serde_json::to_vec(&SceneBody::new(&cases::scene(draft), None)).expect("a scene is JSON");
    fastest(7, || {
        let request = read_scene(&body, &RequestLimits::default()).expect("a sound scene");
        let (methods, settings) = (&request.methods, &request.settings);
        let judged = plan_by(methods, &request.scene, settings, &Budget::unlimited(), SILENT).expect("an answer");
        serde_json::to_vec(&AnswerBody::new(&request, &judged)).expect("an answer is JSON")
    })
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// Two jaws on the tables of the bench of growth, with 50 objects each.
fn two_jaws(seed: u64) -> SceneDraft {
    let draft = cases::equal_density(50, seed);
    let gripper = GripperDraft { fingers: Some(2.0), ..draft.gripper };
    SceneDraft { gripper, ..draft }
}

fn answers() -> bool {
    let discs = median((0..TABLES).map(|seed| answer_time(two_jaws(seed))).collect());
    let shapes = median((0..TABLES).map(|seed| answer_time(shaped(&two_jaws(seed), seed))).collect());
    let ratio = shapes / discs;
    println!(
        "median answer for 50 objects: discs {discs:.0} µs, shapes {shapes:.0} µs, {ratio:.2} times (at most {MAX_RATIO})"
    );
    ratio <= MAX_RATIO
}

/// The discs of a scene as rectangles within them.
fn rectangles(objects: usize, seed: u64) -> Scene {
    let mut draft = cases::equal_density(objects, seed);
    draft.gripper = GripperDraft { fingers: Some(2.0), ..draft.gripper };
    for (at, object) in draft.objects.iter_mut().enumerate() {
        let side = object.shape.disc_radius().unwrap_or_default();
        let shape = ShapeDraft::Rectangle { length: Some(1.6 * side), width: Some(1.1 * side), corner_radius: None };
        *object = ObjectDraft { shape, yaw: Some(cases::count(at % 60) / 10.0), ..object.clone() };
    }
    cases::scene(draft)
}

fn growth() -> bool {
    println!("{:>10} {:>12} {:>12}", "rectangles", "time (µs)", "per object");
    let mut points = Vec::new();
    for objects in SIZES {
        let times = (0..SCENES).map(|seed| {
            let scene = rectangles(objects, seed);
            fastest(9, || {
                let base = complete(&scene, &SweptFinger, &Budget::unlimited()).expect("within the limits");
                derivable(&base, |_| false, &Budget::unlimited()).expect("unlimited")
            })
        });
        let mean = times.sum::<f64>() / SCENES as f64;
        println!("{objects:>10} {mean:>12.1} {:>12.3}", mean / cases::count(objects));
        points.push((libm::log(cases::count(objects)), libm::log(mean)));
    }
    let slope = slope(&points);
    println!("slope of log time over log N, rectangles: {slope:.3} (at most {MAX_SLOPE})");
    slope <= MAX_SLOPE
}

fn main() -> ExitCode {
    if answers() & growth() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
