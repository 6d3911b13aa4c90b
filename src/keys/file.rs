//! The keys file: reads it, and appends a key. Faults name their line and never repeat its text: it may be a misplaced
//! key.

use std::collections::HashSet;
use std::fs::OpenOptions;
use std::io::{self, Read, Write};
use std::os::unix::fs::OpenOptionsExt;
use std::path::Path;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::entry::{FreshKey, KeyDigest, KeyEntry, check_name};
use super::rights::{Rate, Scopes};

/// The most keys in a file. Each request is compared with all of them, some 60 µs for this many.
const MAX_KEYS: usize = 1000;

/// The most faults reported.
const MAX_LISTED: usize = 20;

const FIELDS: [&str; 4] = ["name", "sha256", "scopes", "rate"];

/// All faults of a keys file, one line each.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}", .0.join("\n"))]
pub struct KeysError(pub Vec<String>);

impl KeysError {
    pub(super) fn file(path: &Path, error: &io::Error) -> Self {
        Self(vec![format!("{}: {error}", path.display())])
    }

    pub(super) fn faults(path: &Path, faults: &[String]) -> Self {
        Self(faults.iter().map(|fault| format!("{}: {fault}", path.display())).collect())
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

/// The keys in the text.
///
/// # Errors
/// All faults, each with its line.
pub(super) fn read(text: &[u8]) -> Result<Vec<KeyEntry>, Vec<String>> {
    let text = str::from_utf8(text).map_err(|_| vec!["not UTF-8".to_owned()])?;
    let mut reader = Reader { text, faults: Vec::new() };
    let entries = reader.document();
    if reader.faults.is_empty() { Ok(entries) } else { Err(reader.faults) }
}

struct Reader<'a> {
    text: &'a str,
    faults: Vec<String>,
}

impl Reader<'_> {
    fn line(&self, at: usize) -> usize {
        self.text.as_bytes().iter().take(at).filter(|byte| **byte == b'\n').count() + 1
    }

    fn fault(&mut self, at: usize, what: &str) {
        if self.faults.len() < MAX_LISTED {
            self.faults.push(format!("line {}: {what}", self.line(at)));
        }
    }

    fn document(&mut self) -> Vec<KeyEntry> {
        let table = match DeTable::parse(self.text) {
            Ok(table) => table.into_inner(),
            Err(error) => {
                // The message names the expected value, not the actual one.
                self.fault(error.span().map_or(0, |span| span.start), error.message());
                return Vec::new();
            }
        };
        let (mut entries, mut digests) = (Vec::new(), HashSet::new());
        for (name, value) in &table {
            match value.get_ref() {
                DeValue::Array(keys) if name.get_ref() == "key" && keys.len() > MAX_KEYS => {
                    self.fault(name.span().start, &format!("more than {MAX_KEYS} keys"));
                }
                DeValue::Array(keys) if name.get_ref() == "key" => {
                    let entry = |(key, number)| self.key(key, number, &mut digests);
                    entries = keys.iter().zip(1..).filter_map(entry).collect();
                }
                _ => self.fault(name.span().start, "here are only entries that begin with [[key]]"),
            }
        }
        if entries.is_empty() && self.faults.is_empty() {
            self.faults.push("there is no key; make one with `singulate key new`".to_owned());
        }
        entries
    }

    fn key(&mut self, key: &Spanned<DeValue<'_>>, number: usize, digests: &mut HashSet<KeyDigest>) -> Option<KeyEntry> {
        let start = key.span().start;
        let Some(table) = key.get_ref().as_table() else {
            self.fault(start, &format!("key {number}: an entry begins with [[key]]"));
            return None;
        };
        for name in table.keys().filter(|name| !FIELDS.contains(&name.get_ref().as_ref())) {
            self.fault(name.span().start, &format!("key {number}: an unknown field; known are {}", FIELDS.join(", ")));
        }
        let name = self.field(table, (start, number, "name"), |value| {
            let name = value.as_str().unwrap_or_default();
            check_name(name).map(|()| name.to_owned())
        });
        let digest = self.field(table, (start, number, "sha256"), |value| {
            let digest = value.as_str().and_then(KeyDigest::read);
            let digest = digest.ok_or("sha256 is 64 hexadecimal digits, the SHA-256 of the key's text")?;
            if digest == KeyDigest::of(b"") {
                return Err("this is the sha256 of no text at all".to_owned());
            }
            digests.insert(digest).then_some(digest).ok_or("this sha256 stands in another entry too".to_owned())
        });
        let scopes = self.field(table, (start, number, "scopes"), |value| {
            let words = value.as_array().into_iter().flat_map(|words| words.iter());
            Scopes::read(words.map(|word| word.get_ref().as_str().unwrap_or_default()))
        });
        let rate = self.field(table, (start, number, "rate"), |value| match value {
            DeValue::Integer(number) if number.radix() == 10 => number.as_str().parse(),
            DeValue::Float(number) => number.as_str().parse(),
            _ => Rate::new(f64::NAN),
        });
        Some(KeyEntry { name: name?, digest: digest?, scopes: scopes?, rate: rate? })
    }

