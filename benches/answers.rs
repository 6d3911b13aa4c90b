//! Whole answers: from the request body to the bytes of the response, the check included.
//!
//! Fails where the median over the scenes is not below 1 ms.

#[path = "cases/paper.rs"]
mod paper;

use core::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group, criterion_main};
use singulate::wire::{AnswerBody, RequestLimits, SceneBody, read_scene};
use singulate_planner::budget::Budget;
use singulate_planner::paper::plan_by;
use singulate_planner::plan::{Settings, plan};
use singulate_planner::scene::Scene;
use singulate_planner::search::SILENT;

use paper::paper_50;

const SCENES: u64 = 40;
const MAX_MEDIAN: Duration = Duration::from_millis(1);

fn paper_scenes(criterion: &mut Criterion) {
    let scenes: Vec<Scene> = (0..SCENES).map(paper_50).collect();
    let bodies: Vec<Vec<u8>> =
        scenes.iter().map(|scene| serde_json::to_vec(&SceneBody::new(scene, None)).expect("JSON")).collect();
    let mut group = criterion.benchmark_group("paper N=50");
    spread(&bodies);
    let mut next = bodies.iter().cycle();
    group.bench_function("body to body", |bencher| {
        bencher.iter(|| black_box(answer(next.next().expect("a cycle"))));
    });
    let mut next = scenes.iter().cycle();
    group.bench_function("plan alone", |bencher| {
        bencher.iter(|| {
            let scene = next.next().expect("a cycle");
            black_box(plan(scene, &Settings::default(), &Budget::unlimited(), SILENT).expect("checked"))
        });
    });
    group.finish();
}

/// Per scene the fastest of some runs; over the scenes the median and the worst.
fn spread(bodies: &[Vec<u8>]) {
    let fastest = |body: &Vec<u8>| {
        let run = |_| {
            let started = Instant::now();
            black_box(answer(body));
            started.elapsed()
        };
        (0..9).map(run).min().expect("some runs")
    };
    let mut times: Vec<Duration> = bodies.iter().map(fastest).collect();
    times.sort_unstable();
    println!(
        "paper N=50, {} scenes: median {:?}, worst {:?}",
        times.len(),
        times[times.len() / 2],
        times[times.len() - 1]
    );
    assert!(times[times.len() / 2] < MAX_MEDIAN, "the median is to be below {MAX_MEDIAN:?}");
}

fn answer(body: &[u8]) -> Vec<u8> {
    let request = read_scene(body, &RequestLimits::default()).expect("sound");
    let judged =
        plan_by(&request.methods, &request.scene, &request.settings, &Budget::unlimited(), SILENT).expect("checked");
    serde_json::to_vec(&AnswerBody::new(&request, &judged)).expect("JSON")
}

criterion_group!(benches, paper_scenes);
criterion_main!(benches);
