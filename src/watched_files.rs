//! Files that are reloaded while the service runs: keys, certificates.

use core::time::Duration;
use std::fs::File;
use std::io::{self, Read};
use std::path::PathBuf;

use tokio::task::spawn_blocking;
use tokio::time::sleep;

/// The poll interval. Containers swap whole folders below a mounted file, and network disks send no change events, so
/// contents are compared: they are a few kilobytes.
const PAUSE: Duration = Duration::from_secs(1);

/// The most bytes read of a file: a thousand keys, or a long chain of certificates.
const MAX_BYTES: u64 = 1_000_000;

/// Some files with their contents when last read.
#[derive(Debug)]
pub struct WatchedFiles {
    paths: Vec<PathBuf>,
    contents: Vec<Vec<u8>>,
    pause: Duration,
}

impl WatchedFiles {
    /// Read them for the first time.
    ///
    /// # Errors
    /// If one of them can't be read, or is larger than 1 MB; names it.
    pub fn read(paths: Vec<PathBuf>) -> io::Result<Self> {
        let contents = read(&paths)?;
        Ok(Self { paths, contents, pause: PAUSE })
    }

    /// Their paths.
    pub fn paths(&self) -> &[PathBuf] {
        &self.paths
    }

    /// Their contents, in the order of the paths.
    pub fn contents(&self) -> &[Vec<u8>] {
        &self.contents
    }

    /// Done once at least one file has changed, and all can be read.
    pub async fn changed(&mut self) {
        let mut fault = None;
        loop {
            sleep(self.pause).await;
            let paths = self.paths.clone();
            match spawn_blocking(move || read(&paths)).await {
                Ok(Ok(contents)) if contents != self.contents => {
                    self.contents = contents;
                    return;
                }
                Ok(Ok(_)) => fault = None,
                // Logged once, not every second.
                Ok(Err(error)) if fault.as_ref() != Some(&error.to_string()) => {
                    tracing::warn!(%error, "a watched file can't be read; its last content stays in use");
                    fault = Some(error.to_string());
                }
                _ => {}
            }
        }
    }
}

fn read(paths: &[PathBuf]) -> io::Result<Vec<Vec<u8>>> {
    let one = |path: &PathBuf| {
        let mut bytes = Vec::new();
        let read = File::open(path).and_then(|file| file.take(MAX_BYTES + 1).read_to_end(&mut bytes));
        let read = read.and_then(|_| match u64::try_from(bytes.len()) {
            Ok(length) if length <= MAX_BYTES => Ok(bytes),
            _ => Err(io::Error::other("larger than 1 MB")),
        });
        read.map_err(|error| io::Error::new(error.kind(), format!("{}: {error}", path.display())))
    };
    paths.iter().map(one).collect()
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[tokio::test]
    async fn another_content_is_seen_and_a_missing_file_is_waited_for() {
        let folder = std::env::temp_dir().join(format!("singulate-watched-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let paths = ["one", "two"].map(|name| folder.join(name));
        fs::write(&paths[0], "1").unwrap();
        assert!(WatchedFiles::read(paths.to_vec()).unwrap_err().to_string().contains("two: "));
        fs::write(&paths[1], "2").unwrap();
        let mut files = WatchedFiles::read(paths.to_vec()).unwrap();
        files.pause = Duration::from_millis(10);
        let looked = tokio::time::timeout(files.pause * 20, files.changed());
        assert!(looked.await.is_err(), "nothing has changed");
        fs::remove_file(&paths[0]).unwrap();
        let looked = tokio::time::timeout(files.pause * 20, files.changed());
        assert!(looked.await.is_err(), "half of them is nothing");
        fs::write(&paths[0], "3").unwrap();
        files.changed().await;
        assert_eq!(files.contents(), [b"3", b"2"]);
        fs::write(&paths[0], vec![0; 1_000_001]).unwrap();
        assert!(WatchedFiles::read(paths.to_vec()).unwrap_err().to_string().ends_with("larger than 1 MB"));
        fs::remove_dir_all(&folder).unwrap();
    }
}
