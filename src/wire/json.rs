//! A JSON value as its text has it.

use std::borrow::Cow;

/// A value. Its pieces are slices of the text.
///
/// The JSON library's own value is not for strangers' texts: it takes objects with certain field names for numbers, and for
/// texts that it reads as JSON in turn, one within the other, which ends in a stack overflow.
#[derive(Debug)]
pub(super) enum Json<'t> {
    Null,
    Bool(bool),
    /// The literal.
    Number(&'t str),
    String(Cow<'t, str>),
    Array(Vec<Self>),
    Object(Box<Object<'t>>),
}

impl<'t> Json<'t> {
    /// The number that this text is. `None` if JSON writes none like it.
    pub(super) fn number(text: &'t [u8]) -> Option<Self> {
        if !past_number(text)?.is_empty() {
            return None;
        }
        core::str::from_utf8(text).ok().map(Self::Number)
    }
}

/// The fields of an object in the order of the text. Of two with one name the latter counts, at the place of the former.
#[derive(Debug, Default)]
pub(super) struct Object<'t> {
    pub(super) fields: Vec<(Cow<'t, str>, Json<'t>)>,
    /// The whole object.
    pub(super) text: &'t [u8],
}

impl<'t> Object<'t> {
    pub(super) fn get(&self, name: &str) -> Option<&Json<'t>> {
        self.fields.iter().find(|(known, _)| known == name).map(|(_, value)| value)
    }
}

/// What follows the number that a text begins with, as JSON writes numbers. `None` if it begins with none.
fn past_number(text: &[u8]) -> Option<&[u8]> {
    let whole = text.strip_prefix(b"-").unwrap_or(text);
    // No digit follows a first 0.
    let mut rest = whole.strip_prefix(b"0").or_else(|| past_digits(whole))?;
    if let Some(fraction) = rest.strip_prefix(b".") {
        rest = past_digits(fraction)?;
    }
    if let [b'e' | b'E', exponent @ ..] = rest {
        let unsigned = if let [b'+' | b'-', digits @ ..] = exponent { digits } else { exponent };
        rest = past_digits(unsigned)?;
    }
    Some(rest)
}

/// What follows the digits that a text begins with. `None` if it begins with none.
fn past_digits(text: &[u8]) -> Option<&[u8]> {
    let count = text.iter().take_while(|byte| byte.is_ascii_digit()).count();
    if count > 0 { text.get(count..) } else { None }
}
