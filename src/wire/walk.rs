//! Walks the text of a body that is not JSON, or has a repeated field: finds common slips, each with its place.
//!
//! The JSON library stops at the first slip, without its pointer, and keeps the last of two equal names. This walk runs
//! only in these two cases.

use std::collections::HashSet;

use serde_json::Value;

use super::path::{MAX_FAULTS, Path};
use singulate_planner::scene::MAX_ID_LENGTH;

/// The deepest nesting of values, as in the JSON library.
const MAX_DEPTH: usize = 128;
/// The longest excerpt of a body, characters.
const MAX_SHOWN: usize = 40;
/// The longest total of the names in a pointer, bytes. Each fault has a pointer, and real names are shorter.
const MAX_NAMED: usize = 1000;
/// The literal names of JSON.
const WORDS: [&str; 3] = ["true", "false", "null"];
/// Non-finite numbers as programs write them, in lower case.
const NO_NUMBERS: [&str; 3] = ["nan", "inf", "infinity"];

/// The results of a walk.
#[derive(Debug, Default)]
pub(super) struct Walk {
    /// Values such as `NaN`, which JSON can't express.
    pub(super) no_numbers: Vec<NoNumber>,
    /// Fields whose name an earlier field of the same object has.
    pub(super) repeated: Vec<Repeated>,
    /// Why the walk ended early, and where in the text.
    pub(super) slip: Option<(Slip, usize)>,
}

/// A word instead of a number.
#[derive(Debug)]
pub(super) struct NoNumber {
    pub(super) word: String,
    pub(super) at: usize,
    pub(super) pointer: String,
    /// The `id` of the innermost object around it that has one, unless it is longer than ids may be.
    pub(super) id: Option<String>,
}

/// A repeated field.
#[derive(Debug)]
pub(super) struct Repeated {
    pub(super) name: String,
    pub(super) at: usize,
    pub(super) pointer: String,
}

/// A common slip that is not JSON.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Slip {
    Comment,
    /// Quotes of this kind.
    Quote(&'static str),
    TrailingComma,
    /// An unknown word where a value is expected.
    Word(String),
    /// A name without quotes.
    BareName(String),
}

/// Why a walk stops. Without a slip, the JSON library's own message is used.
type Stop = Option<Slip>;

/// Walk over a whole text.
pub(super) fn walk(text: &[u8]) -> Walk {
    let mut walker = Walker { text, at: 0, found: Walk::default() };
    let whole = walker.value(&Path::Root, 0).and_then(|_| {
        walker.space();
        if walker.at == text.len() { Ok(()) } else { Err(walker.slip()) }
    });
    walker.found.slip = whole.err().flatten().map(|slip| (slip, walker.at));
    walker.found
}

/// True if the text repeats a name within one object; `value` is the parsed text. Each field has one colon outside of
/// strings, and the library keeps one field per name.
pub(super) fn repeats(text: &[u8], value: &Value) -> bool {
    let (mut colons, mut inside, mut escaped) = (0, false, false);
    for &byte in text {
        match byte {
            _ if escaped => escaped = false,
            b'\\' => escaped = inside,
            b'"' => inside = !inside,
            b':' if !inside => colons += 1,
            _ => {}
        }
    }
    colons != fields(value)
}

fn fields(value: &Value) -> usize {
    match value {
        Value::Object(map) => map.len() + map.values().map(fields).sum::<usize>(),
        Value::Array(items) => items.iter().map(fields).sum(),
        _ => 0,
    }
}

/// The pointer; empty if the names in it are too long.
fn pointer(path: &Path<'_>) -> String {
    if path.named() > MAX_NAMED { String::new() } else { path.to_string() }
}

struct Walker<'t> {
    text: &'t [u8],
    at: usize,
    found: Walk,
}

