//! Walks a JSON value with its path, and collects all faults instead of stopping at the first.

use core::fmt;

use super::code::ErrorCode;
use super::json::{Json, Object};
use super::malformed::{Places, malformed};
use super::path::{MAX_ERRORS, Path};
use super::problem::{ErrorItem, Problem};
use super::walk::{Repeated, walk};

/// The faults found so far.
#[derive(Default)]
pub(super) struct RequestFaults {
    items: Vec<ErrorItem>,
}

impl RequestFaults {
    pub(super) fn add(&mut self, code: ErrorCode, path: &Path<'_>, detail: fmt::Arguments<'_>) {
        if self.items.len() < MAX_ERRORS {
            self.items.push(ErrorItem::new(code, path.pointer(), detail.to_string()));
        }
    }

    /// The value that was read, unless there are faults.
    pub(super) fn judge<T>(self, read: Option<T>) -> Result<T, Problem> {
        match read {
            Some(value) if self.items.is_empty() => Ok(value),
            _ => Err(Problem::invalid(self.items)),
        }
    }
}

/// The body as a JSON value, and the faults known before the walk: repeated fields.
///
/// # Errors
/// A problem that names what is no JSON.
pub(super) fn parse(body: &[u8]) -> Result<(Json<'_>, RequestFaults), Problem> {
    let mut found = walk(body);
    let Some(value) = found.value.take() else { return Err(malformed(body, found)) };
    let mut places = Places::of(body);
    let items = found.repeated.into_iter().map(|Repeated { name, at, pointer }| {
        let detail = format!("'{name}' is there a second time, at {}", places.at(at));
        ErrorItem::new(ErrorCode::RepeatedField, pointer, detail)
    });
    Ok((value, RequestFaults { items: items.collect() }))
}

/// A value and its path.
#[derive(Clone, Copy)]
pub(super) struct JsonNode<'a> {
    value: &'a Json<'a>,
    path: &'a Path<'a>,
}

impl<'a> JsonNode<'a> {
    pub(super) fn root(value: &'a Json<'a>) -> Self {
        Self { value, path: &Path::Root }
    }

    pub(super) fn path(&self) -> &'a Path<'a> {
        self.path
    }

    /// The text of an object; empty for anything else.
    pub(super) fn source(&self) -> &'a [u8] {
        if let Json::Object(object) = self.value { object.text } else { &[] }
    }

    fn wrong_type<T>(&self, expected: &str, faults: &mut RequestFaults) -> Option<T> {
        let found = match self.value {
            Json::Null => "null",
            Json::Bool(_) => "a boolean",
            Json::Number(_) => "a number",
            Json::String(_) => "a string",
            Json::Array(_) => "an array",
            Json::Object(_) => "an object",
        };
        faults.add(ErrorCode::WrongType, self.path, format_args!("expected {expected}, found {found}"));
        None
    }

    /// An object with fields of these names and no others.
    pub(super) fn fields(&self, names: &FieldNames, faults: &mut RequestFaults) -> Option<Fields<'a>> {
        let Json::Object(object) = self.value else { return self.wrong_type("an object", faults) };
        let names_there = object.fields.iter().map(|(name, _)| name.as_ref());
        for name in names_there.filter(|name| !names.known.contains(name)).take(MAX_ERRORS) {
            let path = self.path.field(name);
            faults.add(ErrorCode::UnknownField, &path, format_args!("known here: {}", names.known.join(", ")));
        }
        Some(Fields { object, path: self.path })
    }

    /// The text of a field of an object, without any judgement.
    pub(super) fn peek(&self, name: &str) -> Option<&'a str> {
        let Json::Object(object) = self.value else { return None };
        match object.get(name) {
            Some(Json::String(text)) => Some(text),
            _ => None,
        }
    }

    /// An object with any fields.
    pub(super) fn any_object(&self, faults: &mut RequestFaults) -> Option<()> {
        if matches!(self.value, Json::Object(_)) { Some(()) } else { self.wrong_type("an object", faults) }
    }

    pub(super) fn number(&self, faults: &mut RequestFaults) -> Option<f64> {
        let Json::Number(number) = self.value else { return self.wrong_type("a number", faults) };
        let value = number.parse().ok().filter(|value: &f64| value.is_finite());
        if value.is_none() {
            // Only a literal beyond the range of a double has no value.
            let literal: String = number.chars().take(40).collect();
            faults.add(ErrorCode::OutOfRange, self.path, format_args!("{literal} is out of the range of every field"));
        }
        value
    }

    /// A number from `min` to `max`.
    pub(super) fn ranged(&self, (min, max): (f64, f64), faults: &mut RequestFaults) -> Option<f64> {
        let value = self.number(faults)?;
        if !(min..=max).contains(&value) {
            faults.add(ErrorCode::OutOfRange, self.path, format_args!("{value} is not between {min} and {max}"));
            return None;
        }
        Some(value)
    }

    /// An integer from `min` to `max`; 3.0 is one.
    pub(super) fn integer(&self, (min, max): (i64, i64), faults: &mut RequestFaults) -> Option<i64> {
        let value = self.number(faults)?;
        if value.fract() != 0.0 {
            faults.add(ErrorCode::NotWhole, self.path, format_args!("{value} is not a whole number"));
            return None;
        }
        #[expect(clippy::cast_possible_truncation, reason = "a whole number; `as` saturates")]
        let integer = value as i64;
        if !(min..=max).contains(&integer) {
            faults.add(ErrorCode::OutOfRange, self.path, format_args!("{value} is not between {min} and {max}"));
            return None;
        }
        Some(integer)
    }

    /// A non-negative integer.
    pub(super) fn whole(&self, (min, max): (u64, u64), faults: &mut RequestFaults) -> Option<u64> {
        let bound = |bound| i64::try_from(bound).unwrap_or(i64::MAX);
        self.integer((bound(min), bound(max)), faults).and_then(|value| u64::try_from(value).ok())
    }

    pub(super) fn boolean(&self, faults: &mut RequestFaults) -> Option<bool> {
        if let Json::Bool(value) = self.value { Some(*value) } else { self.wrong_type("a boolean", faults) }
    }

    pub(super) fn text(&self, faults: &mut RequestFaults) -> Option<String> {
        if let Json::String(text) = self.value { Some(text.to_string()) } else { self.wrong_type("a string", faults) }
    }

    /// One of these words.
    pub(super) fn word<T: Copy>(&self, choices: &[(&str, T)], faults: &mut RequestFaults) -> Option<T> {
        let Json::String(text) = self.value else { return self.wrong_type("a string", faults) };
        let choice = choices.iter().find(|(word, _)| word == text).map(|(_, value)| *value);
        if choice.is_none() {
            let words: Vec<&str> = choices.iter().map(|(word, _)| *word).collect();
            faults.add(ErrorCode::UnknownValue, self.path, format_args!("'{text}' is none of: {}", words.join(", ")));
        }
        choice
    }

    /// The length of a list; 0 for anything else.
    pub(super) fn length(&self) -> usize {
        if let Json::Array(items) = self.value { items.len() } else { 0 }
    }

    /// A list. An unreadable item is replaced by the default value; its fault has been noted.
    pub(super) fn list<T: Default>(
        &self,
        faults: &mut RequestFaults,
        read: impl Fn(JsonNode<'_>, &mut RequestFaults) -> Option<T>,
    ) -> Option<Vec<T>> {
        let Json::Array(values) = self.value else { return self.wrong_type("an array", faults) };
        let mut items = Vec::new();
        for (position, value) in values.iter().enumerate() {
            if faults.items.len() >= MAX_ERRORS {
                // The answer lists no more faults, so the rest is not read.
                return None;
            }
            let path = self.path.item(position);
            items.push(read(JsonNode { value, path: &path }, faults).unwrap_or_default());
        }
        Some(items)
    }
}

