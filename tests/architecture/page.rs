//! What ARCHITECTURE.md says of the tree, held against the tree.

use std::fs;
use std::path::Path;

use super::{PLANNER, ROOT, SERVICE, Source, collect, names, sources};

/// The most lines that a newcomer reads in one go.
const MAX_LINES: usize = 200;

/// What is written about the tree.
fn page() -> String {
    fs::read_to_string(Path::new(ROOT).join("ARCHITECTURE.md")).unwrap()
}

/// Each crate has its rooms on the map, lowest first, each with its job in one line.
#[test]
fn the_map_names_every_room() {
    let page = page();
    let map = page.split("```").nth(1).unwrap();
    let lines = map.lines().filter_map(|line| line.strip_prefix("  ")).filter(|entry| !entry.starts_with(' '));
    let rooms: Vec<&str> = lines
        .map(|entry| {
            let (room, job) = entry.split_once(' ').unwrap();
            assert!(job.trim().len() > 10, "{room} has a job");
            room.trim_end_matches('/').trim_end_matches(".rs")
        })
        .collect();
    assert_eq!(rooms, [&PLANNER[..], &SERVICE].concat());
    for Source { room, path, .. } in sources() {
        assert!(["lib", "main"].contains(&room.as_str()) || rooms.contains(&room.as_str()), "{}", path.display());
    }
}

#[test]
fn the_page_is_short() {
    let lines = page().lines().count();
    assert!(lines <= MAX_LINES, "ARCHITECTURE.md has {lines} lines, more than {MAX_LINES}");
}

/// A section from its heading to the next.
fn section<'a>(page: &'a str, heading: &str) -> &'a str {
    page.split(&format!("\n## {heading}")).nth(1).unwrap().split("\n## ").next().unwrap()
}

/// The words between backticks.
fn quoted(text: &str) -> Vec<&str> {
    text.split('`').skip(1).step_by(2).collect()
}

/// The paths that a word stands for: `src/api/{app,body}.rs` is two files. None where it is no path.
fn paths(word: &str) -> Vec<String> {
    let path = word.contains('/') && !word.starts_with('/') || word.ends_with(".md");
    if !path || word.contains(' ') {
        return Vec::new();
    }
    let Some((before, group)) = word.split_once('{') else { return vec![word.to_owned()] };
    let (group, after) = group.split_once('}').unwrap();
    group.split(',').flat_map(|part| paths(&format!("{before}{part}{after}"))).collect()
}

#[test]
fn a_group_of_paths_is_each_of_them() {
    assert_eq!(paths("a/{b,c}/{d,e}.rs"), ["a/b/d.rs", "a/b/e.rs", "a/c/d.rs", "a/c/e.rs"]);
    assert!(paths("App::answer").is_empty() && paths("/v1/plans").is_empty() && paths("a / b").is_empty());
}

/// What a request passes, and what an extension touches, are files and names of today.
#[test]
fn every_file_and_name_on_the_way_is_there() {
    let (page, sources) = (page(), sources());
    let known = |part: &str| sources.iter().any(|source| names(&source.text, part));
    for heading in ["A request's way", "To add X, touch Y"] {
        let words = quoted(section(&page, heading));
        assert!(words.iter().flat_map(|word| paths(word)).count() > 8, "{words:?}");
        for word in words {
            let named = paths(word);
            for path in &named {
                assert!(Path::new(ROOT).join(path).exists(), "{heading}: there is no {path}");
            }
            if named.is_empty() && !word.contains(['/', ' ']) {
                assert!(word.split("::").all(known), "{heading}: nothing is called {word}");
            }
        }
    }
}

/// The last column of each row is the number of files that the row names.
#[test]
fn the_files_to_touch_are_counted() {
    let page = page();
    let rows: Vec<&str> = section(&page, "To add X, touch Y").lines().filter(|line| line.starts_with("| ")).collect();
    assert!(rows.len() > 5, "{rows:?}");
    for row in &rows[2..] {
        let named = quoted(row).into_iter().flat_map(paths).filter(|path| !path.ends_with('/')).count();
        let stated = row.trim_end_matches(" |").rsplit(" | ").next().unwrap();
        assert_eq!(stated, named.to_string(), "{row}");
    }
}

/// The files of a row of "To add X, touch Y".
fn row<'a>(page: &'a str, thing: &str) -> (&'a str, Vec<String>) {
    let rows = section(page, "To add X, touch Y").lines();
    let row = rows.into_iter().find(|line| line.starts_with(&format!("| {thing}"))).unwrap();
    (row, quoted(row).into_iter().flat_map(paths).collect())
}

/// What matches on the shapes and the actions of today are files that the page names: a new one has to be added there.
#[test]
fn all_that_knows_the_shapes_and_the_actions_is_named() {
    let page = page();
    for (thing, words) in [
        ("a shape", &["ShapeDraft::Rectangle", "Self::Rectangle", "Kind::Rectangle"][..]),
        ("an action", &["Step::PickPlace", "Self::PickPlace(", "Way::Picked"]),
    ] {
        let (_, named) = row(&page, thing);
        let mut seen = 0;
        for Source { path, text, .. } in sources() {
            let inside = path.strip_prefix(ROOT).unwrap().to_str().unwrap();
            // The builder of scenes is for tests.
            let tests = inside.contains("/tests") || inside.ends_with("scene/scenes.rs");
            if words.iter().any(|word| text.contains(word)) && !tests {
                seen += 1;
                assert!(named.iter().any(|file| file == inside), "{thing}: {inside} is not named");
            }
        }
        assert!(seen > 4, "{thing}: {seen}");
    }
}

/// The words between backticks in the last column of the tables of a section, row by row.
fn last_column<'a>(page: &'a str, heading: &str) -> Vec<Vec<&'a str>> {
    let rows = section(page, heading).lines().filter(|line| line.starts_with("| ")).skip(2);
    rows.map(|row| quoted(row.rsplit_once(" | ").unwrap().1)).collect()
}

/// All tests' text.
fn tests() -> String {
    let mut files = Vec::new();
    for folder in ["planner", "src", "tests"] {
        collect(&Path::new(ROOT).join(folder), &mut files);
    }
    files.iter().map(|path| fs::read_to_string(path).unwrap()).collect()
}

#[test]
fn every_test_that_is_named_is_there() {
    let (all, page) = (tests(), page());
    let absent = last_column(&page, "What is absent").concat();
    let named: Vec<&str> = absent.into_iter().filter(|word| word.matches('_').count() > 2).collect();
    assert!(named.len() > 15, "{named:?}");
    for test in named {
        assert!(all.contains(&format!("fn {test}(")), "there is no test {test}");
    }
}

#[test]
fn every_threat_has_a_test_and_it_is_there() {
    let root = Path::new(ROOT);
    let (all, page) = (tests(), fs::read_to_string(root.join("SECURITY.md")).unwrap());
    let rows = last_column(&page, "Threats and their tests");
    assert!(rows.len() > 20, "{rows:?}");
    for row in rows {
        assert!(!row.is_empty(), "a threat without a test in {page}");
        for test in row {
            // Some checks are scripts.
            let there =
                if test.contains('/') { root.join(test).is_file() } else { all.contains(&format!("fn {test}(")) };
            assert!(there, "there is no test {test}");
        }
    }
}
