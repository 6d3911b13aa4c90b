//! The command line as a shell sees it.

#![expect(clippy::unwrap_used, reason = "what fails here fails the test")]

mod client_scenes;
mod commands;
mod controllers;
mod errors;
mod experiments;
#[path = "../service/hard.rs"]
mod hard;
mod keys;
mod log;
mod pages;
mod readme;
mod scenes;
mod service;
mod settings;
mod tls;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// The binary, in an environment without any settings.
fn singulate(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_singulate"));
    for (name, _) in std::env::vars_os() {
        if name.to_string_lossy().starts_with("SINGULATE_") {
            command.env_remove(name);
        }
    }
    command.args(arguments).stdin(Stdio::null());
    command
}

fn run(arguments: &[&str]) -> Output {
    singulate(arguments).output().unwrap()
}

/// Run with this text on stdin.
fn run_with_input(arguments: &[&str], input: &str) -> Output {
    let mut command = singulate(arguments);
    let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    // A command that refuses its arguments is gone before it reads.
    if let Err(error) = child.stdin.take().unwrap().write_all(input.as_bytes()) {
        assert_eq!(error.kind(), std::io::ErrorKind::BrokenPipe);
    }
    child.wait_with_output().unwrap()
}

/// The stdout of a run that answers.
#[track_caller]
fn answered(output: Output) -> String {
    let errors = String::from_utf8(output.stderr).unwrap();
    assert_eq!((output.status.code(), errors.as_str()), (Some(0), ""));
    String::from_utf8(output.stdout).unwrap()
}

/// The stderr of a run that fails, with nothing on stdout.
#[track_caller]
fn failed(output: &Output, code: i32) -> String {
    let errors = String::from_utf8(output.stderr.clone()).unwrap();
    assert_eq!(output.status.code(), Some(code), "{errors}");
    assert!(output.stdout.is_empty());
    errors
}

/// A file of its own for each test.
fn file(name: &str, text: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&path, text).unwrap();
    path
}
