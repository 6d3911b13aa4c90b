//! Writes answers to stdout.

use std::io::{ErrorKind, Write};

use serde::Serialize;

use super::Failure;

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
