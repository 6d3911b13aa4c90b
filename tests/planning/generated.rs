//! Generated scenes: no fault, no panic, the same bytes twice.

use singulate::budget::Budget;
use singulate::experiments::varied;
use singulate::plan::{Settings, Verdict, plan};
use singulate::scene::{Scene, SceneLimits};

/// How many scenes; the continuous integration asks for more.
fn count() -> u64 {
    std::env::var("GENERATED_SCENES").ok().map_or(500, |count| count.parse().expect("a number of scenes"))
}

#[test]
fn no_generated_scene_gets_an_answer_that_fails_its_check() {
    let mut verdicts = std::collections::BTreeMap::<&str, u64>::new();
    for seed in 0..count() {
        let (scene, _) = Scene::new(varied(seed), &SceneLimits::default()).expect("a sound scene");
        let answer =
            plan(&scene, &Settings::default(), &Budget::unlimited()).unwrap_or_else(|e| panic!("{seed}: {e:?}"));
        let again = plan(&scene, &Settings::default(), &Budget::unlimited()).expect("the same answer");
        assert_eq!(format!("{:?}", answer.verdict), format!("{:?}", again.verdict), "seed {seed}");
        let name = match &answer.verdict {
            Verdict::Graspable(_) => "graspable",
            Verdict::Relocate(plan) if plan.optimal() => "relocate",
            Verdict::Relocate(_) => "relocate, above the bound",
            Verdict::Deadlock(_) => "deadlock",
            Verdict::NoSpace(_) => "no_space",
            Verdict::TimedOut(_) => unreachable!("the budget never ends"),
        };
        *verdicts.entry(name).or_default() += 1;
    }
    eprintln!("{verdicts:?}");
    for name in ["graspable", "relocate", "deadlock"] {
        assert!(verdicts.contains_key(name), "no scene with the verdict {name}: {verdicts:?}");
    }
}
