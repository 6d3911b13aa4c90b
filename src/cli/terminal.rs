//! What a command has of the machine: files and stdin, stdout, and a clock.

use core::time::Duration;
use std::io::{ErrorKind, Read, Write};
use std::path::Path;
use std::time::Instant;

use serde::Serialize;

use super::Failure;
use super::text::plain;
use crate::wire::{PlanRequest, Problem, RequestLimits, read_scene};
use singulate_planner::budget::Clock;

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

/// Write the text. A closed pipe is no error: its reader has read enough.
pub(super) fn print(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::Broken(format!("stdout: {error}"))),
        _ => Ok(()),
    }
}

/// Write a body as the service would, indented.
pub(super) fn print_json(body: &impl Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string_pretty(body).map_err(|error| Failure::Broken(error.to_string()))?;
    print(&(text + "\n"))
}

/// The clock of a command. It is never cancelled: an impatient user kills the process.
#[derive(Debug)]
pub(super) struct Stopwatch(Instant);

impl Stopwatch {
    pub(super) fn start() -> Self {
        Self(Instant::now())
    }
}

impl Clock for Stopwatch {
    fn elapsed(&self) -> Duration {
        self.0.elapsed()
    }

    fn cancelled(&self) -> bool {
        false
    }
}
