//! What the log says. In a binary of its own: whether a line is wanted at all is settled once a process.

#![expect(clippy::unwrap_used, reason = "what fails here fails the test")]

mod jobs;
mod requests;

use std::io::{self, Write};
use std::sync::{Arc, Mutex};

use tracing::subscriber::DefaultGuard;

#[derive(Clone, Default)]
struct Text(Arc<Mutex<Vec<u8>>>);

impl Write for Text {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.lock().unwrap().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// What is logged in this thread.
struct Pages {
    text: Text,
    _guard: DefaultGuard,
}

impl Pages {
    fn open() -> Self {
        let text = Text::default();
        let writer = text.clone();
        let subscriber = tracing_subscriber::fmt().with_ansi(false).with_writer(move || writer.clone()).finish();
        Self { text, _guard: tracing::subscriber::set_default(subscriber) }
    }

    /// What was logged since the last time.
    fn take(&self) -> String {
        String::from_utf8(core::mem::take(&mut *self.text.0.lock().unwrap())).unwrap()
    }
}

/// The value of a field in a line.
fn field<'a>(line: &'a str, name: &str) -> Option<&'a str> {
    let (_, rest) = line.split_once(&format!(" {name}="))?;
    Some(rest.split([' ', '}', '\n']).next().unwrap().trim_matches('"'))
}
