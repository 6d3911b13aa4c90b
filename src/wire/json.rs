//! A JSON value as its text has it.

use std::borrow::Cow;

use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};

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

/// The fields of an object in the order of the text. Of two with one name the latter counts, at the place of the former.
#[derive(Debug, Default)]
pub(super) struct Object<'t> {
    pub(super) fields: Vec<(Cow<'t, str>, Json<'t>)>,
    /// The whole object.
    pub(super) text: &'t str,
}

impl<'t> Object<'t> {
    pub(super) fn get(&self, name: &str) -> Option<&Json<'t>> {
        self.fields.iter().find(|(known, _)| known == name).map(|(_, value)| value)
    }
}

/// Any JSON, of which nothing is kept: says whether a text is JSON, and where it is not.
pub(super) struct Sound;

impl<'de> Deserialize<'de> for Sound {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Anything)
    }
}

struct Anything;

impl<'de> Visitor<'de> for Anything {
    type Value = Sound;

    fn expecting(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
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