impl Walker<'_> {
    fn peek(&self) -> Option<u8> {
        self.text.get(self.at).copied()
    }

    fn skip_while(&mut self, mut wanted: impl FnMut(u8) -> bool) {
        while self.peek().is_some_and(&mut wanted) {
            self.at += 1;
        }
    }

    fn space(&mut self) {
        self.skip_while(|byte| b" \t\r\n".contains(&byte));
    }

    /// The slip at this place.
    fn slip(&self) -> Stop {
        match &self.text[self.at..] {
            [b'#', ..] | [b'/', b'/' | b'*', ..] => Some(Slip::Comment),
            [b'\'', ..] => Some(Slip::Quote("single")),
            [0xe2, 0x80, 0x98..=0x9f, ..] => Some(Slip::Quote("typographic")),
            _ => None,
        }
    }

    /// A value; returns its text if it is a string.
    fn value(&mut self, path: &Path<'_>, depth: usize) -> Result<Option<String>, Stop> {
        self.space();
        let sign = self.peek().is_some_and(|byte| b"+-".contains(&byte));
        let next = self.text.get(self.at + usize::from(sign)).copied().unwrap_or_default();
        match self.peek() {
            Some(b'{' | b'[') if depth == MAX_DEPTH => Err(None),
            Some(b'{') => self.object(path, depth).map(|()| None),
            Some(b'[') => self.array(path, depth).map(|()| None),
            Some(b'"') => self.string().map(Some),
            Some(byte) if byte.is_ascii_digit() || byte == b'-' && next.is_ascii_digit() => {
                self.skip_while(|byte| byte.is_ascii_digit() || b"+-.eE".contains(&byte));
                Ok(None)
            }
            Some(_) if next.is_ascii_alphabetic() => self.word(path).map(|()| None),
            _ => Err(self.slip()),
        }
    }

    fn object(&mut self, path: &Path<'_>, depth: usize) -> Result<(), Stop> {
        let (first, mut id) = (self.found.no_numbers.len(), None);
        let walked = self.fields(path, depth, &mut id);
        for no_number in &mut self.found.no_numbers[first..] {
            no_number.id = no_number.id.take().or_else(|| id.clone());
        }
        walked
    }

    fn fields(&mut self, path: &Path<'_>, depth: usize, id: &mut Option<String>) -> Result<(), Stop> {
        let (mut names, mut comma) = (HashSet::new(), None);
        self.at += 1;
        loop {
            self.space();
            let at = self.at;
            match self.peek() {
                Some(b'"') => {}
                Some(b'}') => return self.close(comma),
                Some(byte) if byte.is_ascii_alphabetic() || byte == b'_' => {
                    let name = self.bare();
                    self.at = at;
                    return Err(Some(Slip::BareName(name)));
                }
                _ => return Err(self.slip()),
            }
            let name = self.string()?;
            self.space();
            if self.peek() != Some(b':') {
                return Err(self.slip());
            }
            self.at += 1;
            let field = path.field(&name);
            if names.contains(&name) && self.found.repeated.len() < MAX_FAULTS {
                let shown = name.chars().take(MAX_SHOWN).collect();
                self.found.repeated.push(Repeated { name: shown, at, pointer: pointer(&field) });
            }
            let text = self.value(&field, depth + 1)?;
            if name == "id" {
                *id = text.filter(|text| text.chars().nth(MAX_ID_LENGTH).is_none());
            }
            names.insert(name);
            comma = self.comma(b'}')?;
        }
    }

    fn array(&mut self, path: &Path<'_>, depth: usize) -> Result<(), Stop> {
        let mut comma = None;
        self.at += 1;
        for position in 0.. {
            self.space();
            if self.peek() == Some(b']') {
                return self.close(comma);
            }
            self.value(&path.item(position), depth + 1)?;
            comma = self.comma(b']')?;
        }
        Ok(())
    }

    /// The place of the comma after an entry; `None` if the list ends.
    fn comma(&mut self, close: u8) -> Result<Option<usize>, Stop> {
        self.space();
        match self.peek() {
            Some(b',') => {
                self.at += 1;
                Ok(Some(self.at - 1))
            }
            Some(byte) if byte == close => Ok(None),
            _ => Err(self.slip()),
        }
    }

    /// The end of an object or a list; a slip if a comma precedes it.
    fn close(&mut self, comma: Option<usize>) -> Result<(), Stop> {
        if let Some(at) = comma {
            self.at = at;
            return Err(Some(Slip::TrailingComma));
        }
        self.at += 1;
        Ok(())
    }

    fn string(&mut self) -> Result<String, Stop> {
        let start = self.at;
        let mut escaped = false;
        self.at += 1;
        self.skip_while(|byte| {
            let ends = byte == b'"' && !escaped;
            escaped = byte == b'\\' && !escaped;
            !ends
        });
        self.at = self.text.len().min(self.at + 1);
        serde_json::from_slice(&self.text[start..self.at]).map_err(|_| None)
    }

    /// A word where a value is expected.
    fn word(&mut self, path: &Path<'_>) -> Result<(), Stop> {
        let at = self.at;
        let word = self.bare();
        if WORDS.contains(&word.as_str()) {
            return Ok(());
        }
        if self.at == self.text.len() && WORDS.iter().any(|known| known.starts_with(&word)) {
            // The text ends too early.
            return Err(None);
        }
        let unsigned = word.trim_start_matches(['+', '-']).to_ascii_lowercase();
        if !NO_NUMBERS.contains(&unsigned.as_str()) {
            self.at = at;
            return Err(Some(Slip::Word(word)));
        }
        if self.found.no_numbers.len() < MAX_FAULTS {
            self.found.no_numbers.push(NoNumber { word, at, pointer: pointer(path), id: None });
        }
        Ok(())
    }

    /// A word without quotes, cut to the length shown.
    fn bare(&mut self) -> String {
        let start = self.at;
        self.skip_while(|byte| byte.is_ascii_alphanumeric() || b"+-_.".contains(&byte));
        self.text[start..self.at].iter().take(MAX_SHOWN).map(|&byte| char::from(byte)).collect()
    }
}
