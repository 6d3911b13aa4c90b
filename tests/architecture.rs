//! The rooms and their one-way arrows, read off the source.

#![expect(clippy::unwrap_used, reason = "what fails here fails the test")]

use std::fs;
use std::path::{Path, PathBuf};

/// The rooms, lowest first: each may name those before it, none may name one after it.
const ROOMS: [&str; 22] = [
    "budget",
    "scene",
    "geometry",
    "knowledge",
    "search",
    "placement",
    "paper",
    "plan",
    "experiments",
    "render",
    "wire",
    "metrics",
    "traces",
    "watched_files",
    "keys",
    "workers",
    "jobs",
    "tls",
    "api",
    "telemetry",
    "config",
    "cli",
];
const PURE: [&str; 8] = ["budget", "scene", "geometry", "knowledge", "search", "placement", "paper", "plan"];
/// What no pure room may name: I/O, clocks, environment, threads, randomness, serialisation, the web.
const IMPURE: [&str; 22] = [
    "serde",
    "axum",
    "tokio",
    "hyper",
    "utoipa",
    "reqwest",
    "tracing",
    "clap",
    "toml",
    "rand",
    "rand_chacha",
    "svg",
    "std::fs",
    "std::io",
    "std::net",
    "std::env",
    "std::time",
    "std::thread",
    "std::process",
    "Instant",
    "SystemTime",
    "RandomState",
];

struct Source {
    room: String,
    path: PathBuf,
    text: String,
}

/// Every source file without its tests and comments.
fn sources() -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    collect(&root, &mut files);
    assert!(files.len() > 40, "the source tree is read");
    files
        .into_iter()
        .map(|path| {
            let inside = path.strip_prefix(&root).unwrap();
            let first = inside.components().next().unwrap().as_os_str().to_str().unwrap();
            let text = fs::read_to_string(&path).unwrap();
            Source { room: first.trim_end_matches(".rs").to_owned(), text: code(&text), path }
        })
        .filter(|source| !source.path.ends_with("tests.rs"))
        .collect()
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
}

/// What is compiled into the service: without the trailing test module, and without comments.
fn code(text: &str) -> String {
    let end = text.find("#[cfg(test)]\nmod tests {").unwrap_or(text.len());
    text[..end].lines().map(|line| line.split("//").next().unwrap()).collect::<Vec<_>>().join("\n")
}

/// True if the text holds the word, not as a part of a longer name.
fn names(text: &str, word: &str) -> bool {
    let part = |c: char| c.is_alphanumeric() || c == '_';
    text.match_indices(word).any(|(at, _)| {
        let before = text[..at].chars().next_back().is_some_and(part);
        let after = text[at + word.len()..].chars().next().is_some_and(part);
        !before && !after
    })
}

/// The rooms that a file names with a path from the crate's root.
fn named_rooms(text: &str) -> Vec<&'static str> {
    ROOMS.into_iter().filter(|room| names(text, &format!("crate::{room}"))).collect()
}

fn level(room: &str) -> usize {
    ROOMS.iter().position(|other| *other == room).unwrap_or_else(|| panic!("'{room}' is no known room"))
}

#[test]
fn no_room_looks_upwards() {
    for Source { room, path, text } in
        sources().iter().filter(|source| !["lib", "main"].contains(&source.room.as_str()))
    {
        for named in named_rooms(text) {
            assert!(level(named) <= level(room), "{} names {named}, which is above {room}", path.display());
        }
        assert!(!names(text, "super::super::super"), "{}: a path that this test can't follow", path.display());
        assert!(!text.contains("use crate::{"), "{}: name rooms one a line", path.display());
    }
}

#[test]
fn pure_rooms_do_no_io_and_read_no_clock() {
    for Source { room, path, text } in sources() {
        if PURE.contains(&room.as_str()) {
            for word in IMPURE {
                assert!(!names(&text, word), "{} names {word}", path.display());
            }
        }
    }
}

