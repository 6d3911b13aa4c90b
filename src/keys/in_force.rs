//! The keys in force.

use core::fmt;
use core::time::Duration;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, PoisonError, RwLock};
use std::time::Instant;

use subtle::{ConditionallySelectable, ConstantTimeEq};
use tokio::sync::Mutex;
use tokio::task::spawn_blocking;
use tokio_util::sync::CancellationToken;

use super::entry::{KeyDigest, KeyEntry};
use super::file::{KeysError, read};
use super::rights::{Scope, Spent};
use crate::watched_files::WatchedFiles;

/// The longest presented key, bytes. Longer ones are not even hashed.
const MAX_KEY: usize = 256;

/// The keys of a file, from its last valid version.
pub struct Keys {
    path: PathBuf,
    in_force: RwLock<Arc<[Arc<KeyInForce>]>>,
    files: Mutex<WatchedFiles>,
}

/// A key in force, with its usage.
struct KeyInForce {
    entry: KeyEntry,
    spent: Arc<Spent>,
    /// Cancelled once the key is removed, or its owner or scopes change.
    gone: CancellationToken,
}

/// A presented key that is in force.
#[derive(Clone)]
pub struct FoundKey(Arc<KeyInForce>);

impl fmt::Debug for Keys {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Keys({})", self.path.display())
    }
}

impl Keys {
    /// Read a keys file.
    ///
    /// # Errors
    /// If it can't be read, or all its faults.
    pub fn open(path: &Path) -> Result<Self, KeysError> {
        let files = WatchedFiles::read(vec![path.to_owned()]).map_err(|error| KeysError(vec![error.to_string()]))?;
        let entries = read(content(&files)).map_err(|faults| KeysError::faults(path, &faults))?;
        let in_force = RwLock::new(entries.into_iter().map(KeyInForce::unused).collect());
        Ok(Self { path: path.to_owned(), in_force, files: Mutex::new(files) })
    }

    /// The key with this text, in constant time: all keys are compared, so timing reveals none of them.
    pub fn find(&self, text: &[u8]) -> Option<FoundKey> {
        if text.len() > MAX_KEY {
            return None;
        }
        let presented = KeyDigest::of(text);
        let in_force = self.in_force();
        // The index past the end means none.
        let mut at = in_force.len() as u64;
        for (position, held) in (0..).zip(in_force.iter()) {
            at.conditional_assign(&position, held.entry.digest.ct_eq(&presented));
        }
        in_force.get(usize::try_from(at).ok()?).map(|held| FoundKey(Arc::clone(held)))
    }

    /// Reload the keys whenever the file changes; never ends.
    pub async fn watch(&self) {
        let mut files = self.files.lock().await;
        loop {
            files.changed().await;
            let text = content(&files).to_vec();
            // A thousand keys take a while to read, so not on a thread that serves.
            let read = spawn_blocking(move || read(&text)).await;
            let read = read.unwrap_or_else(|_| Err(vec!["the file could not be read".to_owned()]));
            if let Err(faults) = self.take_over(read) {
                tracing::error!(%faults, "the keys file is faulty; the previous keys stay in use");
            }
        }
    }

    fn in_force(&self) -> Arc<[Arc<KeyInForce>]> {
        // The list is replaced as a whole, so a panic can't leave half of one.
        Arc::clone(&self.in_force.read().unwrap_or_else(PoisonError::into_inner))
    }

    /// Puts the new keys in force. Their usage is carried over.
    fn take_over(&self, read: Result<Vec<KeyEntry>, Vec<String>>) -> Result<(), KeysError> {
        let entries = read.map_err(|faults| KeysError::faults(&self.path, &faults))?;
        let before = self.in_force();
        let mut gone: HashMap<_, _> = before.iter().map(|held| (held.entry.digest, held)).collect();
        let after = |entry: KeyEntry| {
            let held = gone.get(&entry.digest).copied();
            let spent = held.map(|held| Arc::clone(&held.spent)).unwrap_or_default();
            let same = held.filter(|held| held.entry.is_same(&entry));
            let end = same.and_then(|_| gone.remove(&entry.digest)).map(|held| held.gone.clone()).unwrap_or_default();
            Arc::new(KeyInForce { entry, spent, gone: end })
        };
        let after: Arc<[Arc<KeyInForce>]> = entries.into_iter().map(after).collect();
        tracing::info!(path = %self.path.display(), keys = after.len(), "the keys were replaced");
        *self.in_force.write().unwrap_or_else(PoisonError::into_inner) = after;
        gone.into_values().for_each(|held| held.gone.cancel());
        Ok(())
    }
}