    /// A field of the entry that begins at `start`.
    fn field<T>(
        &mut self,
        table: &DeTable<'_>,
        (start, number, name): (usize, usize, &str),
        read: impl FnOnce(&DeValue<'_>) -> Result<T, String>,
    ) -> Option<T> {
        let (at, read) = match table.get(name) {
            Some(value) => (value.span().start, read(value.get_ref())),
            None => (start, Err(format!("{name} is missing"))),
        };
        read.map_err(|what| self.fault(at, &format!("key {number}: {what}"))).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn digest(text: &str) -> String {
        KeyDigest::of(text.as_bytes()).text()
    }

    fn entry(name: &str, key: &str) -> String {
        format!("[[key]]\nname = '{name}'\nsha256 = '{}'\nscopes = ['plan']\nrate = 50\n", digest(key))
    }

    #[track_caller]
    fn faults(text: &str) -> Vec<String> {
        read(text.as_bytes()).err().unwrap_or_default()
    }

    #[test]
    fn an_entry_comes_back_as_it_is_written() {
        let text = format!(
            "# ours\n[[key]]\nname = \"cell'4\\\"\"\nsha256 = \"{}\"\nscopes = [\"plan\", \"jobs\"]\nrate = 0.5",
            digest("k")
        );
        let entries = read(text.as_bytes()).ok().unwrap();
        let written: String = entries.iter().map(KeyEntry::text).collect();
        let again = read(written.as_bytes()).ok().unwrap();
        assert!(again.len() == 1 && again[0].is_same(&entries[0]) && again[0].rate == entries[0].rate, "{written}");
        assert_eq!(entries[0].name, "cell'4\"");
    }

    #[test]
    fn a_name_may_come_twice_and_a_key_may_not() {
        assert_eq!(faults(&[entry("a", "k"), entry("a", "l")].concat()), [""; 0]);
        let twice = faults(&[entry("a", "k"), entry("b", "k")].concat());
        assert_eq!(twice, ["line 8: key 2: this sha256 stands in another entry too"]);
    }

    #[test]
    fn every_fault_is_told_with_its_line_and_nothing_of_the_file_is_shown() {
        let text = "quiet = 1\n[[key]]\nname = 'quiet mouse'\nsha256 = 'quiet'\nscopes = ['plan', 'quiet']\nrate = 'quiet'\n\
            quiet = 1\n[[key]]\n[[key]]\nname = 'quiet'\nsha256 = 1\nscopes = 'quiet'\nrate = 0\n";
        let found = faults(text);
        let known = "one or more of plan, jobs, read-only, metrics";
        let expected = [
            "line 1: here are only entries that begin with [[key]]".to_owned(),
            "line 3: key 1: a name is 1 to 64 printable ASCII characters without spaces".to_owned(),
            "line 4: key 1: sha256 is 64 hexadecimal digits, the SHA-256 of the key's text".to_owned(),
            format!("line 5: key 1: scopes are {known}"),
            "line 6: key 1: a rate is a number of requests per second from 0.001 to 1000000".to_owned(),
            "line 7: key 1: an unknown field; known are name, sha256, scopes, rate".to_owned(),
            "line 8: key 2: name is missing".to_owned(),
            "line 8: key 2: sha256 is missing".to_owned(),
            "line 8: key 2: scopes is missing".to_owned(),
            "line 8: key 2: rate is missing".to_owned(),
            "line 11: key 3: sha256 is 64 hexadecimal digits, the SHA-256 of the key's text".to_owned(),
            format!("line 12: key 3: scopes are {known}"),
            "line 13: key 3: a rate is a number of requests per second from 0.001 to 1000000".to_owned(),
        ];
        let mut sorted = found.clone();
        sorted.sort_by_key(|fault| fault[5..].split(':').next().unwrap().parse::<usize>().unwrap());
        assert_eq!(sorted, expected);
        for broken in ["[[key]]\nname = 'quiet\n", "[[key]]\nquiet\n", "[[key]]\nname = quiet\n", "key = 'quiet'"] {
            let found = faults(broken);
            assert!(found.len() == 1 && found[0].starts_with("line ") && !found[0].contains("quiet"), "{found:?}");
        }
    }

    #[test]
    fn a_list_has_one_key_and_not_too_many() {
        for none in ["", "# nothing\n", "key = []"] {
            assert!(faults(none)[0].starts_with("there is no key"), "{none}");
        }
        let many = |count: usize| (0..count).map(|at| entry("a", &at.to_string())).collect::<String>();
        assert_eq!(faults(&many(MAX_KEYS)), [""; 0]);
        assert_eq!(faults(&many(MAX_KEYS + 1)), ["line 1: more than 1000 keys"]);
        assert_eq!(faults(&"[[key]]\n".repeat(MAX_KEYS)).len(), MAX_LISTED);
        assert_eq!(faults(&entry("a", "")), ["line 3: key 1: this is the sha256 of no text at all"]);
        assert_eq!(read(b"\xff").err().unwrap(), ["not UTF-8"]);
    }
}
