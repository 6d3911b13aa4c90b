//! Walks the text of a body: says whether it is JSON, makes a value of it, and finds fields that are there twice and, where it
//! is no JSON, the usual slips, each with its place.
//!
//! The JSON library stops at the first slip, without its pointer, and lets the last of two equal names win. It still reads
//! the strings.

use std::borrow::Cow;
use std::collections::HashMap;

use super::json::{Json, Object};
use super::path::{MAX_ERRORS, Path};
use singulate_planner::scene::MAX_ID_LENGTH;

/// The deepest nesting of values, as in the JSON library.
pub(super) const MAX_DEPTH: usize = 127;
/// The longest excerpt of a body, characters.
const MAX_SHOWN: usize = 40;
/// The values that are words.
const WORDS: [&str; 3] = ["true", "false", "null"];
/// Non-finite numbers as programs write them, in lower case.
const NO_NUMBERS: [&str; 3] = ["nan", "inf", "infinity"];

/// What a walk has found.
#[derive(Debug)]
pub(super) struct Walk<'t> {
    /// The value. `None` if the text is not JSON.
    pub(super) value: Option<Json<'t>>,
    /// Values such as `NaN`, which JSON has no way to write.
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
pub(super) fn walk(text: &[u8]) -> Walk<'_> {
    let found = Walk { value: None, no_numbers: Vec::new(), repeated: Vec::new(), slip: None };
    let mut walker = Walker { text, at: 0, sound: true, found };
    let whole = walker.value(&Path::Root, 0).and_then(|value| {
        walker.space();
        if walker.at == text.len() { Ok(value) } else { Err(walker.slip()) }
    });
    match whole {
        Ok(value) => walker.found.value = Some(value).filter(|_| walker.sound),
        Err(slip) => walker.found.slip = slip.map(|slip| (slip, walker.at)),
    }
    walker.found
}

struct Walker<'t> {
    text: &'t [u8],
    at: usize,
    /// Whether all that stands for a number so far is one.
    sound: bool,
    found: Walk<'t>,
}

impl<'t> Walker<'t> {
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

    fn value(&mut self, path: &Path<'_>, depth: usize) -> Result<Json<'t>, Stop> {
        self.space();
        let sign = self.peek().is_some_and(|byte| b"+-".contains(&byte));
        let next = self.text.get(self.at + usize::from(sign)).copied().unwrap_or_default();
        match self.peek() {
            Some(b'{' | b'[') if depth == MAX_DEPTH => Err(None),
            Some(b'{') => self.object(path, depth),
            Some(b'[') => self.array(path, depth),
            Some(b'"') => self.string().map(Json::String),
            Some(byte) if byte.is_ascii_digit() || byte == b'-' && next.is_ascii_digit() => Ok(self.number()),
            Some(_) if next.is_ascii_alphabetic() => self.word(path),
            _ => Err(self.slip()),
        }
    }

    fn object(&mut self, path: &Path<'_>, depth: usize) -> Result<Json<'t>, Stop> {
        let (first, start, mut object) = (self.found.no_numbers.len(), self.at, Object::default());
        let walked = self.fields(path, depth, &mut object.fields);
        let id = object.get("id").and_then(|id| match id {
            Json::String(text) => Some(text).filter(|text| text.chars().nth(MAX_ID_LENGTH).is_none()),
            _ => None,
        });
        for no_number in &mut self.found.no_numbers[first..] {
            no_number.id = no_number.id.take().or_else(|| id.map(|id| id.to_string()));
        }
        walked?;
        object.text = &self.text[start..self.at];
        Ok(Json::Object(Box::new(object)))
    }

    fn fields(
        &mut self,
        path: &Path<'_>,
        depth: usize,
        fields: &mut Vec<(Cow<'t, str>, Json<'t>)>,
    ) -> Result<(), Stop> {
        let (mut places, mut comma) = (HashMap::new(), None);
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
            let (field, count) = (path.field(&name), fields.len());
            let place = *places.entry(name.clone()).or_insert(count);
            if place < count && self.found.repeated.len() < MAX_ERRORS {
                let shown = name.chars().take(MAX_SHOWN).collect();
                self.found.repeated.push(Repeated { name: shown, at, pointer: field.pointer() });
            }
            let value = self.value(&field, depth + 1)?;
            match fields.get_mut(place) {
                Some((_, former)) => *former = value,
                None => fields.push((name, value)),
            }
            comma = self.comma(b'}')?;
        }
    }

    fn array(&mut self, path: &Path<'_>, depth: usize) -> Result<Json<'t>, Stop> {
        let (mut items, mut comma) = (Vec::new(), None);
        self.at += 1;
        loop {
            self.space();
            if self.peek() == Some(b']') {
                self.close(comma)?;
                return Ok(Json::Array(items));
            }
            let item = self.value(&path.item(items.len()), depth + 1)?;
            items.push(item);
            comma = self.comma(b']')?;
        }
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

    /// A number, or what looks like one: slips behind it are told too.
    fn number(&mut self) -> Json<'t> {
        let start = self.at;
        self.skip_while(|byte| byte.is_ascii_digit() || b"+-.eE".contains(&byte));
        let number = Json::number(&self.text[start..self.at]);
        self.sound &= number.is_some();
        number.unwrap_or(Json::Null)
    }

    fn string(&mut self) -> Result<Cow<'t, str>, Stop> {
        let (start, mut escaped, mut plain) = (self.at, false, true);
        self.at += 1;
        self.skip_while(|byte| {
            let ends = byte == b'"' && !escaped;
            plain &= byte != b'\\';
            escaped = byte == b'\\' && !escaped;
            !ends
        });
        self.at = self.text.len().min(self.at + 1);
        let text = &self.text[start..self.at];
        let read = |text| {
            if plain {
                serde_json::from_slice::<&str>(text).map(Cow::Borrowed)
            } else {
                serde_json::from_slice::<String>(text).map(Cow::Owned)
            }
        };
        read(text).map_err(|_| None)
    }

    /// A word in place of a value.
    fn word(&mut self, path: &Path<'_>) -> Result<Json<'t>, Stop> {
        let at = self.at;
        let word = self.bare();
        match word.as_str() {
            "true" => return Ok(Json::Bool(true)),
            "false" => return Ok(Json::Bool(false)),
            "null" => return Ok(Json::Null),
            _ => {}
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
        self.sound = false;
        if self.found.no_numbers.len() < MAX_ERRORS {
            self.found.no_numbers.push(NoNumber { word, at, pointer: path.pointer(), id: None });
        }
        Ok(Json::Null)
    }

    /// A word without quotes, cut to the length shown.
    fn bare(&mut self) -> String {
        let start = self.at;
        self.skip_while(|byte| byte.is_ascii_alphanumeric() || b"+-_.".contains(&byte));
        self.text[start..self.at].iter().take(MAX_SHOWN).map(|&byte| char::from(byte)).collect()
    }
}
