//! Every golden scene through the planner.

use serde::Deserialize;
use serde_json::value::RawValue;
use singulate::wire::{RequestLimits, read_scene};
use singulate_planner::budget::Budget;
use singulate_planner::plan::{Claim, Verdict, check, plan};

#[derive(Deserialize)]
struct Case<'a> {
    name: String,
    #[serde(borrow)]
    scene: &'a RawValue,
    expected: Expected,
}

#[derive(Deserialize)]
struct Expected {
    verdict: String,
    relocations: Option<usize>,
}

/// The least number of objects that meet all sets, by trying every choice for the first open set.
fn least_hitting_set<T: PartialEq + Copy>(sets: &[Vec<T>], chosen: &mut Vec<T>, limit: usize) -> Option<usize> {
    let Some(open) = sets.iter().find(|set| !set.iter().any(|member| chosen.contains(member))) else {
        return Some(chosen.len());
    };
    if chosen.len() == limit {
        return None;
    }
    let mut best: Option<usize> = None;
    for &member in open {
        chosen.push(member);
        let limit = best.map_or(limit, |best| best - 1);
        best = least_hitting_set(sets, chosen, limit).or(best);
        chosen.pop();
    }
    best
}

#[test]
fn every_golden_scene_gets_its_verdict_and_its_proven_optimum() {
    let cases: Vec<Case<'_>> = serde_json::from_str(include_str!("../golden/scenes.json")).unwrap();
    assert_eq!(cases.len(), 70);
    let mut no_space = Vec::new();
    for case in &cases {
        let name = &case.name;
        let request = read_scene(case.scene.get().as_bytes(), &RequestLimits::default()).unwrap();
        let answer = plan(&request.scene, &request.settings, &Budget::unlimited()).unwrap();
        let (verdict, bound) = match &answer.verdict {
            Verdict::Graspable(_) => ("graspable", None),
            Verdict::Deadlock(_) => ("deadlock", None),
            Verdict::Relocate(plan) => {
                assert!(plan.optimal(), "{name}: {} relocations, bound {:?}", plan.cost(), plan.bound);
                ("relocate", plan.bound.as_ref())
            }
            Verdict::NoSpace(rest) => {
                no_space.push(name);
                ("relocate", rest.bound.as_ref())
            }
            Verdict::TimedOut(_) => unreachable!("the budget never ends"),
        };
        assert_eq!(verdict, case.expected.verdict, "{name}");
        if let Some(bound) = bound {
            assert_eq!(Some(bound.cost), case.expected.relocations, "{name}");
            let proven = least_hitting_set(&bound.landmarks, &mut Vec::new(), bound.cost);
            assert_eq!(proven, Some(bound.cost), "{name}: {:?}", bound.landmarks);
        }
        let report = check::check(&request.scene, &Claim::of(&request.scene, &answer), &Budget::unlimited());
        assert_eq!(report.faults, [], "{name}");
    }
    eprintln!("{} of {} golden scenes without space: {no_space:?}", no_space.len(), cases.len());
}
