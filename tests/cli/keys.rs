//! Keys from the command line: made, kept, and asked for at the start.

use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

use singulate::keys::Keys;

use crate::{answered, failed, file, run, singulate};

/// A service without a store ends at once, whatever else it makes of its settings.
const NO_STORE: &str = "sqlite:/nowhere/jobs.db";

/// A path of its own for each test, where nothing is yet.
fn absent(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-{}.toml", std::process::id()));
    let _ = std::fs::remove_file(&path);
    path
}

fn is_a_key(text: &str) -> bool {
    let letter = |byte: u8| byte.is_ascii_alphanumeric() || b"-_".contains(&byte);
    text.strip_prefix("sgl_").is_some_and(|rest| rest.len() == 43 && rest.bytes().all(letter))
}

#[test]
fn a_new_key_is_printed_once_and_the_file_knows_its_digest_only() {
    let path = absent("made");
    let at = path.to_str().unwrap();
    let first = answered(run(&["key", "new", "cell-4", "--api-keys-file", at]));
    assert_eq!(std::fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o600);
    let rest = ["--scopes", "read-only,metrics", "--rate", "0.5", "--api-keys-file", at];
    let second = answered(run(&[&["key", "new", "watcher"], &rest[..]].concat()));
    let text = std::fs::read_to_string(&path).unwrap();
    let keys = Keys::open(&path).unwrap();
    for (line, name) in [(&first, "cell-4"), (&second, "watcher")] {
        let key = line.strip_suffix('\n').unwrap();
        assert!(is_a_key(key) && !text.contains(key), "{line}");
        assert_eq!(keys.find(key.as_bytes()).unwrap().name(), name);
    }
    assert!(text.contains("scopes = [\"plan\", \"jobs\"]\nrate = 50\n\n[[key]]\nname = \"watcher\"\n"), "{text}");
    assert!(text.ends_with("scopes = [\"read-only\", \"metrics\"]\nrate = 0.5\n"), "{text}");
    std::fs::remove_file(path).unwrap();
}

#[test]
fn without_a_file_the_entry_is_printed_below_the_key() {
    let shown = answered(run(&["key", "new", "cell-4"]));
    let (key, entry) = shown.split_once("\n\n").unwrap();
    assert!(is_a_key(key));
    let keys = Keys::open(&file("printed-keys.toml", entry)).unwrap();
    assert_eq!(keys.find(key.as_bytes()).unwrap().name(), "cell-4");
    assert_ne!(shown, answered(run(&["key", "new", "cell-4"])));
}

#[test]
fn key_new_refuses_faulty_arguments_and_leaves_the_file_unchanged() {
    for wrong in [
        &["key", "new", ""][..],
        &["key", "new", "two words"],
        &["key", "new", "anonymous"],
        &["key", "new", "a", "--rate", "0"],
        &["key", "new", "a", "--scopes", "all"],
        &["key", "new", "a", "--api-keys-file", "/nowhere/keys.toml"],
        &["key", "new"],
        &["key"],
    ] {
        failed(&run(wrong), 2);
    }
    let path = file("faulty-keys.toml", "[[key]]\nname = 'a'\n");
    let errors = failed(&run(&["key", "new", "b", "--api-keys-file", path.to_str().unwrap()]), 2);
    assert!(errors.contains("line 1: key 1: sha256 is missing"), "{errors}");
    assert_eq!(std::fs::read_to_string(path).unwrap(), "[[key]]\nname = 'a'\n");
}

#[test]
fn a_service_that_others_can_reach_needs_keys_or_insecure_to_start() {
    for listen in ["0.0.0.0:0", "[::]:0", "192.0.2.1:1"] {
        let errors = failed(&run(&["serve", "--listen", listen, "--jobs-url", NO_STORE]), 2);
        for way in ["singulate key new NAME --api-keys-file keys.toml", "--insecure", "SINGULATE_API_KEYS_FILE=FILE"] {
            assert!(errors.contains(way), "{errors}");
        }
    }
}

#[test]
fn every_fault_of_a_keys_file_is_told_and_both_ways_at_once_are_a_contradiction() {
    let path = file("faults-keys.toml", "quiet = 'quiet'\n[[key]]\nname = 'quiet mouse'\nscopes = []\nrate = 1\n");
    let at = path.to_str().unwrap();
    let errors = failed(&run(&["serve", "--jobs-url", NO_STORE, "--api-keys-file", at]), 2);
    assert!(errors.lines().count() == 4 && errors.lines().all(|line| line.starts_with(at)), "{errors}");
    assert!(!errors.replace(at, "").contains("quiet"), "{errors}");
    let missing = failed(&run(&["serve", "--jobs-url", NO_STORE, "--api-keys-file", "/nowhere.toml"]), 2);
    assert!(missing.starts_with("/nowhere.toml: "), "{missing}");
    for insecure in ["--insecure", "--insecure=true"] {
        let errors = failed(&run(&["serve", "--jobs-url", NO_STORE, "--api-keys-file", at, insecure]), 2);
        assert!(errors.starts_with("insecure serves everybody"), "{errors}");
    }
    // As a value the next word is none: it is a command's argument, and there is no such.
    failed(&run(&["serve", "--jobs-url", NO_STORE, "--insecure", "true"]), 2);
    failed(&run(&["serve", "--jobs-url", NO_STORE, "--insecure=maybe"]), 2);
}

/// What a service says on stderr that has no store and so ends at once.
fn said(arguments: &[&str], settings: &str) -> String {
    let config = file(&format!("said-{}-{}.toml", arguments.len(), settings.len()), settings);
    let mut command = singulate(&["serve", "--config", config.to_str().unwrap(), "--jobs-url", NO_STORE]);
    let output = command.args(arguments).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    String::from_utf8(output.stderr).unwrap()
}

#[test]
fn a_service_without_keys_says_so_loudly_unless_it_is_meant_for_this_machine() {
    let loud = "NO KEYS: ";
    assert!(said(&["--listen", "127.0.0.1:0"], "").contains(loud));
    assert!(said(&["--listen", "[::1]:0"], "").contains(loud));
    assert!(said(&["--listen", "0.0.0.0:0"], "insecure = true").contains(loud));
    assert!(said(&["--listen", "0.0.0.0:0", "--insecure"], "").contains(loud));
    assert!(!said(&["--listen", "127.0.0.1:0", "--insecure"], "").contains(loud));
    let path = absent("said-keys");
    answered(run(&["key", "new", "a", "--api-keys-file", path.to_str().unwrap()]));
    assert!(!said(&["--listen", "0.0.0.0:0", "--api-keys-file", path.to_str().unwrap()], "").contains(loud));
    std::fs::remove_file(path).unwrap();
}
