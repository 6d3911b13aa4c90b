//! A file for jobs.

use std::fs;

/// A store in a file on the disk of the build, where a commit costs what it costs, empty at first; gone with the value.
pub(crate) struct StoreFile(String);

impl StoreFile {
    pub(crate) fn new(name: &str) -> Self {
        let file = Self(format!("{}/{name}.db", env!("CARGO_TARGET_TMPDIR")));
        file.remove();
        file
    }

    pub(crate) fn url(&self) -> String {
        format!("sqlite:{}", self.0)
    }

    fn remove(&self) {
        for end in ["", "-wal", "-shm"] {
            // It may not be there.
            let _ = fs::remove_file(format!("{}{end}", self.0));
        }
    }
}

impl Drop for StoreFile {
    fn drop(&mut self) {
        self.remove();
    }
}