#[test]
fn the_checker_shares_only_the_scene_and_the_stated_answer() {
    let mut seen = 0;
    for Source { path, text, .. } in sources() {
        if path.parent().is_some_and(|parent| parent.ends_with("plan/check")) {
            seen += 1;
            let outside = ["budget", "scene", "plan"];
            assert!(named_rooms(&text).iter().all(|room| outside.contains(room)), "{}", path.display());
            let siblings = text.matches("plan::").count() - text.matches("plan::claim").count();
            assert_eq!(siblings, text.matches("plan::check").count(), "{} names a part of plan", path.display());
            assert!(!text.contains("super::super") && !names(&text, "DiscIndex"), "{}", path.display());
            assert!(!text.contains(".index()"), "{} uses the scene's index", path.display());
        }
    }
    assert!(seen > 5, "the checker's files are read");
}

#[test]
fn a_stated_answer_names_no_part_of_the_planner() {
    let claim = sources().into_iter().find(|source| source.path.ends_with("plan/claim.rs")).unwrap();
    for word in ["geometry", "knowledge", "search", "placement", "super"] {
        assert!(!names(&claim.text, word), "claim.rs names {word}");
    }
}

#[test]
fn only_wire_and_above_know_json() {
    for Source { room, path, text } in sources() {
        if ["render", "experiments"].contains(&room.as_str()) {
            assert!(!names(&text, "serde_json") && !names(&text, "serde"), "{} names serde", path.display());
        }
        let below = ["render", "experiments", "wire", "metrics", "traces", "keys", "workers", "jobs", "tls"];
        if below.contains(&room.as_str()) {
            assert!(!names(&text, "axum"), "{} names axum", path.display());
        }
    }
}

#[test]
fn a_word_is_found_only_as_a_word() {
    assert!(names("use rand::Rng;", "rand") && !names("operand", "rand") && !names("rand_chacha", "rand"));
    assert_eq!(named_rooms("use crate::plan::plan;\nuse crate::scene::Scene;"), ["scene", "plan"]);
    assert_eq!(code("a // serde\n#[cfg(test)]\nmod tests { serde }"), "a ");
}

/// What is written about the tree.
fn page() -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("ARCHITECTURE.md")).unwrap()
}

/// The map's rooms, each with its lines: a room begins at two spaces, its files stand deeper.
fn mapped_rooms(page: &str) -> Vec<(&str, String)> {
    let mut rooms: Vec<(&str, String)> = Vec::new();
    for line in page.split("```").nth(1).unwrap().lines() {
        match line.strip_prefix("  ") {
            Some(entry) if !entry.starts_with(' ') => {
                let name = entry.split(' ').next().unwrap();
                rooms.push((name.trim_end_matches(".rs").trim_end_matches('/'), entry.to_owned()));
            }
            Some(entry) => rooms.last_mut().unwrap().1.push_str(&format!("\n{entry}")),
            None => {}
        }
    }
    rooms
}

#[test]
fn the_map_names_every_module() {
    let page = page();
    let map = mapped_rooms(&page);
    let rooms: Vec<&str> = map.iter().map(|(room, _)| *room).collect();
    assert_eq!(rooms, [&["lib"], &ROOMS[..], &["main"]].concat());
    for Source { room, path, .. } in sources() {
        let name = path.file_name().unwrap().to_str().unwrap();
        // What only tests compile has no place on the map.
        if ["mod.rs", "scenes.rs"].contains(&name) || path.parent().unwrap().ends_with("tests") {
            continue;
        }
        let entry = &map.iter().find(|(mapped, _)| *mapped == room).unwrap().1;
        assert!(names(entry, name), "{} is not on the map", path.display());
    }
}

/// The words between backticks in the last column of the tables of a section, row by row.
fn last_column<'a>(page: &'a str, section: &str) -> Vec<Vec<&'a str>> {
    let text = page.split(&format!("\n## {section}")).nth(1).unwrap().split("\n## ").next().unwrap();
    let rows = text.lines().filter(|line| line.starts_with("| ")).skip(2);
    rows.map(|row| row.rsplit_once(" | ").unwrap().1.split('`').skip(1).step_by(2).collect()).collect()
}

/// All tests' text.
fn tests() -> String {
    let mut files = Vec::new();
    for folder in ["src", "tests"] {
        collect(&Path::new(env!("CARGO_MANIFEST_DIR")).join(folder), &mut files);
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
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (all, page) = (tests(), fs::read_to_string(root.join("SECURITY.md")).unwrap());
    let rows = last_column(&page, "Who, what, which check, which test");
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
