//! Our exact search on the instances that `run` gives to other solvers too.
//!
//! One line of JSON for each instance: the base, the target, our optimum and our time. With `--in-step` it waits for a
//! line on stdin before the next one, so that nobody computes while somebody is timed.

#[path = "../cases/mod.rs"]
mod cases;
mod instances;
mod synthetic;

use core::hint::black_box;
use std::env;
use std::io;
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use singulate_planner::budget::{Budget, Clock};
use singulate_planner::cost::Cost;
use singulate_planner::knowledge::KnowledgeBase;
use singulate_planner::scene::ObjectIndex;
use singulate_planner::search::{Restriction, SearchOutcome, least};

use instances::Instance;

/// Short work is done so often, and the fastest run counts: the least disturbed one. The other solvers get as many.
const RUNS: usize = 3;
/// What nobody else does, the way from a scene to its base, is held against a bound alone.
const RUNS_ALONE: usize = 15;
/// Work that took longer is not repeated.
const LONG: Duration = Duration::from_secs(1);

/// A class of instances and how many a full run takes.
struct Class {
    name: &'static str,
    full: usize,
    make: fn(usize) -> Instance,
}

const CLASSES: [Class; 6] = [
    Class { name: "paper", full: 120, make: instances::paper },
    Class { name: "mixed-80", full: 80, make: instances::mixed },
    Class { name: "pressed-150", full: 72, make: |number| instances::pressed(150, number) },
    Class { name: "pressed-300", full: 60, make: |number| instances::pressed(300, number) },
    Class { name: "pressed-600", full: 42, make: |number| instances::pressed(600, number) },
    Class { name: "synthetic", full: 144, make: synthetic::synthetic },
];
const CROWD: &str = "crowd-10000";
const CROWDS: u64 = 3;

fn main() {
    let arguments: Vec<String> = env::args().collect();
    let value = |flag: &str| arguments.iter().position(|a| a == flag).and_then(|at| arguments.get(at + 1));
    let per_class: Option<usize> = value("--per-class").map(|text| text.parse().expect("a count"));
    let limit = value("--time-limit").map_or(20.0, |text| text.parse().expect("seconds"));
    let wanted = |class: &str| value("--classes").is_none_or(|list| list.split(',').any(|name| name == class));
    let in_step = arguments.iter().any(|argument| argument == "--in-step");
    let print = |line: &Value| {
        println!("{line}");
        if in_step {
            io::stdin().read_line(&mut String::new()).expect("readable");
        }
    };
    for class in CLASSES.iter().filter(|class| wanted(class.name)) {
        for number in 0..per_class.unwrap_or(class.full) {
            print(&answer(class.name, &(class.make)(number), Duration::from_secs_f64(limit)));
        }
    }
    for seed in (0..CROWDS).filter(|_| wanted(CROWD)) {
        print(&crowd(seed));
    }
}

/// The fastest of so many runs.
fn fastest<T>(runs: usize, work: impl Fn() -> T) -> (T, Duration) {
    let run = || {
        let started = Instant::now();
        let result = black_box(work());
        (result, started.elapsed())
    };
    let mut best = run();
    for _ in 1..runs {
        if best.1 > LONG {
            break;
        }
        let next = run();
        if next.1 < best.1 {
            best = next;
        }
    }
    best
}

/// The wall's clock, from now on.
struct Wall(Instant);

impl Clock for Wall {
    fn elapsed(&self) -> Duration {
        self.0.elapsed()
    }

    fn cancelled(&self) -> bool {
        false
    }
}

fn answer(class: &str, instance: &Instance, limit: Duration) -> Value {
    let Instance { name, base, target, knowledge } = instance;
    let (outcome, time) = fastest(RUNS, || {
        let clock = Wall(Instant::now());
        least(base, *target, &Restriction::default(), &Budget::new(&clock, limit))
    });
    let (solved, optimum) = match outcome {
        SearchOutcome::Least(set) => (true, Some(set.bound)),
        SearchOutcome::Underivable => (true, None),
        SearchOutcome::Interrupted(_) => (false, None),
    };
    json!({
        "class": class, "name": name, "objects": base.len(), "target": target.get(), "options": options(base),
        "ours": {"solved": solved, "optimum": optimum.map(Cost::get), "seconds": time.as_secs_f64()},
        "knowledge_seconds": knowledge.map(|time| time.as_secs_f64()),
    })
}

/// No target: which objects can be derived at all?
fn crowd(seed: u64) -> Value {
    let scene = cases::scene(cases::equal_density(10_000, seed));
    let crowd = instances::crowd(&scene);
    json!({
        "class": CROWD, "name": format!("seed {seed}"), "objects": crowd.base.len(), "target": null,
        "options": options(&crowd.base),
        "ours": {"solved": true, "optimum": crowd.derivable, "seconds": crowd.closing.as_secs_f64()},
        "knowledge_seconds": (crowd.time - crowd.closing).as_secs_f64(),
    })
}

/// Per object, per option, its members.
fn options(base: &KnowledgeBase) -> Vec<Vec<Vec<usize>>> {
    let option = |members: &[ObjectIndex]| members.iter().map(|member| member.get()).collect();
    base.objects().map(|object| base.options(object).map(option).collect()).collect()
}
