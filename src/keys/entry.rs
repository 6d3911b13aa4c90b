//! One key: its entry in the keys file, and how a new one is made.

use base64::Engine as _;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use sha2::{Digest, Sha256};
use subtle::ConstantTimeEq;

use super::rights::{Rate, Scopes};

/// The longest name, bytes: room for a cell or a person, none for a document.
const MAX_NAME: usize = 64;
/// The name of all who come without a key. No key has it.
pub const ANONYMOUS: &str = "anonymous";
/// The prefix of all our keys, so that a leaked key can be recognised.
const PREFIX: &str = "sgl_";
/// As many random bytes as in the digest: 256 bits can't be guessed.
const RANDOM_BYTES: usize = 32;

/// The SHA-256 of a key's text. Never displayed. Compare presented keys only by [`ConstantTimeEq`].
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct KeyDigest([u8; 32]);

impl KeyDigest {
    /// The digest of this text.
    pub(super) fn of(key: &[u8]) -> Self {
        Self(Sha256::digest(key).into())
    }

    /// From 64 hexadecimal digits.
    pub(super) fn read(text: &str) -> Option<Self> {
        let digit = |byte: u8| char::from(byte).to_digit(16).and_then(|digit| u8::try_from(digit).ok());
        let digits = text.bytes().map(digit).collect::<Option<Vec<u8>>>()?;
        let bytes: Vec<u8> =
            digits.chunks(2).map(|pair| pair.iter().fold(0, |byte, digit| byte << 4 | digit)).collect();
        bytes.try_into().ok().filter(|_| digits.len() == 64).map(Self)
    }

    /// Hexadecimal.
    pub(super) fn text(&self) -> String {
        self.0.iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

impl ConstantTimeEq for KeyDigest {
    fn ct_eq(&self, other: &Self) -> subtle::Choice {
        self.0.ct_eq(&other.0)
    }
}

/// One key.
pub(super) struct KeyEntry {
    pub(super) name: String,
    pub(super) digest: KeyDigest,
    pub(super) scopes: Scopes,
    pub(super) rate: Rate,
}

impl KeyEntry {
    /// True for the same key with the same owner and scopes.
    pub(super) fn is_same(&self, other: &Self) -> bool {
        (&self.digest, &self.name, &self.scopes) == (&other.digest, &other.name, &other.scopes)
    }

    /// The entry as in the keys file.
    pub(super) fn text(&self) -> String {
        let Self { name, digest, scopes, rate } = self;
        let name = toml::Value::from(name.as_str());
        format!("[[key]]\nname = {name}\nsha256 = \"{}\"\nscopes = {scopes}\nrate = {rate}\n", digest.text())
    }
}

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

/// Checks a name, which appears in logs and owns jobs.
///
/// # Errors
/// The rule that is broken, without the name: it may be a misplaced key.
pub(super) fn check_name(name: &str) -> Result<(), String> {
    if !(1..=MAX_NAME).contains(&name.len()) || !name.bytes().all(|byte| byte.is_ascii_graphic()) {
        return Err(format!("a name is 1 to {MAX_NAME} printable ASCII characters without spaces"));
    }
    if name == ANONYMOUS {
        return Err(format!("the name {ANONYMOUS} is reserved for calls without a key"));
    }
    if name.starts_with(PREFIX) {
        return Err("this is a key, not a name".to_owned());
    }
    Ok(())
}

/// A client's text with each possible key shortened to [`PREFIX`].
pub fn without_keys(text: &str) -> String {
    let (mut kept, mut rest) = (String::new(), text);
    while let Some((before, after)) = rest.split_once(PREFIX) {
        kept += &format!("{before}{PREFIX}…");
        rest = after.trim_start_matches(|c: char| c.is_ascii_alphanumeric() || "-_".contains(c));
    }
    kept + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_digest_is_read_as_it_is_written() {
        let text = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(KeyDigest::of(b"abc").text(), text);
        for same in [text.to_owned(), text.to_uppercase()] {
            assert_eq!(KeyDigest::read(&same).unwrap().text(), text);
        }
        for wrong in ["", &text[1..], &text[2..], &format!("{text}0"), &format!("{text}00"), &text.replace('b', "g")] {
            assert!(KeyDigest::read(wrong).is_none(), "{wrong}");
        }
    }

    #[test]
    fn text_that_may_be_a_key_is_cut_from_a_path() {
        let key = "sgl_47DEQpj8HBSa-_TImW-5JCeuQeRkm5NMpJWZG3hSuFU";
        for (text, kept) in [
            ("/v1/plans", "/v1/plans"),
            (key, "sgl_…"),
            (&format!("/v1/{key}/plans&key={key}"), "/v1/sgl_…/plans&key=sgl_…"),
            ("/sgl_", "/sgl_…"),
        ] {
            assert_eq!(without_keys(text), kept);
        }
    }

    #[test]
    fn a_name_is_short_and_can_be_read_anywhere() {
        for name in ["a", "cell-4/17", "o'neil\\\"", &"n".repeat(64)] {
            assert!(check_name(name).is_ok(), "{name}");
        }
        for name in ["", "a b", "a\n", "Müller", ANONYMOUS, "sgl_abc", &"n".repeat(65)] {
            assert!(check_name(name).is_err(), "{name}");
        }
    }
}
