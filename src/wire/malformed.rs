//! Explains faults of a body that is not JSON, for humans.

use core::fmt;

use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};

use super::code::ErrorCode;
use super::path::MAX_ERRORS;
use super::problem::{ErrorItem, Problem, ProblemKind};
use super::walk::{NoNumber, Slip, Walk};

/// The byte order mark that some editors add to UTF-8; not JSON.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";
/// The first bytes of gzip.
const GZIP: &[u8] = b"\x1f\x8b";

/// The problem of a body that is not JSON, and what a walk has found in it.
pub(super) fn malformed(body: &[u8], found: Walk<'_>) -> Problem {
    let faults = faults(body, found);
    let detail = faults.first().map_or_else(|| "not JSON".to_owned(), |fault| fault.detail.clone());
    Problem::new(ProblemKind::MalformedJson, detail).with_errors(faults)
}

fn faults(body: &[u8], found: Walk<'_>) -> Vec<ErrorItem> {
    if body.trim_ascii().is_empty() {
        return vec![fault("", format_args!("the body is empty"))];
    }
    let whole = |what: fmt::Arguments<'_>| vec![no_json("", what)];
    if let Some(encoding) = wide_encoding(body) {
        return whole(format_args!("it is encoded in {encoding}; send UTF-8"));
    }
    if body.starts_with(BYTE_ORDER_MARK) {
        return whole(format_args!("it begins with a byte order mark; send UTF-8 without it"));
    }
    if body.starts_with(GZIP) {
        return whole(format_args!("it is compressed by gzip; send it uncompressed"));
    }
    let mut places = Places::of(body);
    let mut faults: Vec<ErrorItem> =
        found.no_numbers.iter().map(|no_number| of_no_number(no_number, places.at(no_number.at))).collect();
    faults.extend(found.slip.map(|(slip, at)| no_json("", format_args!("{}", sentence(&slip, places.at(at))))));
    faults.truncate(MAX_ERRORS);
    if !faults.is_empty() {
        return faults;
    }
    match core::str::from_utf8(body).map_err(|wrong| wrong.valid_up_to()) {
        Ok(_) => whole(format_args!("{}", the_librarys_words(body))),
        Err(at) => whole(format_args!("the byte 0x{:02x} at {} is not UTF-8", body[at], places.at(at))),
    }
}

/// What the JSON library says about a body that is not JSON.
fn the_librarys_words(body: &[u8]) -> String {
    serde_json::from_slice::<Sound>(body).err().map(|error| error.to_string()).unwrap_or_default()
}

fn fault(pointer: &str, detail: fmt::Arguments<'_>) -> ErrorItem {
    ErrorItem::new(ErrorCode::MalformedJson, pointer, detail.to_string())
}

fn no_json(pointer: &str, what: fmt::Arguments<'_>) -> ErrorItem {
    fault(pointer, format_args!("the body is not JSON: {what}"))
}

fn of_no_number(no_number: &NoNumber, line: Place) -> ErrorItem {
    let NoNumber { word, pointer, id, .. } = no_number;
    let object = id.as_ref().map(|id| format!(" of object '{id}'")).unwrap_or_default();
    let place = if pointer.is_empty() { String::new() } else { format!(", in {pointer}{object}") };
    no_json(pointer, format_args!("{word} stands at {line}{place}; JSON has only finite numbers"))
}

fn sentence(slip: &Slip, place: Place) -> String {
    match slip {
        Slip::Comment => format!("a comment stands at {place}; JSON has no comments"),
        Slip::Quote(kind) => {
            format!("a {kind} quote stands at {place}; JSON puts names and texts in double quotes")
        }
        Slip::TrailingComma => format!("a trailing comma stands at {place}; no comma follows the last entry"),
        Slip::Word(word) => match word.to_ascii_lowercase().as_str() {
            same @ ("true" | "false" | "null") => format!("{word} stands at {place}; JSON writes {same}"),
            "none" => format!("{word} stands at {place}; JSON writes null"),
            _ => format!("the word '{word}' stands at {place}; JSON puts texts in double quotes"),
        },
        Slip::BareName(name) => {
            format!("the name '{name}' at {place} has no quotes; JSON puts names in double quotes")
        }
    }
}

/// The encoding of a text with zero bytes between its letters.
fn wide_encoding(body: &[u8]) -> Option<&'static str> {
    // The first letter of a request is ASCII; a byte order mark may precede it.
    match body {
        [0xff, 0xfe, 0, 0, ..] | [0, 0, 0xfe, 0xff, ..] | [_, 0, 0, 0, ..] | [0, 0, 0, _, ..] => Some("UTF-32"),
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] | [1..=255, 0, ..] | [0, 1..=255, ..] => Some("UTF-16"),
        _ => None,
    }
}

/// A line and column, as editors count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Place {
    line: usize,
    column: usize,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {} column {}", self.line, self.column)
    }
}

/// Finds places in ascending order, so that many of them cost one pass over the text.
pub(super) struct Places<'t> {
    text: &'t [u8],
    at: usize,
    place: Place,
}

impl<'t> Places<'t> {
    pub(super) fn of(text: &'t [u8]) -> Self {
        Self { text, at: 0, place: Place { line: 1, column: 1 } }
    }

    /// The place of this byte, which must not precede the last one asked for.
    pub(super) fn at(&mut self, at: usize) -> Place {
        for &byte in self.text.get(self.at..at).unwrap_or_default() {
            if byte == b'\n' {
                self.place = Place { line: self.place.line + 1, column: 1 };
            } else if byte & 0xc0 != 0x80 {
                // Any other byte continues a character.
                self.place.column += 1;
            }
        }
        self.at = self.at.max(at);
        self.place
    }
}

/// Any JSON, of which nothing is kept: the library reads as far as it can.
#[derive(Debug)]
pub(super) struct Sound;

impl<'de> Deserialize<'de> for Sound {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Anything)
    }
}

struct Anything;

impl<'de> Visitor<'de> for Anything {
    type Value = Sound;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("JSON")
    }

    fn visit_unit<E>(self) -> Result<Sound, E> {
        Ok(Sound)
    }

    fn visit_bool<E>(self, _: bool) -> Result<Sound, E> {
        Ok(Sound)
    }

    fn visit_i64<E>(self, _: i64) -> Result<Sound, E> {
        Ok(Sound)
    }

    fn visit_u64<E>(self, _: u64) -> Result<Sound, E> {
        Ok(Sound)
    }

    fn visit_f64<E>(self, _: f64) -> Result<Sound, E> {
        Ok(Sound)
    }

    fn visit_str<E>(self, _: &str) -> Result<Sound, E> {
        Ok(Sound)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Sound, A::Error> {
        while items.next_element::<Sound>()?.is_some() {}
        Ok(Sound)
    }

    /// The library hands numbers over like this too.
    fn visit_map<A: MapAccess<'de>>(self, mut fields: A) -> Result<Sound, A::Error> {
        while fields.next_entry::<Sound, Sound>()?.is_some() {}
        Ok(Sound)
    }
}
