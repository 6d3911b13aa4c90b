//! The page of errors names every word that the code can say, and no other.

use std::collections::BTreeSet;

use serde_json::Value;

use crate::{failed, file, run};

const PAGE: &str = include_str!("../../docs/errors.md");

/// The cells of each row of the section's table, from the left.
fn rows(section: &str) -> Vec<Vec<&'static str>> {
    let text = PAGE.split(&format!("\n## {section}\n")).nth(1).unwrap().split("\n## ").next().unwrap();
    let rows = text.lines().filter(|line| line.starts_with("| ")).skip(2);
    rows.map(|row| row.trim_matches('|').split(" | ").map(str::trim).collect()).collect()
}

/// The words between backticks in one column of the section's table.
fn words(section: &str, column: usize) -> BTreeSet<String> {
    let cells = rows(section).into_iter().filter_map(|row| row[column].strip_prefix('`')?.strip_suffix('`'));
    cells.map(str::to_owned).collect()
}

/// An enumeration of the interface document, which is made from the code.
fn enumerated(name: &str) -> BTreeSet<String> {
    let document: Value = serde_json::from_str(include_str!("../../openapi/openapi.json")).unwrap();
    let words = document["components"]["schemas"][name]["enum"].as_array().unwrap().clone();
    words.iter().map(|word| word.as_str().unwrap().rsplit(':').next().unwrap().to_owned()).collect()
}

/// The words that a `match` of this function gives, which the compiler keeps complete.
fn matched(source: &str, function: &str) -> BTreeSet<String> {
    let body = source.split(&format!("fn {function}(")).nth(1).unwrap().split("\n    }\n").next().unwrap();
    let words: Vec<_> = body.split("=> \"").skip(1).map(|rest| rest.split('"').next().unwrap().to_owned()).collect();
    assert!(words.len() > 5, "the words of '{function}' are read");
    words.into_iter().collect()
}

#[test]
fn every_problem_is_explained_with_its_status() {
    assert_eq!(words("Problems", 1), enumerated("ProblemKind"));
    let source = include_str!("../../src/wire/problem.rs");
    let statuses: BTreeSet<(String, String)> = source
        .lines()
        .filter_map(|line| {
            let (name, rest) = line.trim().strip_prefix("Self::")?.split_once(" => (")?;
            Some((snake(name), rest.split(',').next()?.to_owned()))
        })
        .collect();
    let listed = rows("Problems").into_iter().map(|row| (row[1].trim_matches('`').to_owned(), row[0].to_owned()));
    assert_eq!(listed.collect::<BTreeSet<_>>(), statuses);
}

fn snake(name: &str) -> String {
    let words = name.split_inclusive(|_: char| true).flat_map(|letter| {
        let capital = letter.chars().all(char::is_uppercase);
        [if capital { "_" } else { "" }.to_owned(), letter.to_lowercase()]
    });
    words.collect::<String>().trim_start_matches('_').to_owned()
}

#[test]
fn every_fault_of_a_request_is_explained() {
    assert_eq!(words("Faults of a request", 0), enumerated("ErrorCode"));
}

#[test]
fn every_warning_is_explained() {
    let mut listed = words("Warnings", 0);
    // These are found while the request is read.
    let of_scenes = ["overlap", "fingers_overlap", "hangs_over_table", "wide_yaw_tolerance", "out_of_proportion"];
    let of_goals = ["too_wide", "unknown_object", "no_drop_off", "id_length"];
    let of_shapes = ["no_grasp", "convex_hull", "default_grasps", "unknown_height", "axis_beside_object"];
    for word in [&of_scenes[..], &of_goals, &of_shapes].concat() {
        assert!(listed.remove(word) && enumerated("ErrorCode").contains(word), "{word}");
    }
    assert_eq!(listed, matched(include_str!("../../planner/src/paper/warning.rs"), "code"));
}

#[test]
fn every_fault_of_a_plan_is_explained() {
    let mut codes = matched(include_str!("../../planner/src/check/fault.rs"), "name");
    // No code of the checker: it says so by a field of its own.
    assert!(include_str!("../../src/wire/verification.rs").contains("of_answer(\"interrupted\""));
    codes.insert("interrupted".to_owned());
    assert_eq!(words("Faults of a plan", 0), codes);
}

/// The anchors of the page's rows.
fn anchors() -> BTreeSet<&'static str> {
    let anchors: Vec<&str> = PAGE.split("<a id=\"").skip(1).map(|rest| rest.split('"').next().unwrap()).collect();
    let distinct: BTreeSet<&str> = anchors.iter().copied().collect();
    assert_eq!(anchors.len(), distinct.len(), "no anchor is there twice");
    distinct
}

#[test]
fn every_entry_that_answers_refer_to_exists() {
    for (section, column, prefix) in
        [("Problems", 1, "problem-"), ("Faults of a request", 0, ""), ("Faults of a plan", 0, "plan-")]
    {
        for row in rows(section) {
            let word = row[column].trim_matches('`');
            let anchor = format!("<a id=\"{prefix}{word}\"></a>");
            assert!(row[column + 1].starts_with(&anchor), "the row of {word} has no {anchor}");
        }
    }
}

#[test]
fn every_row_has_a_cause_and_a_cure() {
    for section in ["Problems", "Faults of a request", "Warnings", "Faults of a plan"] {
        for row in rows(section) {
            let columns = if section == "Problems" { 4 } else { 3 };
            assert_eq!(row.len(), columns, "{row:?}");
            assert!(row.iter().all(|cell| !cell.is_empty()), "{row:?}");
        }
    }
}

#[test]
fn the_problem_on_the_page_is_what_the_program_prints() {
    let text = PAGE.split("```json problem\n").nth(1).unwrap().split("```").next().unwrap();
    let shown: Value = serde_json::from_str(text).unwrap();
    let mut scene: Value = serde_json::from_str(crate::scenes::CROWD).unwrap();
    scene["objects"][0]["radius"] = serde_json::json!(-0.04);
    scene["target"] = serde_json::json!("saucer");
    let told = failed(&run(&["plan", file("errors.json", &scene.to_string()).to_str().unwrap()]), 2);
    for fault in shown["errors"].as_array().unwrap() {
        let words = ["code", "pointer", "detail"].map(|name| fault[name].as_str().unwrap());
        let see = fault["see"].as_str().unwrap();
        assert!(told.contains(&format!("{} ({see})", words.join("  "))), "{told}");
        assert!(anchors().contains(see.strip_prefix("docs/errors.md#").unwrap()), "{see}");
    }
    assert_eq!(told.lines().count(), shown["errors"].as_array().unwrap().len() + 1, "{told}");
}

#[test]
fn a_file_that_is_no_json_is_told_what_stands_in_it() {
    let told = |name: &str, text: &str| failed(&run(&["plan", file(name, text).to_str().unwrap()]), 2);
    let broken = crate::scenes::ALONE.replace("\"x\": 0.5", "\"x\": NaN");
    let said = told("nan.json", &broken);
    assert!(said.contains("NaN stands at line 3 column 36, in /objects/0/x of object 'cup'"), "{said}");
    assert_eq!(said.lines().count(), 1, "{said}");
    let said = told("nans.json", &broken.replace("\"y\": 0.5", "\"y\": -Infinity"));
    assert!(said.contains("-Infinity stands at line 3 column 46, in /objects/0/y of object 'cup'"), "{said}");
    assert_eq!(said.lines().count(), 2, "{said}");
    assert!(told("comment.json", "{} # done").contains("a comment stands at line 1 column 4"));
}
