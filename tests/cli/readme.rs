//! What the documents show is what the commands print.

use std::path::{Path, PathBuf};

use serde_json::Value;
use singulate::config::{Config, SETTINGS};

use crate::{answered, run};

const README: &str = include_str!("../../README.md");
const EXAMPLE: &str = "src/cli/example.json";

fn example() -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(EXAMPLE).to_str().unwrap().to_owned()
}

/// The fenced block of this kind.
fn block(kind: &str) -> &'static str {
    let (_, rest) = README.split_once(&format!("```{kind}\n")).unwrap();
    rest.split_once("```").unwrap().0
}

fn without_statistics(text: &str) -> Value {
    let mut value: Value = serde_json::from_str(text).unwrap();
    value.as_object_mut().unwrap().remove("statistics").unwrap();
    value
}

#[test]
fn the_picture_is_what_plan_draws() {
    let drawn = answered(run(&["plan", &example(), "--format", "svg"]));
    let told = "redraw it: cargo run -- plan src/cli/example.json --format svg > docs/example.svg";
    assert!(drawn == include_str!("../../docs/example.svg"), "{told}");
}

#[test]
fn the_scene_is_the_example_and_the_answer_is_what_plan_says() {
    let shown: Value = serde_json::from_str(block("json scene")).unwrap();
    assert_eq!(shown, serde_json::from_str::<Value>(&std::fs::read_to_string(example()).unwrap()).unwrap());
    let answer = answered(run(&["plan", &example()]));
    assert_eq!(without_statistics(block("json answer")), without_statistics(&answer));
}

#[test]
fn the_text_is_what_plan_says_but_for_the_times() {
    let text = answered(run(&["plan", &example(), "--format", "text"]));
    let (paragraphs, times) = text.trim_end().rsplit_once("\n\n").unwrap();
    assert!(times.contains("ms in all"), "{times}");
    assert_eq!(block("text plan").trim_end(), paragraphs);
}

#[test]
fn every_command_is_listed() {
    let help = answered(run(&["--help"]));
    let (_, commands) = help.split_once("Commands:\n").unwrap();
    let names = commands.lines().map_while(|line| line.split_whitespace().next());
    let names: Vec<&str> = names.filter(|name| *name != "help").collect();
    assert!(names.len() > 7, "{names:?}");
    for name in names {
        assert!(README.contains(&format!("| `singulate {name}")), "{name}");
    }
}

#[test]
fn every_setting_is_listed_with_its_default() {
    for setting in SETTINGS {
        let default = match setting.name {
            "threads" | "job_threads" => "one per core".to_owned(),
            _ => format!("`{}`", setting.get(&Config::default())),
        };
        let (flag, variable, key) = (setting.flag(), setting.variable(), setting.name);
        let row = format!("| `--{flag}` | `{variable}` | `{key}` | {default} | ");
        assert!(README.contains(&row), "no row '{row}'");
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

/// The files that the commands of the README make, by what they are made with.
fn made_files() -> Vec<&'static str> {
    let blocks = README.split("```").skip(1).step_by(2).filter(|block| block.starts_with("sh"));
    let words: Vec<&str> = blocks.flat_map(str::split_whitespace).collect();
    let makes = ["-keyout", "-out", "--api-keys-file", "-extfile", ">"];
    let made = words.windows(2).filter(|pair| makes.contains(&pair[0])).map(|pair| pair[1].trim_end_matches(')'));
    made.collect()
}

#[test]
fn git_ignores_every_key_and_certificate_that_the_readme_makes() {
    let made = made_files();
    assert!(
        ["keys.toml", "singulate.key", "authority.pem", "robot-1.csr"].iter().all(|file| made.contains(file)),
        "{made:?}"
    );
    let ignored: Vec<&str> = include_str!("../../.gitignore").lines().collect();
    // openssl's -CAcreateserial makes one beside the authority.
    for file in [&made[..], &["authority.srl"]].concat() {
        let kind = format!("*.{}", file.rsplit('.').next().unwrap());
        assert!(ignored.contains(&file) || ignored.contains(&kind.as_str()), "{file}");
    }
}

/// The pages for people: those at the root and those in `docs`.
fn pages() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let files = [root.to_owned(), root.join("docs")].map(|folder| std::fs::read_dir(folder).unwrap());
    let paths = files.into_iter().flatten().map(|entry| entry.unwrap().path());
    paths.filter(|path| path.extension().is_some_and(|extension| extension == "md")).collect()
}

#[test]
fn a_file_that_curl_sends_keeps_its_lines() {
    let lines = pages().into_iter().flat_map(|page| {
        let text = std::fs::read_to_string(page).unwrap();
        text.lines()
            .filter(|line| line.contains(" @") && line.contains("application/json"))
            .map(str::to_owned)
            .collect::<Vec<_>>()
    });
    let lines: Vec<String> = lines.collect();
    assert!(lines.len() >= 4, "{lines:?}");
    for line in lines {
        assert!(line.contains(" --data-binary @") && !line.contains(" -d @"), "the lines of the file are lost: {line}");
    }
}

/// The anchors of a page's headings, as a forge makes them.
fn anchors(page: &str) -> Vec<String> {
    let headings = page
        .lines()
        .filter_map(|line| line.trim_start_matches('#').strip_prefix(' ').filter(|_| line.starts_with('#')));
    let kept = |c: char| c.is_alphanumeric() || " -_".contains(c);
    headings.map(|heading| heading.to_lowercase().replace(|c| !kept(c), "").replace(' ', "-")).collect()
}

#[test]
fn everything_that_is_linked_is_there() {
    let pages = pages();
    assert!(pages.len() > 4, "{pages:?}");
    for page in pages {
        let text = std::fs::read_to_string(&page).unwrap();
        for link in text.split("](").skip(1).map(|rest| rest.split(')').next().unwrap()) {
            if link.starts_with("https://") {
                continue;
            }
            let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
            let target = if file.is_empty() { page.clone() } else { page.parent().unwrap().join(file) };
            assert!(target.exists(), "{}: {link}", page.display());
            if !anchor.is_empty() {
                let anchors = anchors(&std::fs::read_to_string(&target).unwrap());
                assert!(anchors.contains(&anchor.to_owned()), "{}: {link}: {anchors:?}", page.display());
            }
        }
    }
}
