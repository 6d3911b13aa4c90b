//! Plans the fewest relocations that free an object on a crowded table, and proves it.
//!
//! In reading order: a checked [`scene`]; the [`statement`] of an answer, with its [`cost`]; the independent [`check`] of a
//! statement; exact [`geometry`] of fingers and footprints; the [`knowledge`] of which obstacles must go first; the
//! [`search`] for the least set of them, with its proof; the [`placement`] of what is moved; the [`plan`] that couples
//! these; the [`paper`]'s own methods, judged by it. A [`budget`] says how long all of it may take. Nothing here does I/O or
//! reads a clock: the same input gives the same bytes.

pub mod budget;
pub mod check;
pub mod cost;
pub mod geometry;
pub mod knowledge;
pub mod paper;
pub mod placement;
pub mod plan;
pub mod scene;
pub mod search;
pub mod statement;