fn content(files: &WatchedFiles) -> &[u8] {
    files.contents().first().map_or(&[], Vec::as_slice)
}

impl KeyInForce {
    /// A key without usage.
    fn unused(entry: KeyEntry) -> Arc<Self> {
        Arc::new(Self { entry, spent: Arc::default(), gone: CancellationToken::new() })
    }
}

impl FoundKey {
    /// The owner's name.
    pub fn name(&self) -> &str {
        &self.0.entry.name
    }

    /// True if it has one of these scopes.
    pub fn is_for(&self, scopes: &[Scope]) -> bool {
        self.0.entry.scopes.any_of(scopes)
    }

    /// Count one request.
    ///
    /// # Errors
    /// If the rate is exceeded: the time until the next request.
    pub fn spend(&self, now: Instant) -> Result<(), Duration> {
        self.0.spent.take(self.0.entry.rate, now)
    }

    /// Cancelled once the key is removed or changed.
    pub fn gone(&self) -> &CancellationToken {
        &self.0.gone
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keys::{FreshKey, append};

    fn fresh(name: &str, scopes: &str, rate: &str) -> FreshKey {
        FreshKey::new(name, scopes.parse().unwrap(), rate.parse().unwrap()).unwrap()
    }

    /// A separate file for each test.
    fn keys(name: &str, made: &[&FreshKey]) -> Keys {
        let path = std::env::temp_dir().join(format!("singulate-keys-{}-{name}", std::process::id()));
        made.iter().for_each(|key| append(key, &path).unwrap());
        let keys = Keys::open(&path).unwrap();
        std::fs::remove_file(path).unwrap();
        keys
    }

    #[test]
    fn a_key_is_found_by_its_text_and_nothing_else_is() {
        let made = ["a", "b", "c"].map(|name| fresh(name, "plan", "1"));
        let keys = keys("found", &made.each_ref());
        for (key, name) in made.iter().zip(["a", "b", "c"]) {
            let found = keys.find(key.text().as_bytes()).unwrap();
            assert!(found.name() == name && found.is_for(&[Scope::Plan]) && !found.is_for(&[Scope::Jobs]));
            assert!(keys.find(&key.text().as_bytes()[1..]).is_none());
        }
        assert!(keys.find(b"").is_none() && keys.find("k".repeat(257).as_bytes()).is_none());
        assert_eq!(made[0].text().len(), "sgl_".len() + 43);
    }

    #[test]
    fn a_new_list_replaces_the_old_one_but_keeps_the_used_rates() {
        let [stays, faster, goes, changes] = ["1", "1", "1", "1"].map(|rate| fresh("a", "plan", rate));
        let keys = keys("replaced", &[&stays, &faster, &goes, &changes]);
        let find = |key: &FreshKey| keys.find(key.text().as_bytes());
        let now = Instant::now();
        let before = [&stays, &faster, &goes, &changes].map(|key| find(key).unwrap());
        assert!(before.iter().all(|found| found.spend(now).is_ok()));
        let new = fresh("n", "jobs", "1");
        let [kept, quick] = [stays.entry(), faster.entry().replace("rate = 1", "rate = 10")];
        let other = changes.entry().replace("plan", "jobs");
        keys.take_over(read([kept, quick, other, new.entry()].concat().as_bytes())).unwrap();
        assert!(find(&new).unwrap().spend(now).is_ok() && find(&goes).is_none());
        assert_eq!(find(&stays).unwrap().spend(now), Err(Duration::from_secs(1)));
        assert_eq!(find(&faster).unwrap().spend(now + Duration::from_millis(100)), Ok(()));
        assert_eq!(before.map(|found| found.gone().is_cancelled()), [false, false, true, true]);
        assert!(!find(&changes).unwrap().gone().is_cancelled());
    }

    #[test]
    fn a_faulty_list_is_refused_as_a_whole() {
        let [first, second] = ["a", "b"].map(|name| fresh(name, "plan", "1"));
        let keys = keys("faulty", &[&first]);
        let before = keys.find(first.text().as_bytes()).unwrap();
        for faulty in [format!("{}[[key]]\n", second.entry()), String::new(), "[[key]".to_owned()] {
            let error = keys.take_over(read(faulty.as_bytes())).unwrap_err();
            assert!(error.0.iter().all(|fault| fault.contains("-faulty: ")), "{error}");
        }
        assert!(keys.find(second.text().as_bytes()).is_none() && keys.find(first.text().as_bytes()).is_some());
        assert!(!before.gone().is_cancelled());
    }
}
