//! Circles between files of one room, read off the paths that begin with `super` or `crate`.
//!
//! A name that a folder's `mod.rs` passes on counts as the file that has it. What a `mod.rs` names of its own folder does
//! not count: a folder and its files are one thought.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use super::{ROOT, Source, sources};

/// The circles that stand today. Each is to go, and none may join them.
const KNOWN_CIRCLES: [&[&str]; 7] = [
    &["planner/src/plan/check/branch.rs", "planner/src/plan/check/hitting.rs"],
    &["planner/src/plan/judge.rs", "planner/src/plan/planner.rs"],
    &["planner/src/scene/relations.rs", "planner/src/scene/validate.rs"],
    &["src/api/app.rs", "src/api/body.rs", "src/api/edge.rs", "src/api/reading.rs"],
    &[
        "src/api/document.rs",
        "src/api/jobs/collection.rs",
        "src/api/jobs/events.rs",
        "src/api/jobs/one.rs",
        "src/api/jobs/problems.rs",
        "src/api/knowledge.rs",
        "src/api/plans.rs",
        "src/api/router.rs",
        "src/api/survey.rs",
        "src/api/verification.rs",
    ],
    &["src/wire/job_request.rs", "src/wire/request.rs", "src/wire/settings.rs", "src/wire/typed.rs"],
    &["src/wire/malformed.rs", "src/wire/reader.rs", "src/wire/walk.rs"],
];

/// A path, part by part: of a module from its crate's folder, or as the code writes it.
type Name<'a> = Vec<&'a str>;

/// The files of both crates by the modules that they are.
struct Tree<'a>(BTreeMap<Name<'a>, &'a Source>);

impl<'a> Tree<'a> {
    fn new(sources: &'a [Source]) -> Self {
        let tests = |source: &&Source| source.path.iter().any(|part| part == "tests");
        Self(sources.iter().filter(|source| !tests(source)).map(|source| (module(&source.path), source)).collect())
    }

    /// For each module those of its room that it names.
    fn edges(&self) -> BTreeMap<&Name<'a>, BTreeSet<Name<'a>>> {
        let named = |(from, source): (_, &&'a Source)| {
            let from: &Name<'a> = from;
            let paths = rooted(&source.text).into_iter().flat_map(|path| self.files(from, &path));
            let inside = |to: &Name<'a>| self.0.contains_key(to) && to[..2] == from[..2] && to != from;
            (from, paths.filter(inside).collect())
        };
        self.0.iter().map(named).collect()
    }

    /// The modules to which a path leads from a module: one, or all those of a folder that is named as a whole.
    fn files(&self, from: &[&'a str], path: &[&'a str]) -> Vec<Name<'a>> {
        let mut at = from.to_vec();
        for part in path {
            match *part {
                "crate" => at.truncate(1),
                "super" => drop(at.pop()),
                "self" => {}
                part => {
                    at.push(part);
                    if !self.0.contains_key(&at) {
                        at.pop();
                        let passed = self.passed_on(&at).into_iter().find(|path| path.last() == Some(&part));
                        return passed.map_or_else(|| vec![at.clone()], |path| self.files(&at, &path));
                    }
                }
            }
        }
        let passed = if from.starts_with(&at) { Vec::new() } else { self.passed_on(&at) };
        passed.iter().flat_map(|path| self.files(&at, path)).chain([at.clone()]).collect()
    }

    /// The paths that a module makes its own by `pub use`.
    fn passed_on(&self, module: &[&'a str]) -> Vec<Name<'a>> {
        let text = self.0.get(module).map_or("", |source| &source.text);
        let public = |at: usize| text[..at].rsplit('\n').next().unwrap().trim_start().starts_with("pub");
        text.match_indices(" use ").filter(|(at, _)| public(*at)).flat_map(|(at, _)| leaves(&text[at + 5..])).collect()
    }

    /// The files of each circle.
    fn circles(&self) -> Vec<Vec<&'a str>> {
        let edges = self.edges();
        let reached: BTreeMap<_, _> = edges.keys().map(|from| (*from, reach(&edges, from))).collect();
        let circle = |from: &&Name<'a>| -> Vec<&'a str> {
            let back = |to: &&Name<'a>| reached[*to].contains(*from);
            reached[*from].iter().filter(back).map(|to| inside(&self.0[to].path)).collect()
        };
        let found: BTreeSet<_> = edges.keys().map(circle).filter(|circle| !circle.is_empty()).collect();
        found.into_iter().collect()
    }
}

