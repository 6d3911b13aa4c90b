//! What the README and the page of the command line show is what the commands print.

use std::path::Path;

use serde_json::Value;

use crate::{answered, run};

const README: &str = include_str!("../../README.md");
const COMMAND_LINE: &str = include_str!("../../docs/command-line.md");
const EXAMPLE: &str = "src/cli/example.json";
const DEADLOCK: &str = "client-examples/scenes/deadlock.json";

/// The path of one of the crate's files.
fn of_the_crate(file: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(file).to_str().unwrap().to_owned()
}

/// The page's fenced block of this kind.
fn block<'a>(page: &'a str, kind: &str) -> &'a str {
    let (_, rest) = page.split_once(&format!("```{kind}\n")).unwrap();
    rest.split_once("```").unwrap().0
}

fn without_statistics(text: &str) -> Value {
    let mut value: Value = serde_json::from_str(text).unwrap();
    value.as_object_mut().unwrap().remove("statistics").unwrap();
    value
}

#[test]
fn the_readme_has_at_most_200_lines() {
    assert!(README.lines().count() <= 200, "{} lines", README.lines().count());
}

/// The README shows the scene's picture and links the scene.
#[track_caller]
fn drawn(scene: &str, name: &str, picture: &str) {
    let drawn = answered(run(&["plan", &of_the_crate(scene), "--format", "svg"]));
    assert!(drawn == picture, "redraw it: cargo run -- plan {scene} --format svg > {name}");
    assert!(README.contains(&format!("]({name})")) && README.contains(&format!("]({scene})")), "{name} {scene}");
}

#[test]
fn the_picture_is_what_plan_draws() {
    drawn(EXAMPLE, "docs/example.svg", include_str!("../../docs/example.svg"));
}

#[test]
fn the_picture_of_the_deadlock_is_what_plan_draws() {
    drawn(DEADLOCK, "docs/deadlock.svg", include_str!("../../docs/deadlock.svg"));
}

#[test]
fn the_scene_is_the_example_and_the_answer_is_what_plan_says() {
    let shown: Value = serde_json::from_str(block(README, "json scene")).unwrap();
    let example = of_the_crate(EXAMPLE);
    assert_eq!(shown, serde_json::from_str::<Value>(&std::fs::read_to_string(&example).unwrap()).unwrap());
    let answer = answered(run(&["plan", &example]));
    assert_eq!(without_statistics(block(README, "json answer")), without_statistics(&answer));
}

#[test]
fn the_deadlock_is_what_plan_says() {
    let answer = answered(run(&["plan", &of_the_crate(DEADLOCK)]));
    assert_eq!(without_statistics(block(README, "json deadlock")), without_statistics(&answer));
}

#[test]
fn the_text_is_what_plan_says_but_for_the_times() {
    let text = answered(run(&["plan", &of_the_crate(EXAMPLE), "--format", "text"]));
    let (paragraphs, times) = text.trim_end().rsplit_once("\n\n").unwrap();
    assert!(times.contains("ms in all"), "{times}");
    assert_eq!(block(COMMAND_LINE, "text plan").trim_end(), paragraphs);
}

#[test]
fn every_command_is_listed() {
    let help = answered(run(&["--help"]));
    let (_, commands) = help.split_once("Commands:\n").unwrap();
    let names = commands.lines().map_while(|line| line.split_whitespace().next());
    let names: Vec<&str> = names.filter(|name| *name != "help").collect();
    assert!(names.len() > 7, "{names:?}");
    for name in names {
        assert!(COMMAND_LINE.contains(&format!("| `singulate {name}")), "{name}");
    }
}

#[test]
fn every_verdict_has_its_row() {
    let document: Value = serde_json::from_str(include_str!("../../openapi/openapi.json")).unwrap();
    let words = document["components"]["schemas"]["VerdictWord"]["enum"].as_array().unwrap().clone();
    assert!(words.len() > 4, "{words:?}");
    for word in words {
        assert!(README.contains(&format!("\n| `{}` | ", word.as_str().unwrap())), "{word}");
    }
}

#[test]
fn every_path_is_listed() {
    let document: Value = serde_json::from_str(include_str!("../../openapi/openapi.json")).unwrap();
    for (path, operations) in document["paths"].as_object().unwrap() {
        for method in operations.as_object().unwrap().keys() {
            assert!(README.contains(&format!("| `{} {path}` |", method.to_uppercase())), "{method} {path}");
        }
    }
}
