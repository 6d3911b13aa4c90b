//! The rooms and their one-way arrows, read off the source.

#![expect(clippy::unwrap_used, reason = "what fails here fails the test")]

mod circles;
mod page;

use std::fs;
use std::path::{Path, PathBuf};

/// Where the workspace stands.
const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// The rooms of the planner, lowest first: each may name those before it, none may name one after it.
const PLANNER: [&str; 11] =
    ["budget", "cost", "scene", "statement", "check", "geometry", "knowledge", "search", "placement", "plan", "paper"];
/// The rooms of the service, likewise. Each may name the planner.
const SERVICE: [&str; 15] = [
    "experiments",
    "render",
    "wire",
    "metrics",
    "traces",
    "watched_files",
    "keys",
    "workers",
    "computation",
    "jobs",
    "tls",
    "api",
    "telemetry",
    "config",
    "cli",
];
/// All that the planner may depend on.
const PLANNERS_CRATES: [&str; 7] = ["batsat", "libm", "nalgebra", "rstar", "rustfft", "smallvec", "thiserror"];
/// What the standard library has and the planner may not name: I/O, clocks, environment, threads, randomness.
const IMPURE: [&str; 10] = [
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

/// What stands before a module of tests.
const TEST_ONLY: &str = "#[cfg(test)]\n";

#[derive(Clone)]
struct Source {
    room: String,
    path: PathBuf,
    text: String,
}

/// Every source file of both crates without its tests and comments.
fn sources() -> Vec<Source> {
    let sources = [sources_of("planner/src"), sources_of("src")].concat();
    assert!(sources.len() > 40, "the source trees are read");
    sources
}

fn sources_of(tree: &str) -> Vec<Source> {
    let root = Path::new(ROOT).join(tree);
    let mut files = Vec::new();
    collect(&root, &mut files);
    let source = |path: PathBuf| {
        let inside = path.strip_prefix(&root).unwrap();
        let first = inside.components().next().unwrap().as_os_str().to_str().unwrap();
        let text = fs::read_to_string(&path).unwrap();
        Source { room: first.trim_end_matches(".rs").to_owned(), text: code(&text), path }
    };
    files.into_iter().map(source).filter(|source| !source.path.ends_with("tests.rs")).collect()
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
    let opens = |rest: &str| rest.trim_start_matches("pub(super) ").starts_with("mod tests {");
    let end = text.match_indices(TEST_ONLY).find(|(at, _)| opens(&text[at + TEST_ONLY.len()..]));
    let end = end.map_or(text.len(), |(at, _)| at);
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
    [&PLANNER[..], &SERVICE].concat().into_iter().filter(|room| names(text, &format!("crate::{room}"))).collect()
}

fn level(room: &str) -> usize {
    let rooms = [&PLANNER[..], &SERVICE].concat();
    rooms.iter().position(|other| *other == room).unwrap_or_else(|| panic!("'{room}' is no known room"))
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
fn the_planner_does_no_io_and_reads_no_clock() {
    let manifest = fs::read_to_string(Path::new(ROOT).join("planner/Cargo.toml")).unwrap();
    let manifest: toml::Table = manifest.parse().unwrap();
    let mut crates: Vec<_> = manifest["dependencies"].as_table().unwrap().keys().collect();
    crates.sort_unstable();
    assert_eq!(crates, PLANNERS_CRATES);
    for Source { path, text, .. } in sources_of("planner/src") {
        for word in IMPURE {
            assert!(!names(&text, word), "{} names {word}", path.display());
        }
    }
}

/// Each type has one name, whichever crate uses it.
#[test]
fn the_service_re_exports_nothing_of_the_planner() {
    for Source { path, text, .. } in sources_of("src") {
        assert!(!text.contains("pub use singulate_planner"), "{}", path.display());
    }
}

/// The arithmetic that the planner and the scene share, which the checker does by itself.
const NOT_THE_CHECKERS: [&str; 30] = [
    "FootprintIndex",
    ".index()",
    ".comes_within(",
    ".gap_inside(",
    ".gap_outside(",
    ".circumradius(",
    ".inradius(",
    ".bounding_box(",
    ".extents(",
    ".distance_to",
    ".axes(",
    ".edges(",
    ".turned(",
    ".mirrored(",
    ".moved_to(",
    ".reach(",
    ".inner(",
    ".outer(",
    ".band(",
    ".fits(",
    ".offset(",
    ".outer_distance(",
    ".tips(",
    ".fingers_pass_over(",
    ".palm_distance(",
    ".can_be_grasped(",
    ".movable(",
    "distance(",
    "direction(",
    "turned(",
];

/// Beside what the order of the rooms forbids: the checker stands below all that makes answers.
#[test]
fn the_checker_shares_only_the_scene_and_the_statement() {
    let sources = sources();
    let (check, others): (Vec<_>, Vec<_>) = sources.iter().partition(|source| source.room == "check");
    assert!(check.len() > 5, "the checker's files are read");
    for Source { path, text, .. } in check {
        let shared = ["budget", "cost", "scene", "statement", "check"];
        assert!(named_rooms(text).iter().all(|room| shared.contains(room)), "{}", path.display());
        assert!(!text.contains("super::super"), "{}", path.display());
        let imports: Vec<&str> = text.lines().filter(|line| line.starts_with("use crate::scene")).collect();
        for word in NOT_THE_CHECKERS {
            // A function is the scene's if it is imported: the checker may have its own of that name.
            let function = word.strip_suffix('(').filter(|name| !name.starts_with('.'));
            let used = match function {
                Some(name) => imports.iter().any(|line| names(line, name)),
                None => text.contains(word),
            };
            assert!(!used, "{} uses the scene's {word}", path.display());
        }
        // `gap` of a step is a field, of the checker a function; of a footprint it is a method.
        assert!(!text.replace("self.places.least_gap(", "").contains(".gap("), "{}", path.display());
        // The core in the object's own frame is data; turned as the object stands it is the scene's arithmetic.
        assert!(
            !text.replace(".shape().core(", "").replace("shape.core(", "").contains(".core("),
            "{}",
            path.display()
        );
    }
    // A word that nobody else uses forbids nothing.
    for word in NOT_THE_CHECKERS {
        assert!(others.iter().any(|source| source.text.contains(word)), "{word} is used nowhere");
    }
}

#[test]
fn a_statement_names_no_part_of_the_planner() {
    let mut seen = 0;
    for Source { path, text, .. } in sources().iter().filter(|source| source.room == "statement") {
        seen += 1;
        let shared = ["cost", "scene", "statement"];
        assert!(named_rooms(text).iter().all(|room| shared.contains(room)), "{}", path.display());
    }
    assert!(seen > 1, "the statement's files are read");
}

/// A thread of the pool is for any computation that obeys a budget.
#[test]
fn the_pool_knows_nothing_of_planning() {
    let sources = sources().into_iter().filter(|source| source.room == "workers");
    let mut seen = 0;
    for Source { path, text, .. } in sources {
        seen += 1;
        assert!(named_rooms(&text).iter().all(|room| *room == "workers"), "{} names another room", path.display());
        let planner = text.matches("singulate_planner").count();
        assert_eq!(planner, text.matches("singulate_planner::budget::").count(), "{}", path.display());
    }
    assert!(seen > 3, "the pool's files are read");
}

#[test]
fn only_wire_and_above_know_json() {
    for Source { room, path, text } in sources() {
        if ["render", "experiments"].contains(&room.as_str()) {
            assert!(!names(&text, "serde_json") && !names(&text, "serde"), "{} names serde", path.display());
        }
        let below =
            ["render", "experiments", "wire", "metrics", "traces", "keys", "workers", "computation", "jobs", "tls"];
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
    assert_eq!(code("a\n#[cfg(test)]\nuse b;\n#[cfg(test)]\npub(super) mod tests { c }"), "a\n#[cfg(test)]\nuse b;");
}
