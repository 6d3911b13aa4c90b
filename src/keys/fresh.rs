//! New keys: the text for the caller, the entry for the file.

use std::fs::OpenOptions;
use std::io::{self, Read, Write};
use std::os::unix::fs::OpenOptionsExt;
use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;

use super::entry::{KeyDigest, KeyEntry, PREFIX, check_name};
use super::in_force::KeysError;
use super::rate::Rate;
use super::read::read;
use super::scope::Scopes;

/// As many random bytes as in the digest: 256 bits can't be guessed.
const RANDOM_BYTES: usize = 32;

/// A new key. Its text is stored nowhere else.
pub struct FreshKey {
    text: String,
    entry: KeyEntry,
}

impl FreshKey {
    /// A key from the system's random bytes.
    ///
    /// # Errors
    /// If the name is invalid, or the system gives no random bytes.
    pub fn new(name: &str, scopes: Scopes, rate: Rate) -> Result<Self, String> {
        check_name(name)?;
        let mut bytes = [0; RANDOM_BYTES];
        getrandom::fill(&mut bytes).map_err(|error| error.to_string())?;
        let text = format!("{PREFIX}{}", URL_SAFE_NO_PAD.encode(bytes));
        let digest = KeyDigest::of(text.as_bytes());
        Ok(Self { text, entry: KeyEntry { name: name.to_owned(), digest, scopes, rate } })
    }

    /// The text that the caller sends.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The entry of the keys file, as TOML.
    pub fn entry(&self) -> String {
        self.entry.text()
    }
}

/// Append the key's entry to the file. A missing file is created, readable only by its owner.
///
/// # Errors
/// If the file can't be read or written, or would become invalid.
pub fn append(key: &FreshKey, path: &Path) -> Result<(), KeysError> {
    let failed = |error: io::Error| KeysError::file(path, &error);
    let mut options = OpenOptions::new();
    let mut file = options.read(true).append(true).create(true).mode(0o600).open(path).map_err(failed)?;
    let mut before = Vec::new();
    file.read_to_end(&mut before).map_err(failed)?;
    let gap = match before.last() {
        None => "",
        Some(b'\n') => "\n",
        Some(_) => "\n\n",
    };
    let added = format!("{gap}{}", key.entry());
    read(&[&before, added.as_bytes()].concat()).map_err(|faults| KeysError::faults(path, &faults))?;
    // In one write, since the service may read it meanwhile.
    file.write_all(added.as_bytes()).and_then(|()| file.sync_all()).map_err(failed)
}
