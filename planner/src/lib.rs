//! Plans the fewest relocations that free an object on a crowded table, and proves it.
//!
//! In reading order: a checked [`scene`]; exact [`geometry`] of fingers and discs; the [`knowledge`] of which obstacles
//! must go first; the [`search`] for the least set of them, with its proof; the [`placement`] of what is moved; the
//! [`paper`]'s own methods; the [`plan`] that couples these and its independent checker. A [`budget`] says how long all
//! of it may take. Nothing here does I/O or reads a clock: the same input gives the same bytes.

pub mod budget;
pub mod geometry;
pub mod knowledge;
pub mod paper;
pub mod placement;
pub mod plan;
pub mod scene;
pub mod search;
