//! Reads the files that the commands name.

use std::io::Read;
use std::path::Path;

use super::Failure;
use super::text::plain;
use crate::wire::{PlanRequest, Problem, RequestLimits, read_scene};

/// The file's bytes; `-` is stdin.
pub(super) fn bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    let read = if path.as_os_str() == "-" {
        let mut bytes = Vec::new();
        std::io::stdin().lock().read_to_end(&mut bytes).map(|_| bytes)
    } else {
        std::fs::read(path)
    };
    read.map_err(|error| Failure::Refused(format!("{}: {error}", name(path))))
}

/// The scene in a file.
pub(super) fn scene(path: &Path, limits: &RequestLimits) -> Result<PlanRequest, Failure> {
    read_scene(&bytes(path)?, limits).map_err(|problem| refused(path, &problem))
}

fn name(path: &Path) -> String {
    if path.as_os_str() == "-" { "stdin".to_owned() } else { path.display().to_string() }
}

/// The faults of a file, one per line.
pub(super) fn refused(path: &Path, problem: &Problem) -> Failure {
    let mut lines = vec![format!("{}: {}", name(path), plain(problem.detail()))];
    for error in problem.errors() {
        let see = error.see();
        if error.detail == problem.detail() {
            // A text that is not JSON has one fault, which the first line tells.
            lines[0] += &format!(" ({see})");
        } else {
            let pointer = if error.pointer.is_empty() { "(the whole)" } else { &plain(&error.pointer) };
            lines.push(format!("  {}  {pointer}  {} ({see})", error.code, plain(&error.detail)));
        }
    }
    Failure::Refused(lines.join("\n"))
}
