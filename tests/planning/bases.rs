//! Every golden base through the search.

use std::collections::{BTreeMap, HashMap};

use serde::Deserialize;
use singulate_planner::budget::Budget;
use singulate_planner::cost::Cost;
use singulate_planner::knowledge::{KnowledgeBase, derivable};
use singulate_planner::scene::ObjectIndex;
use singulate_planner::search::{Memory, Restriction, SILENT, SearchOutcome, least_within};

#[derive(Deserialize)]
struct Case {
    name: String,
    target: String,
    options: BTreeMap<String, Vec<Vec<String>>>,
    expected: Expected,
}

#[derive(Deserialize)]
struct Expected {
    verdict: String,
    relocations: Option<u64>,
}

/// Every base comes to its optimum, and each landmark holds.
fn solve_all(memory: &Memory) {
    let cases: Vec<Case> = serde_json::from_str(include_str!("../golden/bases.json")).unwrap();
    assert_eq!(cases.len(), 84);
    for case in cases {
        let index: HashMap<&str, ObjectIndex> =
            case.options.keys().enumerate().map(|(at, id)| (id.as_str(), ObjectIndex::new(at))).collect();
        let base: KnowledgeBase = case
            .options
            .values()
            .map(|options| options.iter().map(|option| option.iter().map(|id| index[id.as_str()]).collect()).collect())
            .collect();
        let target = index[case.target.as_str()];
        match least_within(memory, &base, target, &Restriction::default(), &Budget::unlimited(), SILENT) {
            SearchOutcome::Underivable => assert_eq!(case.expected.verdict, "deadlock", "{}", case.name),
            SearchOutcome::Least(found) => {
                assert_eq!(Some(found.bound.get()), case.expected.relocations, "{}", case.name);
                assert_eq!(Cost::of_each(found.derivation.order.len()), found.bound, "{}", case.name);
                for landmark in &found.landmarks {
                    let held = |object| object == target || landmark.contains(&object);
                    let closure = derivable(&base, held, &Budget::unlimited()).unwrap();
                    assert!(!closure.derives(target), "{}: {landmark:?} is no landmark", case.name);
                }
            }
            SearchOutcome::Interrupted(_) => unreachable!("the budget never ends"),
        }
    }
}

#[test]
fn every_golden_base_gets_its_optimum_and_each_landmark_holds() {
    solve_all(&Memory::default());
}

#[test]
fn limits_of_memory_take_no_golden_base_its_optimum() {
    solve_all(&Memory { words: 5, literals: 5 });
}
