//! Paths of values in a body.

use core::fmt;

/// The path from the root to a value. Displayed as a JSON pointer (RFC 6901).
#[derive(Clone, Copy)]
pub(super) enum Path<'a> {
    Root,
    Field(&'a Path<'a>, &'a str),
    Item(&'a Path<'a>, usize),
}

impl<'a> Path<'a> {
    pub(super) fn field(&'a self, name: &'a str) -> Self {
        Self::Field(self, name)
    }

    pub(super) fn item(&'a self, position: usize) -> Self {
        Self::Item(self, position)
    }

    /// As a JSON pointer; that of the whole body where the names in it are too long.
    pub(super) fn pointer(&self) -> String {
        if self.named() > MAX_NAMED { String::new() } else { self.to_string() }
    }

    /// Bytes of the names in it.
    fn named(&self) -> usize {
        match self {
            Self::Root => 0,
            Self::Field(parent, name) => parent.named() + name.len(),
            Self::Item(parent, _) => parent.named(),
        }
    }
}

impl fmt::Display for Path<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Root => Ok(()),
            Self::Field(parent, name) => write!(f, "{parent}/{}", name.replace('~', "~0").replace('/', "~1")),
            Self::Item(parent, position) => write!(f, "{parent}/{position}"),
        }
    }
}

/// The longest names that a pointer may hold together, bytes. Each fault has a pointer, and nobody's names are as long.
const MAX_NAMED: usize = 1000;

/// The most faults that one answer lists: past that nobody reads on.
pub(super) const MAX_ERRORS: usize = 1000;
