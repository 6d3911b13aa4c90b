//! Generated scenes: no fault, no panic, the same bytes twice.

use std::collections::BTreeMap;

use singulate::experiments::{mixed, varied, wanting};
use singulate::wire::{AnswerBody, RequestLimits, SceneBody, read_plan, read_scene};
use singulate_planner::budget::Budget;
use singulate_planner::check::check;
use singulate_planner::paper::plan_by;
use singulate_planner::scene::{Scene, SceneDraft, SceneLimits};
use singulate_planner::search::SILENT;
use singulate_planner::statement::Verdict;

/// How many scenes; the continuous integration asks for more.
pub(crate) fn count(variable: &str, few: u64) -> u64 {
    std::env::var(variable).ok().map_or(few, |count| count.parse().expect("a number of scenes"))
}

/// The verdict by name, and the answer as it is served. The clock stands still, so that the statistics are the same too.
fn answer(body: &[u8]) -> (&'static str, Vec<u8>) {
    let request = read_scene(body, &RequestLimits::default()).unwrap();
    let judged = plan_by(&request.methods, &request.scene, &request.settings, &Budget::unlimited(), SILENT).unwrap();
    let stated = judged.statement();
    let name = match stated.verdict.unwrap() {
        Verdict::Relocate if stated.optimal != Some(true) => "relocate, above the bound",
        Verdict::PartlyCleared if stated.proven != Some(true) => "partly_cleared, not proven",
        Verdict::TimedOut => unreachable!("the budget never ends"),
        verdict => verdict.as_str(),
    };
    (name, serde_json::to_vec(&AnswerBody::new(&request, &judged)).unwrap())
}

/// Plans each scene twice and checks what is served. Returns how often each verdict came.
fn verdicts(name: &str, count: u64, draft: fn(u64) -> SceneDraft) -> BTreeMap<&'static str, u64> {
    let mut verdicts = BTreeMap::<&str, u64>::new();
    for seed in 0..count {
        let (scene, _) = Scene::new(draft(seed), &SceneLimits::default()).unwrap();
        let body = serde_json::to_vec(&SceneBody::new(&scene, None)).unwrap();
        let (verdict, served) = answer(&body);
        assert_eq!(answer(&body).1, served, "{name} {seed}: the same bytes on a second run");
        let stated = read_plan(&served, &scene, false).unwrap();
        assert_eq!(check(&scene, &stated, &Budget::unlimited()).faults, [], "{name} {seed}");
        *verdicts.entry(verdict).or_default() += 1;
    }
    eprintln!("{name}: {verdicts:?}");
    verdicts
}

#[test]
fn no_generated_scene_gets_an_answer_that_fails_its_check() {
    let verdicts = verdicts("target", count("GENERATED_SCENES", 500), varied);
    for name in ["graspable", "relocate", "deadlock"] {
        assert!(verdicts.contains_key(name), "no scene with the verdict {name}: {verdicts:?}");
    }
}

#[test]
fn no_generated_scene_of_mixed_shapes_gets_an_answer_that_fails_its_check() {
    let verdicts = verdicts("mixed", count("GENERATED_SHAPES", 300), |seed| mixed(&varied(seed), seed));
    for name in ["graspable", "relocate", "deadlock", "cleared", "partly_cleared"] {
        assert!(verdicts.contains_key(name), "no scene with the verdict {name}: {verdicts:?}");
    }
}

#[test]
fn no_generated_scene_with_a_goal_gets_an_answer_that_fails_its_check() {
    let verdicts = verdicts("goal", count("GENERATED_GOALS", 300), |seed| wanting(&varied(seed), seed));
    for name in ["graspable", "relocate", "deadlock", "cleared", "partly_cleared"] {
        assert!(verdicts.contains_key(name), "no scene with the verdict {name}: {verdicts:?}");
    }
}
