//! Every golden scene through the planner.

use serde::Deserialize;
use serde_json::value::RawValue;
use singulate::wire::{RequestLimits, read_scene};
use singulate_planner::budget::Budget;
use singulate_planner::check::check;
use singulate_planner::cost::Cost;
use singulate_planner::plan::plan;
use singulate_planner::search::SILENT;
use singulate_planner::statement::Verdict;

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
    relocations: Option<u64>,
}

/// The least number of objects that meet all sets, by trying every choice for the first open set.
fn least_hitting_set<'a, T: PartialEq>(sets: &'a [Vec<T>], chosen: &mut Vec<&'a T>, limit: usize) -> Option<usize> {
    let Some(open) = sets.iter().find(|set| !set.iter().any(|member| chosen.contains(&member))) else {
        return Some(chosen.len());
    };
    if chosen.len() == limit {
        return None;
    }
    let mut best: Option<usize> = None;
    for member in open {
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
        let stated = plan(&request.scene, &request.settings, &Budget::unlimited(), SILENT).unwrap().statement;
        let verdict = match stated.verdict.unwrap() {
            Verdict::Graspable => "graspable",
            Verdict::Deadlock => "deadlock",
            Verdict::Relocate => {
                let counted = Cost::of_each(stated.steps().len());
                assert_eq!((stated.lower_bound, stated.optimal), (Some(counted), Some(true)), "{name}: {stated:?}");
                "relocate"
            }
            Verdict::NoSpace => {
                no_space.push(name);
                "relocate"
            }
            Verdict::TimedOut => unreachable!("the budget never ends"),
            Verdict::Cleared | Verdict::PartlyCleared => unreachable!("the goals are targets"),
        };
        assert_eq!(verdict, case.expected.verdict, "{name}");
        // A deadlock has no bound.
        let bound = stated.lower_bound.map(Cost::get);
        assert_eq!(bound, case.expected.relocations, "{name}");
        if let Some(bound) = bound {
            let (landmarks, bound) = (stated.landmarks.as_deref().unwrap(), usize::try_from(bound).unwrap());
            let proven = least_hitting_set(landmarks, &mut Vec::new(), bound);
            assert_eq!(proven, Some(bound), "{name}: {landmarks:?}");
        }
        let report = check(&request.scene, &stated, &Budget::unlimited());
        assert_eq!(report.faults, [], "{name}");
    }
    eprintln!("{} of {} golden scenes without space: {no_space:?}", no_space.len(), cases.len());
}