/// All that can be reached from a module.
fn reach<'a>(edges: &BTreeMap<&Name<'a>, BTreeSet<Name<'a>>>, from: &Name<'a>) -> BTreeSet<Name<'a>> {
    let (mut reached, mut open) = (BTreeSet::new(), vec![from]);
    while let Some(next) = open.pop() {
        open.extend(edges[next].iter().filter(|to| reached.insert((*to).clone())));
    }
    reached
}

/// A file's path from the workspace on.
fn inside(path: &Path) -> &str {
    path.strip_prefix(ROOT).unwrap().to_str().unwrap()
}

/// The module that a file is: `planner`, `scene`, `object`.
fn module(path: &Path) -> Name<'_> {
    let parts = inside(path).trim_end_matches(".rs").trim_end_matches("/mod");
    let parts: Name<'_> = parts.split('/').collect();
    if parts[0] == "planner" { [&parts[..1], &parts[2..]].concat() } else { parts }
}

/// Every path in a text that begins with `super` or `crate`.
fn rooted(text: &str) -> Vec<Name<'_>> {
    let begins = |at: usize| !text[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == ':');
    let starts = ["super::", "crate::"].into_iter().flat_map(|root| text.match_indices(root));
    starts.filter(|(at, _)| begins(*at)).flat_map(|(at, _)| leaves(&text[at..])).collect()
}

/// The paths of the `use` tree with which a text begins.
fn leaves(text: &str) -> Vec<Name<'_>> {
    let end = text.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':')).unwrap_or(text.len());
    let stem: Name<'_> = text[..end].split("::").filter(|part| !part.is_empty()).collect();
    let Some(group) = text[end..].strip_prefix('{').filter(|_| text[..end].ends_with("::")) else { return vec![stem] };
    members(group).into_iter().flat_map(leaves).map(|leaf| [&stem[..], &leaf].concat()).collect()
}

/// The members of a group up to its closing brace.
fn members(group: &str) -> Vec<&str> {
    let (mut depth, mut begin, mut found) = (0, 0, Vec::new());
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            ',' | '}' if depth == 0 => {
                found.push(group[begin..at].trim());
                begin = at + 1;
                if c == '}' {
                    break;
                }
            }
            '}' => depth -= 1,
            _ => {}
        }
    }
    found.retain(|member| !member.is_empty());
    found
}

#[test]
fn no_circle_joins_the_known_ones() {
    assert_eq!(Tree::new(&sources()).circles(), KNOWN_CIRCLES);
}

#[test]
fn a_circle_is_found_whatever_names_it() {
    let source = |(path, text): (&str, &str)| Source {
        room: "room".to_owned(),
        path: Path::new(ROOT).join(path),
        text: text.to_owned(),
    };
    let files = [
        ("src/room/mod.rs", "mod a;\npub use a::{A, Other};\npub(crate) use deep::Deep;\npub struct Own;\nuse b::B;"),
        ("src/room/a.rs", "use super::b::{self, B as C};\nuse super::Own;"),
        ("src/room/b.rs", "use crate::room::{d::D, Own, A};"),
        ("src/room/c.rs", "use super::deep;"),
        ("src/room/d.rs", "use super::a::A;"),
        ("src/room/deep/mod.rs", "pub use e::Deep;"),
        ("src/room/deep/e.rs", "fn e() -> super::super::c::C {}\nuse crate::other::X;"),
        ("src/other.rs", "use crate::room::Deep;"),
    ];
    let sources: Vec<Source> = files.into_iter().map(source).collect();
    let found = Tree::new(&sources).circles();
    let (first, second) =
        (["src/room/a.rs", "src/room/b.rs", "src/room/d.rs"], ["src/room/c.rs", "src/room/deep/e.rs"]);
    assert_eq!(found, [&first[..], &second]);
}