/// The names of an object's fields.
pub(super) struct FieldNames {
    pub(super) known: &'static [&'static str],
}

impl FieldNames {
    pub(super) const fn of(known: &'static [&'static str]) -> Self {
        Self { known }
    }
}

/// The fields of an object.
#[derive(Clone, Copy)]
pub(super) struct Fields<'a> {
    object: &'a Object<'a>,
    path: &'a Path<'a>,
}

impl Fields<'_> {
    /// A required field.
    pub(super) fn required<T>(
        &self,
        name: &'static str,
        faults: &mut RequestFaults,
        read: impl FnOnce(JsonNode<'_>, &mut RequestFaults) -> Option<T>,
    ) -> Option<T> {
        let path = self.path.field(name);
        let Some(value) = self.object.get(name) else {
            self.missing(name, faults);
            return None;
        };
        read(JsonNode { value, path: &path }, faults)
    }

    /// Note that a field excludes another one that is there too.
    pub(super) fn conflict(&self, name: &'static str, other: &'static str, faults: &mut RequestFaults) {
        let detail = format_args!("there is a '{other}' too, and only one of them may be");
        faults.add(ErrorCode::ConflictingFields, &self.path.field(name), detail);
    }

    /// Note that neither of two fields is there.
    pub(super) fn missing_one_of(&self, [name, other]: [&'static str; 2], faults: &mut RequestFaults) {
        let detail = format_args!("one of the fields '{name}' and '{other}' is required");
        faults.add(ErrorCode::Missing, &self.path.field(name), detail);
    }

    /// True if the field is present, even if it is null.
    pub(super) fn has(&self, name: &'static str) -> bool {
        self.object.get(name).is_some()
    }

    /// Note that a field is missing.
    pub(super) fn missing(&self, name: &'static str, faults: &mut RequestFaults) {
        faults.add(ErrorCode::Missing, &self.path.field(name), format_args!("the field '{name}' is required"));
    }

    /// An optional field; absent or null means `default`. `None` only if it is present and unreadable.
    pub(super) fn optional<T>(
        &self,
        name: &'static str,
        default: T,
        faults: &mut RequestFaults,
        read: impl FnOnce(JsonNode<'_>, &mut RequestFaults) -> Option<T>,
    ) -> Option<T> {
        match self.object.get(name) {
            None | Some(Json::Null) => Some(default),
            Some(value) => read(JsonNode { value, path: &self.path.field(name) }, faults),
        }
    }

    /// An optional field. `None` also if it is unreadable; its fault has been noted.
    pub(super) fn stated<T>(
        &self,
        name: &'static str,
        faults: &mut RequestFaults,
        read: impl FnOnce(JsonNode<'_>, &mut RequestFaults) -> Option<T>,
    ) -> Option<T> {
        self.optional(name, None, faults, |node, faults| read(node, faults).map(Some)).flatten()
    }

    /// True if the field is present and not null.
    pub(super) fn states(&self, name: &'static str) -> bool {
        self.object.get(name).is_some_and(|value| !matches!(value, Json::Null))
    }

    /// A required number.
    pub(super) fn number(&self, name: &'static str, faults: &mut RequestFaults) -> Option<f64> {
        self.required(name, faults, |node, faults| node.number(faults))
    }
}
